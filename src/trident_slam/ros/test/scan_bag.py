# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A recorded drive through a room of boxes, with drifting odometry, and how nodes are fed it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import rosbag
import rospy
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import Imu, LaserScan
from tf2_msgs.msg import TFMessage
from trident.testing import LIMIT_S, Process, Recorder, Ros, program

#: x0, y0, x1, y1 [m]: the room, seen from inside, and what stands in it.
ROOM = (-4.0, -3.0, 4.0, 3.0)
BOXES = ((-2.5, 1.0, -1.5, 2.0), (1.0, -2.0, 2.5, -1.2), (2.8, 1.5, 3.6, 2.2))
BEAMS = 180
START_S = 1000
SCAN_PERIOD_S = 0.1
SWEEP_S = 0.08  # from a scan's first beam to its last
TRUTH_PERIOD_S = 0.05
IMU_PERIOD_S = 0.01
MOUNT_M = 0.1  # of the laser before the base


def ranges(x: np.ndarray, y: np.ndarray, yaw: np.ndarray) -> np.ndarray:
    """True ranges [m] of a full turn of beams, each from its own place in the room."""
    angle = yaw + np.linspace(-math.pi, math.pi, BEAMS, endpoint=False)
    directions = np.column_stack([np.cos(angle), np.sin(angle)])
    place = np.column_stack([x, y])
    with np.errstate(divide="ignore"):
        far = np.max((np.array(ROOM).reshape(2, 2)[:, None] - place) / directions, axis=0)
        nearest = far.min(axis=1)
        for box in BOXES:
            to = (np.array(box).reshape(2, 2)[:, None] - place) / directions
            enter, leave = to.min(axis=0).max(axis=1), to.max(axis=0).min(axis=1)
            nearest = np.where((enter < leave) & (enter > 0), np.minimum(nearest, enter), nearest)
    return nearest


def path(time_s: np.ndarray) -> np.ndarray:
    """True poses x, y, yaw along an oval at times since the start, shape (N, 3)."""
    phase = 2.0 * math.pi * time_s / (150 * TRUTH_PERIOD_S)
    x, y = 1.2 * np.sin(phase), 0.5 * (1.0 - np.cos(phase))
    yaw = np.arctan2(0.5 * np.sin(phase), 1.2 * np.cos(phase))
    return np.column_stack([x, y, np.unwrap(yaw)])


def transform(parent: str, child: str, stamp: rospy.Time, pose: np.ndarray) -> TFMessage:
    """A message with one planar transform."""
    message = TransformStamped()
    message.header.frame_id, message.header.stamp, message.child_frame_id = parent, stamp, child
    message.transform.translation.x, message.transform.translation.y = pose[0], pose[1]
    message.transform.rotation.z = math.sin(0.5 * pose[2])
    message.transform.rotation.w = math.cos(0.5 * pose[2])
    return TFMessage([message])


def write_bag(file: Path, scans: int = 60, tf_delay_s: float = 0.03, imu_s: float = 0.0) -> None:
    """Record a drive; odometry comes at 20 Hz, `tf_delay_s` later than its stamp.

    Beams are measured one after the other, so that scans are skewed. An IMU that hangs upside down
    measures the turning rate for the first `imu_s` seconds.
    """
    rng = np.random.default_rng(5)
    truth = path(TRUTH_PERIOD_S * np.arange(2 * scans + 4))
    drift = np.cumsum(rng.normal(0.0, 0.002, truth.shape), axis=0)
    with rosbag.Bag(str(file), "w") as bag:
        first = rospy.Time(START_S)
        bag.write(
            "/tf_static",
            transform("base_footprint", "laser", first, np.array([MOUNT_M, 0, 0])),
            first,
        )
        bag.write("/tf_static", upside_down("base_footprint", "imu", first), first)
        for message in turning_rates(min(imu_s, TRUTH_PERIOD_S * len(truth))):
            bag.write("/imu", message, message.header.stamp)
        for index, pose in enumerate(truth):
            stamp = rospy.Time.from_sec(START_S + TRUTH_PERIOD_S * index)
            odometry = transform("odom", "base_footprint", stamp, pose + drift[index])
            bag.write("/tf", odometry, stamp + rospy.Duration.from_sec(tf_delay_s))
        for index in range(scans):
            # Between two samples of odometry.
            start_s = 0.02 + SCAN_PERIOD_S * index
            stamp = rospy.Time.from_sec(START_S + start_s)
            beams = path(start_s + np.linspace(0.0, SWEEP_S, BEAMS))
            bag.write("/scan", scan(stamp, beams, rng), stamp)


def upside_down(parent: str, child: str, stamp: rospy.Time) -> TFMessage:
    """A transform that turns by half a turn about x."""
    message: TFMessage = transform(parent, child, stamp, np.zeros(3))
    rotation = message.transforms[0].transform.rotation
    rotation.x, rotation.w = 1.0, 0.0
    return message


def turning_rates(end_s: float) -> list[Imu]:
    """What the IMU measures until `end_s` after the start."""
    if end_s <= 0.0:
        return []
    time_s = np.arange(0.0, end_s, IMU_PERIOD_S)
    rates = np.gradient(path(time_s)[:, 2], time_s)
    messages = []
    for at, rate in zip(time_s, rates, strict=True):
        message = Imu()
        message.header.stamp, message.header.frame_id = rospy.Time.from_sec(START_S + at), "imu"
        message.angular_velocity.z = -rate
        messages.append(message)
    return messages


def scan(stamp: rospy.Time, poses: np.ndarray, rng: np.random.Generator) -> LaserScan:
    """What the laser of a robot sees, with a centimetre of noise; `poses`: of it at each beam."""
    message = LaserScan(angle_min=-math.pi, angle_max=math.pi, range_min=0.1, range_max=12.0)
    message.header.stamp, message.header.frame_id = stamp, "laser"
    message.angle_increment = 2.0 * math.pi / BEAMS
    message.time_increment = SWEEP_S / (BEAMS - 1)
    x, y, yaw = poses.T
    x, y = x + MOUNT_M * np.cos(yaw), y + MOUNT_M * np.sin(yaw)
    message.ranges = list(ranges(x, y, yaw) + rng.normal(0.0, 0.01, BEAMS))
    return message


def diagnosed(seen: Recorder, key: str) -> str:
    """The newest value of a key of the node's diagnostics, or ''."""
    for array in reversed(seen.messages):
        for status in array.status:
            if status.name.endswith("SLAM"):
                return next(pair.value for pair in status.values if pair.key == key)
    return ""


def start_slam(
    ros: Ros,
    package: str,
    node: str,
    *words: str,
    name: str = "",
    parameters: Mapping[str, Any] | None = None,
) -> Process:
    """Start a node that takes its time from a bag; its name is that of the program by default."""
    name = name or node
    ros.set_param("/use_sim_time", True)
    if parameters:
        ros.set_param(f"/{name}", dict(parameters))
    return ros.launch([program(package, node), f"__name:={name}", *words])


def play(ros: Ros, bag: Path, *words: str) -> None:
    command = ["rosbag", "play", "--quiet", "--clock", "--wait-for-subscribers", *words, str(bag)]
    ros.call(*command)


def service(name: str, kind: type) -> rospy.ServiceProxy:
    rospy.wait_for_service(name, LIMIT_S)
    return rospy.ServiceProxy(name, kind)
