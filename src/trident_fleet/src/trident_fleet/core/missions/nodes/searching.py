# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that search."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from py_trees.common import Status

from trident_fleet.core.missions.nodes.base import Node, task_of
from trident_fleet.core.missions.robot import MissionRobot

_COVER_M = 9.0  # half the side of a cover
_AT_COVER_M = 4.0


@dataclass(frozen=True)
class SearchPiece(Node):
    """The task to cover a piece: along its lanes."""

    def tick(self, robot: MissionRobot) -> Status:
        """SUCCESS: covered."""
        task = task_of(robot, "search")
        piece = robot.ground.pieces.get(task.task_id) if task is not None else None
        if task is None or piece is None:
            return Status.FAILURE
        if robot.doing != task.task_id:
            path = robot.ground.lanes.path(piece, robot.vehicle.place, robot.lacks_s())
            robot.doing = task.task_id
            robot.follow(path)
        robot.begin(task.task_id)
        if robot.vehicle.path_left:
            return Status.RUNNING
        robot.finish(task.task_id)
        robot.doing = ""
        return Status.SUCCESS


@dataclass(frozen=True)
class VisitCover(Node):
    """The task to look below a roof or trees, until all that is seen from the ground is covered."""

    def tick(self, robot: MissionRobot) -> Status:
        """SUCCESS: covered."""
        task = task_of(robot, "cover")
        if task is None:
            return Status.FAILURE
        robot.doing = task.task_id
        robot.begin(task.task_id)
        place = (task.place[0], task.place[1])
        arrived = robot.go_to(place, _AT_COVER_M)
        lattice = robot.knowledge.eyes.area.lattice
        low, left = lattice.cell(place[0] - _COVER_M, place[1] - _COVER_M)
        high, right = lattice.cell(place[0] + _COVER_M - 0.1, place[1] + _COVER_M - 0.1)
        covered = robot.knowledge.coverage.covered()[low : high + 1, left : right + 1]
        waited_s = robot.work(task.task_id, 0.5 if arrived else 0.0)
        if not (bool(np.all(covered)) or waited_s > 6.0):
            return Status.RUNNING
        robot.finish(task.task_id)
        return Status.SUCCESS


@dataclass(frozen=True)
class SearchByGain(Node):
    """Without a task: to where what can be seen is worth most per second, again and again."""

    def tick(self, robot: MissionRobot) -> Status:
        """RUNNING as long as there is something to see."""
        if robot.doing == "search by gain" and robot.vehicle.path_left:
            return Status.RUNNING
        path = robot.most_gained()
        if not path:
            robot.stand()
            return Status.FAILURE
        robot.doing = "search by gain"
        robot.follow(path)
        return Status.RUNNING
