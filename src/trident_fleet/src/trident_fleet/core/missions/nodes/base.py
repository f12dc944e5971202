# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a node of a behavior tree is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

from py_trees.common import Status

from trident_fleet.core.missions.robot import MissionRobot
from trident_fleet.core.tasks.messages import TaskAnnounce

STEP_S = 0.5
"""Time between two ticks of a tree [s]."""


@dataclass(frozen=True)
class Node(ABC):
    """A leaf: ticked once a step while it is its turn. Its fields are its parameters.

    Nodes keep nothing between ticks: what a robot is about stands in the robot.
    """

    @abstractmethod
    def tick(self, robot: MissionRobot) -> Status:
        """Act; SUCCESS: it is done or true, RUNNING: it goes further, FAILURE: not its turn."""


def task_of(robot: MissionRobot, kind: str) -> TaskAnnounce | None:
    """The robot's task now, if it is of this kind."""
    held = robot.task()
    if held is None or held.job.task.kind != kind:
        return None
    return held.job.task
