# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What messages of several types say of the pose of a robot."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from geometry_msgs.msg import Pose, Quaternion, Twist

from trident_fleet.core.follow.leader import Measurement, rotate, yaw_of
from trident_fleet.core.quintic import Array

Reader = Callable[[Any, str], Measurement | None]
"""Takes a message and the robot's name; None if the message does not contain it."""


def _read_fleet(state: Any, robot: str) -> Measurement | None:
    if robot not in state.name or not len(state.name) == len(state.pose) == len(state.twist):
        return None
    index = state.name.index(robot)
    pose, twist = state.pose[index], state.twist[index]
    return _measured(state.header, pose, _vector(twist.linear), twist.angular.z)


def _read_odometry(message: Any, _robot: str) -> Measurement:
    pose, twist = message.pose.pose, message.twist.twist
    return _measured(message.header, pose, *_in_world(pose.orientation, twist))


def _in_world(orientation: Quaternion, twist: Twist) -> tuple[Array, float]:
    """An odometry's twist is in its child frame."""
    quaternion = _quaternion(orientation)
    turn = rotate(quaternion, _vector(twist.angular))
    return rotate(quaternion, _vector(twist.linear)), float(turn[2])


def _read_pose(message: Any, _robot: str) -> Measurement:
    return _measured(message.header, message.pose)


def _read_pose_with_covariance(message: Any, _robot: str) -> Measurement:
    return _measured(message.header, message.pose.pose)


def _read_transform(message: Any, _robot: str) -> Measurement:
    transform = message.transform
    return _measured(message.header, Pose(transform.translation, transform.rotation))


READERS: dict[str, Reader] = {
    "trident_msgs/FleetState": _read_fleet,
    "nav_msgs/Odometry": _read_odometry,
    "geometry_msgs/PoseStamped": _read_pose,
    "geometry_msgs/PoseWithCovarianceStamped": _read_pose_with_covariance,
    "geometry_msgs/TransformStamped": _read_transform,
}


def _measured(
    header: Any, pose: Pose, velocity: Array | None = None, yaw_rate: float | None = None
) -> Measurement:
    return Measurement(
        stamp_ns=header.stamp.to_nsec(),
        position=_vector(pose.position),
        yaw_rad=yaw_of(_quaternion(pose.orientation)),
        velocity=velocity,
        yaw_rate=yaw_rate,
    )


def _vector(message: Any) -> Array:
    return np.array([message.x, message.y, message.z])


def _quaternion(message: Quaternion) -> tuple[float, float, float, float]:
    return message.x, message.y, message.z, message.w
