# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that take care of the robot itself: battery, base, link, an operator's hand."""

from __future__ import annotations

from dataclasses import dataclass

from py_trees.common import Status

from trident_fleet.core.missions.nodes.base import STEP_S, Node
from trident_fleet.core.missions.robot import MissionRobot

_AT_HOME_M = 1.0


@dataclass(frozen=True)
class TakenOver(Node):
    """An operator drives: the tree does nothing."""

    def tick(self, robot: MissionRobot) -> Status:
        """RUNNING while somebody drives."""
        if not robot.taken_over:
            return Status.FAILURE
        robot.doing = "driven by an operator"
        return Status.RUNNING


@dataclass(frozen=True)
class BatteryLow(Node):
    """What is left of the battery is the time home and a reserve, or it is being changed.

    Attributes:
        reserve: [s].
        detour: share by which the time home may be longer than known.
    """

    reserve: float = 12.0
    detour: float = 0.1

    def tick(self, robot: MissionRobot) -> Status:
        """SUCCESS: low."""
        home_s = (1.0 + self.detour) * robot.time_home_s()
        low = robot.landed_s > 0.0 or robot.battery.left_s <= home_s + self.reserve
        return Status.SUCCESS if low else Status.FAILURE


@dataclass(frozen=True)
class GoHome(Node):
    """To the base."""

    def tick(self, robot: MissionRobot) -> Status:
        """SUCCESS: there."""
        if robot.go_to(robot.home, _AT_HOME_M):
            return Status.SUCCESS
        robot.doing = "goes home"
        return Status.RUNNING


@dataclass(frozen=True)
class ChangeBattery(Node):
    """At the base, for as long as it takes."""

    def tick(self, robot: MissionRobot) -> Status:
        """SUCCESS: changed."""
        robot.landed_s += STEP_S
        robot.doing = "gets a battery"
        if robot.landed_s < robot.kind.recharge_s:
            return Status.RUNNING
        robot.battery.change()
        robot.landed_s = 0.0
        return Status.SUCCESS


@dataclass(frozen=True)
class AloneTooLong(Node):
    """Nobody was heard for long, though there are others.

    Attributes:
        after: [s].
    """

    after: float = 180.0

    def tick(self, robot: MissionRobot) -> Status:
        """SUCCESS: alone."""
        return Status.SUCCESS if robot.alone_s > self.after else Status.FAILURE
