# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Drives a robot from waypoint to waypoint: `odom` in, `cmd_vel` out.

Parameters: `~waypoints`, a list of [x, y] [m] in the frame of `odom`, or `~waypoints_file`, a YAML
file with such a list, or one with `waypoints` in it; `~answers_always`: whether it continues
to command rest when it is done, for a world that waits for the answer to each odometry; the others:
see FollowerConfig. `path` (nav_msgs/Path) and `~done` (std_msgs/Bool) are latched.
"""

from __future__ import annotations

import math
from pathlib import Path as FilePath
from typing import Any

import rospy
import yaml
from geometry_msgs.msg import PoseStamped, Twist
from nav_msgs.msg import Odometry, Path
from std_msgs.msg import Bool
from trident_base.params import unknown

from trident_nav.core.errors import NavError
from trident_nav.core.velocity import Velocity
from trident_nav.core.waypoints import FollowerConfig, WaypointFollower
from trident_nav.nodes.params import read_config, twist
from trident_ros import MISSION_PARAMETERS, Refusals, init_node, pose_problem, stamp_problem

_OWN = ("waypoints", "waypoints_file", "answers_always")


class FollowerNode:
    """The follower between topics."""

    def __init__(self) -> None:
        """Read the parameters.

        Raises:
            NavError: an illegal one.
        """
        config = read_config(FollowerConfig, (*MISSION_PARAMETERS, *_OWN))
        self._waypoints = read_waypoints()
        self._follower = WaypointFollower(self._waypoints, config)
        self._is_loop = config.loop
        self._answers_always = bool(rospy.get_param("~answers_always", False))
        self._path_frame = ""
        self._was_done = False
        self._refusals = Refusals()
        self._velocity = rospy.Publisher("cmd_vel", Twist, queue_size=1, tcp_nodelay=True)
        self._path = rospy.Publisher("path", Path, queue_size=1, latch=True)
        self._done = rospy.Publisher("~done", Bool, queue_size=1, latch=True)
        self._done.publish(Bool(False))
        rospy.Subscriber("odom", Odometry, self._on_odometry, queue_size=1, tcp_nodelay=True)

    def _on_odometry(self, odometry: Odometry) -> None:
        problem = pose_problem(odometry.pose.pose) or stamp_problem(odometry.header.stamp)
        if problem:
            self._refusals.note("odometry refused", f"odometry refused: {problem}")
            return
        self._show_path_in(odometry.header.frame_id)
        position, q = odometry.pose.pose.position, odometry.pose.pose.orientation
        yaw = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
        time_s = odometry.header.stamp.to_sec()
        velocity = self._follower.command(time_s, (position.x, position.y, yaw))
        is_done = self._follower.is_done
        if is_done and self._was_done and not self._answers_always:
            return  # the next driver is not to be stopped
        self._publish(velocity, is_done)

    def _show_path_in(self, frame: str) -> None:
        """Publishes the path again if odometry is in another frame than before."""
        if frame != self._path_frame:
            self._path_frame = frame
            self._path.publish(self._path_message())

    def _publish(self, velocity: Velocity, is_done: bool) -> None:
        try:
            self._velocity.publish(twist(velocity))
            if is_done != self._was_done:
                self._was_done = is_done
                self._done.publish(Bool(is_done))
        except rospy.ROSException:
            # Topics close when rospy begins to shut down.
            if not rospy.core.is_shutdown_requested():
                raise

    def _path_message(self) -> Path:
        message = Path()
        message.header.frame_id = self._path_frame
        points = [*self._waypoints, *(self._waypoints[:1] if self._is_loop else [])]
        for x, y in points:
            pose = PoseStamped()
            pose.header.frame_id = self._path_frame
            pose.pose.position.x, pose.pose.position.y = x, y
            pose.pose.orientation.w = 1.0
            message.poses.append(pose)
        return message


def read_waypoints() -> list[list[float]]:
    """`~waypoints`, or what is in `~waypoints_file`.

    Raises:
        NavError: neither or both are there, or the file cannot be read.
    """
    points, file = rospy.get_param("~waypoints", None), rospy.get_param("~waypoints_file", "")
    if (points is None) == (not file):
        given = "neither" if points is None else "both"
        raise NavError(f"~waypoints, ~waypoints_file: {given} given, legal: one of them")
    if file:
        points = _read_file(FilePath(file))
    try:
        return [[float(value) for value in point] for point in points]
    except (TypeError, ValueError) as error:
        raise NavError(f"~waypoints: {points!r}, legal: a list of [x, y]") from error


def _read_yaml(path: FilePath) -> Any:
    if path.exists() and not path.is_file():
        raise NavError(f"{path}: no file; legal: a YAML file")
    try:
        return yaml.safe_load(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise NavError(f"{path}: cannot be read: {error.strerror}") from error
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        line = getattr(getattr(error, "problem_mark", None), "line", None)
        where = f"{path}:{line + 1}" if line is not None else str(path)
        raise NavError(f"{where}: not a YAML file") from error


def _read_file(path: FilePath) -> Any:
    found = _read_yaml(path)
    if isinstance(found, dict):
        for text in unknown(map(str, found), ["waypoints"]):
            raise NavError(f"{path}: {text}; legal: waypoints")
        found = found.get("waypoints")
    if not isinstance(found, list):
        raise NavError(f"{path}: holds no list of waypoints")
    return found


def main() -> int:
    """Run until the node is shut down.

    Returns:
        Exit code of the process.
    """
    init_node("waypoint_follower")
    try:
        FollowerNode()
    except NavError as error:
        rospy.logfatal("waypoint_follower: %s", error)
        return 1
    rospy.spin()
    return 0
