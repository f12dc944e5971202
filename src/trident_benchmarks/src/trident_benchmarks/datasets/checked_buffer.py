# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A buffer of transforms that refuses what would end the process."""

from __future__ import annotations

from typing import Any

import tf2_ros
from geometry_msgs.msg import Pose, TransformStamped

from trident_ros import Refusals, pose_problem, quoted, stamp_problem


def transform_problem(transform: TransformStamped) -> str:
    """Why this is no transform, or ""."""
    value = transform.transform
    problem = pose_problem(Pose(value.translation, value.rotation))
    return problem or stamp_problem(transform.header.stamp)


class CheckedBuffer(tf2_ros.Buffer):  # type: ignore[misc]
    """tf2 adds durations to stamps in C++, which throws beyond 32 bits of seconds.

    Nothing catches that between there and Python.
    """

    def __init__(self, *arguments: Any) -> None:
        """As tf2_ros.Buffer, after rospy.init_node()."""
        self._refusals = Refusals()
        super().__init__(*arguments)

    def set_transform(self, transform: TransformStamped, authority: str) -> None:
        """Keep it, unless it is illegal."""
        if self._is_sound(transform):
            super().set_transform(transform, authority)

    def set_transform_static(self, transform: TransformStamped, authority: str) -> None:
        """Keep it for all times, unless it is illegal."""
        if self._is_sound(transform):
            super().set_transform_static(transform, authority)

    def _is_sound(self, transform: TransformStamped) -> bool:
        problem = transform_problem(transform)
        if problem:
            frames = f"{quoted(transform.header.frame_id)} -> {quoted(transform.child_frame_id)}"
            self._refusals.note("transform refused", f"transform {frames} refused: {problem}")
        return not problem
