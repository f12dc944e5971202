# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import pytest

pytest.importorskip("rospy", reason="the workspace is not sourced")

from genpy import Time
from geometry_msgs.msg import Pose, PoseWithCovarianceStamped
from trident.testing.fuzz import Generator, non_finite

from trident_ros import numbers_problem, pose_problem, quoted, stamp_problem


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, 1e308, -1e9])
def test_numbers_that_are_none(bad: float) -> None:
    pose = Pose()
    pose.orientation.w = 1.0
    assert pose_problem(pose) == ""
    pose.position.y = bad
    assert "position is (0, " in pose_problem(pose)
    assert numbers_problem("range", 1.0, bad)


def test_a_quaternion_of_no_length() -> None:
    assert pose_problem(Pose()) == "orientation is a quaternion of length 0, legal: 1"


@pytest.mark.parametrize(("secs", "nsecs"), [(4_000_000_000, 0), (2**31, 0), (1, 2**32 - 1)])
def test_stamps_that_ros_cannot_subtract(secs: int, nsecs: int) -> None:
    stamp = Time(1_800_000_000)
    assert stamp_problem(stamp) == ""
    stamp.secs, stamp.nsecs = secs, nsecs
    assert stamp_problem(stamp)


def test_what_a_stranger_sent_is_quoted_short() -> None:
    assert quoted("a\n\x1b[31mb") == "a??[31mb"
    assert len(quoted("x" * 50_000)) == 203


def test_the_fuzzer_repeats_itself_and_sends_what_is_none() -> None:
    made = []
    for _ in range(2):
        generator = Generator(seed=5, now=lambda: 1000.0)
        messages = []
        for number in range(300):
            generator.begin(number)
            messages.append(generator.message(PoseWithCovarianceStamped))
        made.append([repr(message) for message in messages])
        assert any(non_finite(message) for message in messages)
        assert any(message.header.stamp.secs == 4_000_000_000 for message in messages)
        assert not all(non_finite(message) for message in messages)
    assert made[0] == made[1]
