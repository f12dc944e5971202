# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that deal with people who have been found."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from py_trees.common import Status

from trident_fleet.core.missions.nodes.base import STEP_S, Node, task_of
from trident_fleet.core.missions.reports import Fix
from trident_fleet.core.missions.robot import MissionRobot
from trident_fleet.core.tasks.messages import TaskAnnounce

_CLOSE = 0.25  # share of the distance that counts, to which a robot goes
_LOST_S = 60.0  # after which somebody who is not where they should be is given up


def attend(robot: MissionRobot, fix: Fix, within_m: float, needed_s: float) -> Status:
    """Go to somebody, and stand there for long enough.

    A robot stands where somebody who drifts passes by in the middle of that time.

    Returns:
        SUCCESS: done; FAILURE: there is nobody there.
    """
    what = f"{fix.name} {needed_s}"
    place = robot.knowledge.place_of(fix, robot.now_s)
    stands = robot.work(what, 0.0) > 0.0 and math.dist(robot.vehicle.place, place) <= within_m
    if not stands:
        passing = robot.knowledge.place_of(fix, robot.now_s + 0.5 * needed_s)
        if not robot.go_to(passing, _CLOSE * within_m):
            robot.work("", 0.0)
            return Status.RUNNING
    if robot.now_s - fix.time_s > _LOST_S:
        return Status.FAILURE
    stayed_s = robot.work(what, STEP_S)
    return Status.SUCCESS if stayed_s > needed_s + STEP_S else Status.RUNNING


def person_of(task_id: str) -> str:
    """The name behind the kind of a task."""
    return task_id.split("/", 1)[1]


def fix_of(robot: MissionRobot, task: TaskAnnounce | None) -> Fix | None:
    """What is known of the person whom a task is about; None: no task, or nobody known."""
    return None if task is None else robot.knowledge.people.get(person_of(task.task_id))


def end_task(robot: MissionRobot, task: TaskAnnounce, status: Status, after: Fix) -> None:
    """End a task as the robot's stay with somebody ended, of whom `after` is known on success."""
    if status is Status.SUCCESS:
        robot.knowledge.detected(after)
        robot.finish(task.task_id)
    elif status is Status.FAILURE:
        robot.fail(task.task_id, "not where they should be")


@dataclass(frozen=True)
class Serve(Node):
    """The task to serve somebody: a rescuer stands with them."""

    def tick(self, robot: MissionRobot) -> Status:
        """SUCCESS: served."""
        task = task_of(robot, "serve")
        fix = fix_of(robot, task)
        if task is None or fix is None:
            return Status.FAILURE
        robot.doing = task.task_id
        has_begun = robot.begin(task.task_id)
        if fix.served:
            if has_begun:
                robot.finish(task.task_id)
            return Status.SUCCESS
        status = attend(robot, fix, robot.rules.serve_m, robot.rules.serve_s)
        end_task(robot, task, status, replace(fix, confirmed=True, served=True))
        return status


@dataclass(frozen=True)
class ServeUnasked(Node):
    """Serve somebody close by without a task, where no task comes: nobody else is heard."""

    def tick(self, robot: MissionRobot) -> Status:
        """RUNNING while there is somebody."""
        if robot.alone_s < 10.0 or robot.task() is not None:
            return Status.FAILURE
        fix = _nearest_waiting(robot)
        if fix is None:
            return Status.FAILURE
        robot.doing = f"serves {fix.name} unasked"
        status = attend(robot, fix, robot.rules.serve_m, robot.rules.serve_s)
        if status is Status.SUCCESS:
            robot.knowledge.detected(replace(fix, confirmed=True, served=True))
        return status


def _nearest_waiting(robot: MissionRobot) -> Fix | None:
    """The nearest of those whom the robot may rescue and has heard of lately."""
    waiting = (
        fix
        for fix in robot.knowledge.people.values()
        if not fix.served and robot.can_rescue(fix) and robot.now_s - fix.time_s < 400.0
    )
    return min(
        waiting,
        key=lambda one: math.dist(robot.vehicle.place, robot.knowledge.place_of(one, robot.now_s)),
        default=None,
    )


@dataclass(frozen=True)
class Confirm(Node):
    """The task to confirm somebody: stand nearby."""

    def tick(self, robot: MissionRobot) -> Status:
        """SUCCESS: confirmed."""
        task = task_of(robot, "confirm")
        fix = fix_of(robot, task)
        if task is None or fix is None:
            return Status.FAILURE
        robot.doing = task.task_id
        robot.begin(task.task_id)
        if fix.confirmed:
            robot.finish(task.task_id)
            return Status.SUCCESS
        status = attend(robot, fix, robot.rules.confirm_m, robot.rules.confirm_s)
        end_task(robot, task, status, replace(fix, confirmed=True))
        return status
