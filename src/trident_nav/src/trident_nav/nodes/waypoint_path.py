# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Sends a guidance its path once: `path` (nav_msgs/Path), latched.

Parameters: `~waypoints`, a list of [x, y]: ahead and left of the start [m]; `~start`, [x, y, yaw]
of it in the frame `~frame` [m, rad]; `~vehicle`, by whose name it enrols in a simulator's lockstep:
the path is stamped with the first period's end, which the world does not pass before the vehicle's
controller has confirmed it.
"""

from __future__ import annotations

import threading
import time

import rospy
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path

from trident_msgs.srv import EnrollSource, EnrollSourceResponse
from trident_nav.core.errors import NavError
from trident_nav.core.places import from_start
from trident_ros import (
    MISSION_PARAMETERS,
    init_node,
    is_offered,
    quoted,
    stamp_problem,
    warn_of_unknown_parameters,
)

_ENROLL = "/gazebo/enroll_source"
_SPAWN = "/gazebo/spawn_urdf_model"
_REPORT_S, _POLL_S = 10.0, 0.05
_PERIOD_NS = 100_000_000
_REPEAT_S = 0.5


def path_message() -> Path:
    """The path of the parameters.

    Raises:
        NavError: an illegal one.
    """
    start, waypoints = rospy.get_param("~start", None), rospy.get_param("~waypoints", None)
    message = Path()
    message.header.frame_id = str(rospy.get_param("~frame", "world"))
    for x, y in from_start(start, waypoints):
        pose = PoseStamped()
        pose.header.frame_id = message.header.frame_id
        pose.pose.position.x, pose.pose.position.y = float(x), float(y)
        pose.pose.orientation.w = 1.0
        message.poses.append(pose)
    return message


def enroll(vehicle: str) -> rospy.Time | None:
    """Have a simulator's lockstep wait for the path.

    Returns:
        The time from which the path counts; None without a simulator that waits.
    """
    if not offers_lockstep():
        return None
    ask = rospy.ServiceProxy(_ENROLL, EnrollSource)
    period = rospy.Duration(0, _PERIOD_NS)
    source = {"node": rospy.get_name(), "vehicles": [vehicle], "period": period, "enroll": True}
    try:
        answer = ask(**source)
        if not enrollment_problem(answer):
            # One set-point is all that there will be.
            answer = ask(end_time=answer.start_time + period, **source)
    except (rospy.ROSException, rospy.ServiceException) as error:
        rospy.logwarn("waypoint_path: %s: %s", _ENROLL, error)
        return None
    problem = enrollment_problem(answer)
    if problem:
        rospy.logwarn("waypoint_path: %s: %s", _ENROLL, problem)
        return None
    start: rospy.Time = answer.start_time
    return start


def enrollment_problem(answer: EnrollSourceResponse) -> str:
    """Why a path does not count from this answer's time on, or ""."""
    if not answer.success:
        return f"refused: {quoted(answer.message)}"
    return stamp_problem(answer.start_time)


def offers_lockstep() -> bool:
    """Whether the simulator waits for set-points.

    In simulated time this returns when there is a simulator, however long that takes. Ours offers
    lockstep before it offers to spawn, so that it is never taken for another one.
    """
    if not rospy.get_param("/use_sim_time", False):
        return False
    reported = time.monotonic()
    while not rospy.is_shutdown():
        is_there = is_offered(_SPAWN)
        if is_offered(_ENROLL):
            return True
        if is_there:
            rospy.loginfo("waypoint_path: no service %s: no lockstep", _ENROLL)
            return False
        if time.monotonic() - reported > _REPORT_S:
            reported = time.monotonic()
            rospy.logwarn("waypoint_path: no simulator yet, still waiting")
        rospy.rostime.wallsleep(_POLL_S)
    return False


def main() -> int:
    """Run until the node is shut down.

    Returns:
        Exit code of the process.
    """
    init_node("waypoint_path")
    warn_of_unknown_parameters((*MISSION_PARAMETERS, "waypoints", "frame", "vehicle"))
    vehicle = str(rospy.get_param("~vehicle", ""))
    try:
        path = path_message()
    except NavError as error:
        rospy.logfatal("waypoint_path: %s", error)
        return 1
    publisher = rospy.Publisher("path", Path, queue_size=1, latch=True)
    start = enroll(vehicle) if vehicle else None
    if start is not None:
        path.header.stamp = start
    publisher.publish(path)
    repeat_until_used(publisher, path, start)
    rospy.spin()
    return 0


def repeat_until_used(publisher: rospy.Publisher, path: Path, start: rospy.Time | None) -> None:
    """Send it again while the world stands still before its stamp.

    A controller's confirmation gets lost when it comes before the simulator listens.
    """
    never = threading.Event()
    while start is not None and not rospy.is_shutdown():
        never.wait(_REPEAT_S)
        if rospy.get_rostime() >= start:
            return
        publisher.publish(path)
