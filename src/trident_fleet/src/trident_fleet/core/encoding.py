# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Set-points as serialised trajectory_msgs/MultiDOFJointTrajectory, many points at a time.

Building the message objects in Python would take milliseconds; every point has the same size, so
all of them are one structured array, and a message is a header and a slice of it.
"""

from __future__ import annotations

import math
import struct

import numpy as np
import numpy.typing as npt

from trident_fleet.core.quintic import Motion

NS_PER_S = 1_000_000_000

# trajectory_msgs/MultiDOFJointTrajectoryPoint with one joint, little endian, unpadded.
_POINT = np.dtype(
    [
        ("transform_count", "<u4"),
        ("translation", "<f8", 3),
        ("rotation", "<f8", 4),
        ("velocity_count", "<u4"),
        ("linear_velocity", "<f8", 3),
        ("angular_velocity", "<f8", 3),
        ("acceleration_count", "<u4"),
        ("linear_acceleration", "<f8", 3),
        ("angular_acceleration", "<f8", 3),
        ("seconds", "<i4"),
        ("nanoseconds", "<i4"),
    ]
)
_JOINT = b"base_link"
_FRAME = b"world"


def encode_points(
    motion: Motion, vehicle: int, yaw_rad: float, time_from_start_ns: npt.NDArray[np.int64]
) -> npt.NDArray[np.void]:
    """Serialise one vehicle's samples.

    Args:
        motion: M samples of the fleet.
        vehicle: whose samples.
        yaw_rad: heading, constant [rad, world].
        time_from_start_ns: of each sample from its message's stamp [ns], shape (M,).

    Returns:
        M serialised points, one array element each.
    """
    points = np.zeros(len(time_from_start_ns), dtype=_POINT)
    for count in ("transform_count", "velocity_count", "acceleration_count"):
        points[count] = 1
    points["translation"] = motion.position[:, vehicle]
    points["rotation"] = (0.0, 0.0, math.sin(yaw_rad / 2.0), math.cos(yaw_rad / 2.0))
    points["linear_velocity"] = motion.velocity[:, vehicle]
    points["linear_acceleration"] = motion.acceleration[:, vehicle]
    points["seconds"] = time_from_start_ns // NS_PER_S
    points["nanoseconds"] = time_from_start_ns % NS_PER_S
    return points


def encode_turning_points(
    motion: Motion,
    vehicle: int,
    turn: tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]],
    time_from_start_ns: npt.NDArray[np.int64],
) -> npt.NDArray[np.void]:
    """The same for a heading that changes: `turn` is yaw [rad] and yaw rate [rad/s], shape (M,)."""
    points = encode_points(motion, vehicle, 0.0, time_from_start_ns)
    yaw, yaw_rate = turn
    points["rotation"][:, 2] = np.sin(yaw / 2.0)
    points["rotation"][:, 3] = np.cos(yaw / 2.0)
    points["angular_velocity"][:, 2] = yaw_rate
    return points


def encode_message(stamp_ns: int, points: npt.NDArray[np.void]) -> bytes:
    """A whole serialised message: frame `world`, joint `base_link`, the given points."""
    head = struct.pack(
        f"<IIII{len(_FRAME)}sII{len(_JOINT)}sI",
        0,
        *divmod(stamp_ns, NS_PER_S),
        len(_FRAME),
        _FRAME,
        1,
        len(_JOINT),
        _JOINT,
        len(points),
    )
    return head + points.tobytes()


def sample_times(start_ns: int, period_ns: int, point_ns: int) -> npt.NDArray[np.float64]:
    """Times of the points of one period that begins at `start_ns`, in seconds."""
    return (start_ns + np.arange(0, period_ns, point_ns, dtype=np.int64)) / NS_PER_S
