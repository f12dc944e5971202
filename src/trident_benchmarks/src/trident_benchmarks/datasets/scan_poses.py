# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Poses at the stamps of scans, as the transforms that they need become known."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Any

import numpy as np
import rospy
from scipy.spatial.transform import Rotation
from trident_eval.slam.trajectory import Trajectory

Lookup = Callable[[rospy.Time], Any]
"""The geometry_msgs/Transform at a stamp, or None while it is not known."""


class Poses:
    """Stamped poses that grow."""

    def __init__(self) -> None:
        """Begin empty."""
        self._rows: list[tuple[float, ...]] = []

    def add(self, stamp: rospy.Time, p: Any, q: Any) -> None:
        """One pose; `p` and `q` are messages."""
        self._rows.append((stamp.to_sec(), p.x, p.y, p.z, q.x, q.y, q.z, q.w))

    def __len__(self) -> int:
        return len(self._rows)

    def trajectory(self) -> Trajectory:
        """All of them."""
        rows = np.array(self._rows)
        return Trajectory(rows[:, 0], rows[:, 1:4], Rotation.from_quat(rows[:, 4:]))


class ScanPoses:
    """Collects the pose at each scan of a drive, in order; not thread-safe."""

    def __init__(self, lookup: Lookup) -> None:
        """`lookup`: of the pose of the robot in the map."""
        self.poses = Poses()
        self._lookup = lookup
        self._waiting: deque[rospy.Time] = deque()
        self._newest = rospy.Time()

    def add(self, stamp: rospy.Time) -> None:
        """A scan was heard."""
        self._newest = stamp
        self._waiting.append(stamp)

    def lag_s(self) -> float:
        """How much older than the newest scan the oldest one is whose pose is not known [s]."""
        self._collect()
        return float((self._newest - self._waiting[0]).to_sec()) if self._waiting else 0.0

    def is_complete(self) -> bool:
        """Whether no scan waits for its pose."""
        self._collect()
        return not self._waiting

    def _collect(self) -> None:
        """Take the poses that are known by now.

        A scan that is older than the first transform never gets one. It is left out as soon as a
        later scan has its own: what stands still until it comes would stand forever.
        """
        known = [self._lookup(stamp) for stamp in self._waiting]
        last = max((index for index, pose in enumerate(known) if pose is not None), default=-1)
        for pose in known[: last + 1]:
            stamp = self._waiting.popleft()
            if pose is not None:
                self.poses.add(stamp, pose.translation, pose.rotation)
