# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Tells a guidance its path once: `path` (nav_msgs/Path), latched.

Parameters: `~waypoints`, a list of [x, y]: ahead and left of the start [m]; `~start`, [x, y, yaw]
of it in the frame `~frame` [m, rad]; `~vehicle`, by whose name it enrols in a simulator's lockstep:
time zero is left when somebody in the vehicle's namespace has been given the path.
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
_POLL_S = 0.2


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


class Listener(rospy.SubscribeListener):  # type: ignore[misc]
    """Knows whether the path has been given to anybody."""

    def __init__(self) -> None:
        """Nobody has come yet."""
        super().__init__()
        self.has_reader = threading.Event()

    def peer_subscribe(self, topic_name: str, topic_publish: object, peer_publish: object) -> None:
        """A subscriber has come; latched messages have gone out to it (called by rospy)."""
        self.has_reader.set()


def enrol(vehicle: str) -> None:
    """Be counted among the sources that a simulator waits for; it waits for no set-point."""
    try:
        rospy.wait_for_service(_ENROLL, timeout=_SERVICE_LIMIT_S)
        ask = rospy.ServiceProxy(_ENROLL, EnrollSource)
        ask(rospy.get_name(), [vehicle], rospy.Duration(0, 100_000_000), rospy.Time(0, 1), True)
    except (rospy.ROSException, rospy.ServiceException) as error:
        rospy.loginfo("waypoint_path: no lockstep: %s", error)


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
    listener = Listener()
    publisher = rospy.Publisher(
        "path", Path, subscriber_listener=listener, queue_size=1, latch=True
    )
    publisher.publish(path)
    while not rospy.is_shutdown() and not listener.has_reader.wait(_POLL_S):
        pass
    if vehicle and not rospy.is_shutdown():
        enrol(vehicle)
    rospy.spin()
    return 0
