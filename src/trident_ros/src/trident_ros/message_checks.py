# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What of a message is checked where it comes in; the same as trident_ros/message_checks.h.

Each function returns "", or what is wrong: the field, its value, what is legal.
"""

from __future__ import annotations

import math
from typing import Any

#: Largest legal coordinate [m]; the earth's center is 6.4e6 m away.
FARTHEST_M = 1e8
#: Stamps below can be subtracted from each other in ROS, whose durations have 32 bits of seconds.
LATEST_STAMP_S = 2_147_000_000
_NS_PER_S = 1_000_000_000
_LONGEST_QUOTE = 200


def numbers_problem(name: str, *values: float, most: float = FARTHEST_M) -> str:
    """Whether all are finite, and none beyond `most`."""
    if all(abs(value) <= most for value in values):
        return ""
    shown = ", ".join(f"{value:g}" for value in values[:7])
    return f"{name} is ({shown}), legal: finite, up to +-{most:g}"


def point_problem(name: str, point: Any) -> str:
    """Of a message with x, y and z [m]."""
    return numbers_problem(name, point.x, point.y, point.z)


def pose_problem(pose: Any) -> str:
    """Of a geometry_msgs/Pose; the quaternion's length is to be 1 within 1 %."""
    problem = point_problem("position", pose.position)
    if problem:
        return problem
    q = pose.orientation
    length = math.hypot(q.x, q.y, q.z, q.w)
    if abs(length - 1.0) < 0.01:
        return ""
    return f"orientation is a quaternion of length {length:g}, legal: 1"


def stamp_problem(stamp: Any) -> str:
    """Of a time with `secs` and `nsecs`, as they are on the wire."""
    if stamp.nsecs >= _NS_PER_S:
        return f"stamp has {stamp.nsecs} ns, legal: below {_NS_PER_S}"
    if stamp.secs >= LATEST_STAMP_S:
        return f"stamp is {stamp.secs} s, legal: below {LATEST_STAMP_S}"
    return ""


def quoted(text: str) -> str:
    """Text that a stranger sent: without control characters, and 200 characters at most."""
    clean = "".join(letter if letter.isprintable() else "?" for letter in text[:_LONGEST_QUOTE])
    return clean + "..." if len(text) > _LONGEST_QUOTE else clean
