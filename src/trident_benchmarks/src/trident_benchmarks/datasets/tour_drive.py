# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Drives a robot in lockstep: the world steps from odometry to odometry as each is answered.

The launch file declares it in /gazebo/answers. What is waited for in between, a node that starts or
a transform, stops the world and not the clock on the wall, so that the drive is the same to the bit
however long that takes.
"""

from __future__ import annotations

import math
import queue
import time
import xmlrpc.client
from collections.abc import Callable
from typing import Any

import rosgraph
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from trident_nav.core.velocity import STOP, Velocity
from trident_nav.core.waypoints import WaypointFollower

from trident_ros import Refusals, pose_problem, stamp_problem

SIMULATOR = "/gazebo"
_POLL_S = 0.02
_REPORT_S = 10.0

Check = Callable[[], None]
"""Is called while something is waited for; raises what ends the wait."""


class LockstepDriver:
    """Odometry in, Twists out."""

    def __init__(self, check: Check, may_step: Callable[[], bool]) -> None:
        """Advertise and subscribe.

        Args:
            check: raises what ends a wait.
            may_step: whether the world may pass the odometry that was heard last.
        """
        self._check, self._may_step = check, may_step
        # No SimpleQueue: its get() with a timeout waits for ever after a signal whose handler
        # takes longer than that, as rospy's does (CPython 3.11).
        self._heard: queue.Queue[Odometry] = queue.Queue()
        self._open: Odometry | None = None  # was heard, and is not answered yet
        self._velocity = rospy.Publisher("cmd_vel", Twist, queue_size=10, tcp_nodelay=True)
        self._refusals = Refusals()
        rospy.Subscriber("ground_truth/odom", Odometry, self._on_odometry, tcp_nodelay=True)

    def _on_odometry(self, odometry: Odometry) -> None:
        problem = pose_problem(odometry.pose.pose) or stamp_problem(odometry.header.stamp)
        if problem:
            self._refusals.note("odometry refused", f"odometry refused: {problem}")
            return
        self._heard.put(odometry)

    def stand(self, seconds: float) -> None:
        """Stand still for an amount of simulated time; afterwards the world stands, too."""
        begin: float | None = None
        while True:
            odometry = self._next()
            stamp = odometry.header.stamp.to_sec()
            begin = stamp if begin is None else begin
            self._answer(STOP)
            if stamp - begin >= seconds - 1e-6:
                self._wait_until_it_stands()
                return

    def drive(self, follower: WaypointFollower, limit_s: float) -> bool:
        """Drive to the last waypoint; afterwards the world stands.

        Args:
            follower: what says how, in the world's frame.
            limit_s: simulated time that it may take [s].

        Returns:
            Whether it has been reached.
        """
        begin: float | None = None
        while not follower.is_done:
            odometry = self._next()
            stamp = odometry.header.stamp.to_sec()
            begin = stamp if begin is None else begin
            place, q = odometry.pose.pose.position, odometry.pose.pose.orientation
            yaw = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
            velocity = follower.command(stamp, (place.x, place.y, yaw))
            self.wait(self._may_step, "the transforms of the scans")
            self._answer(velocity)
            if stamp - begin > limit_s:
                break
        self._wait_until_it_stands()
        return follower.is_done

    def wait(self, condition: Callable[[], bool], what: str) -> None:
        """Return when it holds; the world stands meanwhile. Logs what it waits for."""
        reported = time.monotonic()
        while not condition():
            self._check()
            if time.monotonic() - reported > _REPORT_S:
                reported = time.monotonic()
                rospy.logwarn("slam_tour: waiting for %s", what)
            rospy.rostime.wallsleep(_POLL_S)

    def _wait_until_it_stands(self) -> None:
        """Return when the world has come to the next odometry, where it waits for an answer.

        Until then it moves, and what is started or asked meanwhile would find it where chance says.
        """
        self._open = self._next()

    def _next(self) -> Odometry:
        """The next odometry; it comes when the last one has been answered."""
        if self._open is not None:
            odometry, self._open = self._open, None
            return odometry
        reported = time.monotonic()
        while True:
            try:
                return self._heard.get(timeout=_POLL_S)
            except queue.Empty:
                self._check()
                if time.monotonic() - reported > _REPORT_S:
                    reported = time.monotonic()
                    rospy.logwarn("slam_tour: waiting for the robot's odometry")

    def _answer(self, velocity: Velocity) -> None:
        message = Twist()
        message.linear.x, message.angular.z = velocity
        self._velocity.publish(message)


def is_sent(sender: str, topics: tuple[str, ...], reader: str) -> bool:
    """Whether a node is connected to another one that reads these topics, by its own account."""
    master = rosgraph.Master(rospy.get_name())
    try:
        server: Any = xmlrpc.client.ServerProxy(master.lookupNode(sender))
        links: list[Any] = server.getBusInfo(rospy.get_name())[2]
    except (OSError, rosgraph.MasterError, xmlrpc.client.Error):
        return False
    return set(topics) <= {link[4] for link in links if link[1] == reader and link[2] == "o"}
