# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""One robot of a mission: its vehicle, its battery, its tasks, and the tree that decides."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from trident_fleet.core.missions.blocks import Blocks
from trident_fleet.core.missions.kinds import Kind, Rules
from trident_fleet.core.missions.knowledge import Knowledge
from trident_fleet.core.missions.pieces import Lanes, Piece
from trident_fleet.core.missions.reports import Fix
from trident_fleet.core.missions.routes import Routes, shortened
from trident_fleet.core.missions.scene import Place
from trident_fleet.core.missions.vehicle import Vehicle
from trident_fleet.core.search.area import Array
from trident_fleet.core.tasks.member import Member
from trident_fleet.core.tasks.messages import Point
from trident_fleet.core.tasks.plan import Job

if TYPE_CHECKING:
    from trident_fleet.core.tasks.robot import Holding

_REPLAN_M = 1.5  # that a goal moves before the path to it is made again
_STOP_M = 0.5  # that a vehicle may stand farther off than it has to
_BELIEF_CELLS = 4000.0  # cells that one expected person is worth


@dataclass(frozen=True)
class Ground:
    """What robots of one kind share of an area.

    Attributes:
        routes: of the kind.
        lanes: of the kind.
        pieces: of the area, by name of the task.
        work_m: length of the passes that cover a piece, by its place [m].
    """

    routes: Routes
    lanes: Lanes
    pieces: dict[str, Piece]
    work_m: dict[Place, float]

    def travel(self, start: Point, goal: Point) -> float:
        """Length of the path to a task and of the work there that is a path, too [m]."""
        return self.routes(start, goal) + self.work_m.get((goal[0], goal[1]), 0.0)


class Battery:
    """Charge that is used while the robot moves."""

    def __init__(self, endurance_s: float) -> None:
        """Full; infinite: it never ends."""
        self.endurance_s, self.left_s = endurance_s, endurance_s
        self.changes = 0

    @property
    def charge(self) -> float:
        """0 ... 1."""
        return 1.0 if math.isinf(self.endurance_s) else self.left_s / self.endurance_s

    def use(self, seconds: float) -> None:
        """Let time pass."""
        self.left_s = max(self.left_s - seconds, 0.0)

    def change(self) -> None:
        """A new one."""
        self.left_s = self.endurance_s
        self.changes += 1


class MissionRobot:
    """What the nodes of a behavior tree see and do."""

    def __init__(
        self,
        kind: Kind,
        vehicle: Vehicle,
        ground: Ground,
        knowledge: Knowledge,
        member: Member,
        rules: Rules,
        expected: int,
    ) -> None:
        """At its base, which is where the vehicle is; so many people are expected in all."""
        self.kind, self.vehicle, self.ground = kind, vehicle, ground
        self.knowledge, self.member, self.rules = knowledge, member, rules
        self.home, self.battery = vehicle.place, Battery(kind.endurance_s)
        self.landed_s = self.now_s = self.alone_s = 0.0
        self.taken_over, self.expected = False, expected
        self.ordered = -1
        self.doing = ""
        self._goal: Place | None = None
        self._worked: tuple[str, float] = ("", 0.0)

    @property
    def name(self) -> str:
        """Of the robot."""
        return self.member.name

    @property
    def in_air(self) -> bool:
        """Whether it flies."""
        return self.kind.domain == "air" and self.landed_s == 0.0

    def task(self) -> Holding | None:
        """The task that it should work on; None: it has none."""
        return self.member.robot.current(self.now_s) if self.member.robot is not None else None

    def go_to(self, place: Place, within_m: float) -> bool:
        """Be on the path to a place; whether the robot is within a distance of it [m].

        A vehicle that cannot come so near stops before it.
        """
        stop_m = self.vehicle.stop_m
        if stop_m > 0.0:
            within_m = max(within_m, stop_m + _STOP_M)
        if math.dist(self.vehicle.place, place) <= within_m:
            if self.vehicle.path_left:
                self.vehicle.halt()
            self._goal = None
            return True
        if self._is_new_goal(place) or not self.vehicle.path_left:
            self._goal = place
            here = self.vehicle.place
            self.vehicle.follow(shortened(here, self.ground.routes.path(here, place), stop_m))
        return False

    def _is_new_goal(self, place: Place) -> bool:
        """Whether a place is so far from the goal of the path that this is made again."""
        return self._goal is None or math.dist(self._goal, place) > _REPLAN_M

    def follow(self, path: list[Place]) -> None:
        """Take a path; a goal before it is left."""
        self._goal = None
        self.vehicle.follow(path)

    def stand(self) -> None:
        """Stand where it is."""
        self._goal = None
        self.vehicle.halt()

    def begin(self, task_id: str) -> bool:
        """Begin a task; whether that is permitted."""
        return self.member.robot is not None and self.member.robot.begin(task_id, self.now_s)

    def finish(self, task_id: str) -> None:
        """A task is done."""
        if self.member.robot is not None:
            self.member.send(self.member.robot.finish(task_id, self.now_s))

    def fail(self, task_id: str, reason: str) -> None:
        """A task cannot be done."""
        if self.member.robot is not None:
            self.member.send(self.member.robot.fail(task_id, reason, self.now_s))

    def work(self, what: str, seconds: float) -> float:
        """How long the robot has worked on something without a break [s]; 0 seconds: ask."""
        before = self._worked[1] if self._worked[0] == what else 0.0
        self._worked = (what, before + seconds)
        return self._worked[1]

    def time_home_s(self) -> float:
        """To the base, by the shortest path [s]."""
        here, home = (*self.vehicle.place, 0.0), (*self.home, 0.0)
        return self.ground.routes(here, home) / self.kind.speed_m_s

    def lacks_s(self) -> Array:
        """How long each cell must still be in view of this robot [s], shape (rows, columns)."""
        return self.knowledge.coverage.lacks_s(self.knowledge.eyes.eyes[self.kind.name])

    def rank(self, job: Job) -> int:
        """Who flies searches land first, so that rescuers on the ground, who are slow, can plan."""
        piece = self.ground.pieces.get(job.task_id)
        return int(self.kind.domain == "air" and piece is not None and piece.wet)

    def can_rescue(self, fix: Fix) -> bool:
        """Whether this robot serves people there."""
        return self.kind.serves and self.kind.domain == fix.domain

    def most_gained(self) -> list[Place]:
        """The path along which what can be seen is worth most per meter; empty: nothing is left.

        A cell that is not covered is worth 1, a person who may be there as much as many cells.
        """
        eye = self.knowledge.eyes.eyes[self.kind.name]
        lacks_s = self.lacks_s()
        need = ((lacks_s > 0.0) & (lacks_s < 1e6)).astype(float)
        if len(self.knowledge.people) < self.expected:
            expected = self.knowledge.expected()
            need += _BELIEF_CELLS * np.where(eye.detect_rate > 0.0, expected, 0.0)
        blocks = Blocks.of(eye.area, self.kind)
        return blocks.path(self.vehicle.place, need, self.ground.routes)
