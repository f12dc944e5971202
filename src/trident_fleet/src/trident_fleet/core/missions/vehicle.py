# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a mission needs of a vehicle, and the kinematic one for benches and tests."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Sequence
from typing import Protocol

from trident_fleet.core.missions.kinds import Kind
from trident_fleet.core.missions.scene import Place


class Vehicle(Protocol):
    """A vehicle that follows paths; the simulator's, or a model of it.

    The mission calls `follow` and `halt` whenever it decides, and reads the rest between steps.
    """

    @property
    def place(self) -> Place:
        """Where it is, p_common [m]."""
        ...

    @property
    def speed_m_s(self) -> float:
        """How fast it was in the last step [m/s]."""
        ...

    @property
    def path_left(self) -> Sequence[Place]:
        """Corners of its path that are ahead of it; empty: it stands."""
        ...

    def follow(self, path: Sequence[Place]) -> None:
        """Leave the path before, and follow this one from where it is."""
        ...

    def halt(self) -> None:
        """Stand where it is."""
        ...

    @property
    def stop_m(self) -> float:
        """It cannot stand nearer than this to what it goes to [m]."""
        ...


class SteppedVehicle(Vehicle, Protocol):
    """A vehicle as the owner of a mission has it."""

    @property
    def path_m(self) -> float:
        """How far it has come [m]."""
        ...

    @property
    def looks(self) -> bool:
        """Whether it is where it sees from; a multirotor on the ground is not."""
        ...

    def step(self, seconds: float) -> None:
        """Let time pass."""
        ...


class KinematicVehicle:
    """A point that moves along its path at its speed, and turns and stops at once."""

    def __init__(self, place: Place, speed_m_s: float) -> None:
        """At a place, standing."""
        self._place, self._top_m_s = place, speed_m_s
        self._path: deque[Place] = deque()
        self._speed_m_s = 0.0
        self._path_m = 0.0

    @property
    def place(self) -> Place:
        """Where it is, p_common [m]."""
        return self._place

    @property
    def speed_m_s(self) -> float:
        """How fast it was in the last step [m/s]."""
        return self._speed_m_s

    @property
    def path_left(self) -> Sequence[Place]:
        """Corners of its path that are ahead of it; empty: it stands."""
        return self._path

    @property
    def path_m(self) -> float:
        """How far it has come [m]."""
        return self._path_m

    @property
    def looks(self) -> bool:
        """It is everywhere where it sees from."""
        return True

    @property
    def stop_m(self) -> float:
        """It stands wherever it wants to."""
        return 0.0

    def follow(self, path: Sequence[Place]) -> None:
        """Leave the path before, and follow this one from where it is."""
        self._path = deque(path)

    def halt(self) -> None:
        """Stand where it is."""
        self._path.clear()

    def step(self, seconds: float) -> None:
        """Let time pass."""
        left_m = self._top_m_s * seconds
        while self._path and left_m > 0.0:
            goal = self._path[0]
            away_m = math.dist(self._place, goal)
            if away_m <= left_m:
                self._place = goal
                self._path.popleft()
                left_m -= away_m
            else:
                share = left_m / away_m
                x, y = (a + share * (b - a) for a, b in zip(self._place, goal, strict=True))
                self._place, left_m = (x, y), 0.0
        moved_m = self._top_m_s * seconds - left_m
        self._path_m += moved_m
        self._speed_m_s = moved_m / seconds if seconds > 0.0 else 0.0


VehicleMaker = Callable[[str, Kind, Place], SteppedVehicle]
"""Makes the vehicle of a robot by name, of a kind, that starts at a place [m]."""


def kinematic(_name: str, kind: Kind, place: Place) -> SteppedVehicle:
    """A model of a vehicle, for benches and tests."""
    return KinematicVehicle(place, kind.speed_m_s)
