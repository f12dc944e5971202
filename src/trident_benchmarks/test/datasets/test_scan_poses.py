# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Poses at scans, from transforms that come late, or not at all."""

from __future__ import annotations

from typing import Any

import pytest
import rospy
from geometry_msgs.msg import Quaternion, Transform, Vector3
from trident_benchmarks.datasets.scan_poses import ScanPoses


class Transforms:
    """Known from one time to another, x is the time."""

    def __init__(self) -> None:
        self.begin_s, self.end_s = 0.0, -1.0

    def at(self, stamp: rospy.Time) -> Any:
        if not self.begin_s <= stamp.to_sec() <= self.end_s:
            return None
        return Transform(Vector3(stamp.to_sec(), 0.0, 0.0), Quaternion(0.0, 0.0, 0.0, 1.0))


@pytest.fixture
def known() -> Transforms:
    return Transforms()


@pytest.fixture
def scans(known: Transforms) -> ScanPoses:
    """Five scans, 0.1 s apart from 1.0 s on."""
    scans = ScanPoses(known.at)
    for n in range(5):
        scans.add(rospy.Time.from_sec(1.0 + 0.1 * n))
    return scans


def times(scans: ScanPoses) -> list[float]:
    return [round(float(t), 3) for t in scans.poses.trajectory().stamp]


def test_poses_are_taken_as_transforms_come(known: Transforms, scans: ScanPoses) -> None:
    assert scans.lag_s() == pytest.approx(0.4)
    known.end_s = 1.25
    assert scans.lag_s() == pytest.approx(0.1)
    assert not scans.is_complete()
    known.end_s = 2.0
    assert scans.is_complete()
    assert times(scans) == [1.0, 1.1, 1.2, 1.3, 1.4]


def test_a_scan_before_the_first_transform_keeps_nobody_waiting(
    known: Transforms, scans: ScanPoses
) -> None:
    """slam_room stood forever: the first transforms had gone by before the tour could hear them."""
    known.begin_s, known.end_s = 1.15, 1.35
    assert scans.lag_s() == pytest.approx(0.0)
    known.end_s = 2.0
    assert scans.is_complete()
    assert times(scans) == [1.2, 1.3, 1.4]


def test_nothing_is_behind_when_nothing_waits(known: Transforms) -> None:
    scans = ScanPoses(known.at)
    assert scans.lag_s() == 0.0
    assert scans.is_complete()
