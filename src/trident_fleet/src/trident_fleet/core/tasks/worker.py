# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a robot does with what it has won: it goes there, works, and says so."""

from __future__ import annotations

import math
from dataclasses import dataclass

from trident_fleet.core.tasks.messages import Point
from trident_fleet.core.tasks.protocol import Sent
from trident_fleet.core.tasks.robot import Robot


@dataclass(frozen=True)
class Happened:
    """What has come of an instant.

    Attributes:
        begun: task that was begun; "": none.
        done: task that was done.
        sent: what the robot says.
    """

    begun: str = ""
    done: str = ""
    sent: tuple[Sent, ...] = ()


class Worker:
    """Works for the time that a task lasts, when it is at the place and may begin."""

    def __init__(self, robot: Robot, reach_m: float = 0.0) -> None:
        """Of a robot that stands.

        Args:
            robot: its side of the protocol.
            reach_m: it is at a place when it is no farther away [m].
        """
        self._robot, self._reach_m = robot, reach_m
        self._task, self._until_s = "", math.inf

    def goal(self, now_s: float) -> Point | None:
        """Where the robot should be now, p_common [m]; None: it has nothing to do."""
        held = self._robot.current(now_s)
        if held is None or held.job.task_id != self._task:
            self._task = ""
        return None if held is None else held.job.task.place

    def at(self, place: Point, now_s: float) -> Happened:
        """The robot is here now, p_common [m]."""
        goal = self.goal(now_s)
        if goal is None:
            return Happened()
        if self._task:
            return self._work(now_s)
        self._robot.plan.moved(place, now_s)
        held = self._robot.current(now_s)
        assert held is not None
        task = held.job.task
        if math.dist(place, goal) > self._reach_m or not self._robot.begin(task.task_id, now_s):
            return Happened()
        self._task, self._until_s = task.task_id, now_s + task.duration_s
        return Happened(begun=task.task_id)

    def _work(self, now_s: float) -> Happened:
        if now_s < self._until_s:
            return Happened()
        done, self._task = self._task, ""
        return Happened(done=done, sent=tuple(self._robot.finish(done, now_s)))
