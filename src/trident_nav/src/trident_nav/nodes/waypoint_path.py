# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Tells a guidance its path once: `path` (nav_msgs/Path), latched.

Parameters: `~waypoints`, a list of [x, y]: ahead and left of the start [m]; `~start`, [x, y, yaw]
of it in the frame `~frame` [m, rad]; `~vehicle`, by whose name it enrols in a simulator's lockstep:
the path is stamped with the first period's end, which the world does not pass before the vehicle's
controller has confirmed it.
"""

from __future__ import annotations

import threading

import rospy
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path

from trident_msgs.srv import EnrollSource
from trident_nav.core.errors import NavError
from trident_nav.core.places import from_start

_ENROLL = "/gazebo/enroll_source"
_SERVICE_LIMIT_S = 10.0
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


def enrol(vehicle: str) -> rospy.Time | None:
    """Have a simulator's lockstep wait for the path.

    Returns:
        The time from which the path counts; None without a simulator that waits.
    """
    period = rospy.Duration(0, _PERIOD_NS)
    try:
        rospy.wait_for_service(_ENROLL, timeout=_SERVICE_LIMIT_S)
        ask = rospy.ServiceProxy(_ENROLL, EnrollSource)
        start: rospy.Time = ask(
            rospy.get_name(), [vehicle], period, rospy.Time(0, 0), True
        ).start_time
        # One set-point is all that there will be.
        ask(rospy.get_name(), [vehicle], period, start + period, True)
    except (rospy.ROSException, rospy.ServiceException) as error:
        rospy.loginfo("waypoint_path: no lockstep: %s", error)
        return None
    return start


def main() -> int:
    """Run until the node is shut down.

    Returns:
        Exit code of the process.
    """
    rospy.init_node("waypoint_path")
    vehicle = str(rospy.get_param("~vehicle", ""))
    try:
        path = path_message()
    except NavError as error:
        rospy.logfatal("waypoint_path: %s", error)
        return 1
    publisher = rospy.Publisher("path", Path, queue_size=1, latch=True)
    start = enrol(vehicle) if vehicle else None
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
