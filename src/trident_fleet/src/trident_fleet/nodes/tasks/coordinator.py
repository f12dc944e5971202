# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Entry point of a member of a team that shares out tasks: a robot, a manager, or both.

It gives no set-points: it says where its robot should be, and the node that drives it there is
enrolled in the lockstep. It looks at what is due at every multiple of `~step` of simulated time.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable

import rospy
from geometry_msgs.msg import PoseStamped
from trident_base.params import Recorded

from trident_fleet.core.errors import FormationError
from trident_fleet.core.follow.leader import Measurement
from trident_fleet.core.tasks.member import Member
from trident_fleet.core.tasks.messages import Point
from trident_fleet.core.tasks.plan import Plan
from trident_fleet.core.tasks.worker import Worker
from trident_fleet.nodes.leader_topic import LeaderTopic
from trident_fleet.nodes.params import warn_of_unknown
from trident_fleet.nodes.tasks.conversion import time_of
from trident_fleet.nodes.tasks.settings import CoordinatorSettings, read_settings
from trident_fleet.nodes.tasks.topic_port import TopicPort
from trident_ros import Refusals, init_node


class Coordinator:
    """A member on its topics, with its robot's pose and goal."""

    def __init__(self, settings: CoordinatorSettings) -> None:
        """Advertise and subscribe, after rospy.init_node()."""
        self._settings, self._refusals = settings, Refusals()
        self._port = TopicPort(
            settings.name,
            settings.team.members,
            settings.frame,
            settings.wiring,
            self._refusals,
        )
        self._place: Point | None = None
        self._goal: Point | None = None
        self._said: Counter[str] = Counter()
        self._reported: set[str] = set()
        self._pose = LeaderTopic(settings.pose_topic, settings.name)
        self._goals = rospy.Publisher(settings.goal_topic, PoseStamped, queue_size=1, latch=True)
        self._start(False)

    def _start(self, restarted: bool) -> None:
        settings, plan = self._settings, None
        if settings.is_robot:
            can = settings.team.robots[settings.name]
            place = self._place or (0.0, 0.0, 0.0)
            plan = Plan(settings.name, can, place, objective=settings.objective)
        self._member = Member(self._port, settings.team, settings.method, plan, restarted=restarted)
        robot = self._member.robot
        self._worker = Worker(robot, settings.reach_m) if robot is not None else None

    def run(self) -> None:
        """Until the node is shut down.

        Raises:
            FormationError: the robot's pose is of a type that is not known.
        """
        rate = rospy.Rate(1.0 / self._settings.step_s)
        while not rospy.is_shutdown():
            self._step()
            try:
                rate.sleep()
            except rospy.ROSTimeMovedBackwardsException:
                self._refusals.note(
                    "/clock went back", "/clock went back: this member starts again"
                )
                rate = rospy.Rate(1.0 / self._settings.step_s)
                self._start(True)
            except rospy.ROSInterruptException:
                return

    def _step(self) -> None:
        if self._worker is not None and not self._knows_its_place():
            # It must not bid; what it does not hear is said again.
            self._port.receive()
            return
        self._member.spin()
        if self._worker is not None and self._place is not None:
            self._drive(self._worker, self._place)
        self._report()

    def _knows_its_place(self) -> bool:
        return self._pose.try_subscribe(self._take_pose) and self._place is not None

    def _drive(self, worker: Worker, place: Point) -> None:
        now_s = self._port.now()
        goal = worker.goal(now_s)
        if goal is not None and goal != self._goal:
            self._publish_goal(goal, now_s)
        self._goal = goal
        came = worker.at(place, now_s)
        for task_id, what in ((came.begun, "begins"), (came.done, "has done")):
            if task_id:
                rospy.loginfo("%s %s %s", self._settings.name, what, task_id)
        self._member.send(list(came.sent))

    def _publish_goal(self, goal: Point, now_s: float) -> None:
        pose = PoseStamped()
        pose.header.stamp, pose.header.frame_id = time_of(now_s), self._settings.frame
        pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = goal
        pose.pose.orientation.w = 1.0
        self._goals.publish(pose)

    def _take_pose(self, _stamp_ns: int, decode: Callable[[], Measurement | None]) -> None:
        measured = decode()
        if measured is None:
            return
        x, y, z = (float(value) for value in measured.position)
        if not math.isfinite(x + y + z):
            self._pose.refuse(f"position is ({x:g}, {y:g}, {z:g}), legal: finite")
            return
        self._place = (x, y, z)

    def _report(self) -> None:
        """Bad input is counted in /diagnostics; why a task will not be done is logged once."""
        follower, manager = self._member.follower, self._member.manager
        for text in (follower.problems - self._said).elements():
            self._refusals.note("tasks refused", text)
        self._said = Counter(follower.problems)
        if manager is not None and manager.on_duty:
            for task_id, reason in manager.ledger.reasons.items():
                self._warn_once(f"task {task_id}: {reason}")

    def _warn_once(self, text: str) -> None:
        if text not in self._reported:
            rospy.logwarn(text)
        self._reported.add(text)


def main() -> int:
    """Run until the node is shut down.

    Returns:
        Exit code of the process.
    """
    init_node("cnp_coordinator")
    try:
        get = Recorded(_parameter)
        name = rospy.get_namespace().strip("/") or rospy.get_name().strip("/")
        settings = read_settings(get, name)
        warn_of_unknown(get.asked)
        Coordinator(settings).run()
    except FormationError as error:
        rospy.logfatal("cnp_coordinator: %s", error)
        return 1
    except rospy.ROSException as error:
        if not rospy.core.is_shutdown_requested():
            rospy.logfatal("cnp_coordinator: %s", error)
            return 1
    return 0


def _parameter(name: str) -> object:
    """The node's own parameter, else that of the team."""
    value = rospy.get_param("~" + name, None)
    return rospy.get_param(f"/team/{name}", None) if value is None else value
