# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A vehicle that has mass: it is where it is measured to be, and guided along its path."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

from trident_fleet.core.missions.kinds import Kind
from trident_fleet.core.missions.room import Room
from trident_fleet.core.missions.scene import Place
from trident_fleet.core.search.area import SearchArea


@dataclass(frozen=True)
class Reach:
    """How near a kind of vehicle comes to where it is to be.

    Attributes:
        corner_m: a corner of a path counts as passed within this [m].
        end_m: the end of a path counts as reached within this [m]; it is approached further.
        stop_m: it cannot stand nearer than this to what it goes to [m].
        clearance_m: that its middle keeps from what stands there, where there is room [m].
    """

    corner_m: float
    end_m: float
    stop_m: float
    clearance_m: float = 0.0


REACHES = {
    "air": Reach(corner_m=7.0, end_m=3.0, stop_m=0.0),
    "ground": Reach(corner_m=0.8, end_m=1.0, stop_m=2.0, clearance_m=0.9),
    "water": Reach(corner_m=2.0, end_m=5.0, stop_m=1.2, clearance_m=3.5),
}
"""By the medium that a vehicle moves in."""
_SEES_FROM = 0.8  # of the height that a robot in the air searches at


@dataclass(frozen=True)
class Motion:
    """A vehicle as it was measured.

    Attributes:
        place: p_common [m].
        height_m: above the still water [m].
        yaw_rad: from x towards y.
        speed_m_s: over ground, horizontal [m/s].
    """

    place: Place
    height_m: float
    yaw_rad: float
    speed_m_s: float


class GuidedVehicle:
    """What a mission sees of a vehicle that a controller moves: a `SteppedVehicle`.

    A path is left behind corner by corner as the vehicle passes them; where it ends, or where the
    vehicle was to halt, is the place that it keeps to.
    """

    def __init__(
        self,
        place: Place,
        reach: Reach,
        looks_from_m: float = -math.inf,
        room: Room | None = None,
    ) -> None:
        """At a place, standing.

        Args:
            place: p_common [m].
            reach: of its kind.
            looks_from_m: it sees nothing that counts from below this height [m].
            room: that its paths keep from what stands there; None: nothing does.
        """
        self._reach, self._looks_from_m, self._room = reach, looks_from_m, room
        self.motion = Motion(place, 0.0, 0.0, 0.0)
        self.keeps: Place = place
        self.people: Sequence[Place] = ()
        self.path_m = 0.0
        self.version = 0
        self._path: deque[Place] = deque()
        self._begin = place

    @property
    def place(self) -> Place:
        """Where it is, p_common [m]."""
        return self.motion.place

    @property
    def speed_m_s(self) -> float:
        """How fast it was when it was measured last [m/s]."""
        return self.motion.speed_m_s

    @property
    def stop_m(self) -> float:
        """It cannot stand nearer than this to what it goes to [m]."""
        return self._reach.stop_m

    @property
    def looks(self) -> bool:
        """Whether it is where it sees from."""
        return self.motion.height_m >= self._looks_from_m

    @property
    def path_left(self) -> Sequence[Place]:
        """Corners of its path that are ahead of it; empty: it stands, or comes to stand."""
        return self._path

    @property
    def line(self) -> list[Place]:
        """Where its leg begins and the corners ahead; without a path the place that it keeps to."""
        return [self._begin, *self._path] if self._path else [self.keeps]

    def follow(self, path: Sequence[Place]) -> None:
        """Leave the path before, and follow this one from where it is."""
        if self._room is not None:
            path = self._room.widened(self.place, path, self.people)
        self._path, self._begin = deque(path), self.place
        self.keeps = path[-1] if path else self.place
        self.version += 1

    def halt(self) -> None:
        """Stand where it is."""
        if (self._path and not self._is_at_end()) or self.version == 0:
            self.keeps = self.place
            self.version += 1
        self._path.clear()

    def _is_at_end(self) -> bool:
        """It comes to stand there, sooner than anywhere else."""
        return len(self._path) == 1 and math.dist(self.place, self.keeps) <= 2.0 * self._reach.end_m

    def step(self, seconds: float) -> None:
        """Let time pass: the world does that."""

    def measured(self, motion: Motion) -> None:
        """It is there now."""
        self.path_m += math.dist(self.place, motion.place)
        self.motion = motion
        while self._path and self._is_passed(self._path[0], len(self._path) == 1):
            self._begin = self._path.popleft()

    def _is_passed(self, corner: Place, is_end: bool) -> bool:
        away = math.dist(self.place, corner)
        if is_end:
            return away <= self._reach.end_m
        along = (corner[0] - self._begin[0], corner[1] - self._begin[1])
        beyond = (self.place[0] - corner[0]) * along[0] + (self.place[1] - corner[1]) * along[1]
        return away <= self._reach.corner_m or (beyond > 0.0 and along != (0.0, 0.0))


class Garage:
    """Makes guided vehicles for robots that search an area."""

    def __init__(self, area: SearchArea) -> None:
        """For an area."""
        self._area, self._rooms = area, dict[str, Room]()

    def guided(self, kind: Kind, place: Place) -> GuidedVehicle:
        """The vehicle of a kind of robot, at a place [m]."""
        reach = REACHES[kind.domain]
        if kind.domain == "air":
            return GuidedVehicle(place, reach, _SEES_FROM * kind.sensor.height_m)
        if kind.domain not in self._rooms:
            self._rooms[kind.domain] = Room(self._area, kind.domain, reach.clearance_m)
        return GuidedVehicle(place, reach, room=self._rooms[kind.domain])
