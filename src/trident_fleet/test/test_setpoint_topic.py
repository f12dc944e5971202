# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

pytest.importorskip("trident.testing", reason="the workspace is not built or sourced")
pytest.importorskip("rospy", reason="ROS is not installed")

import rospy
from trident.testing import Ros
from trident.testing.pytest_plugin import ros, session_ros
from trident_fleet.nodes.setpoint_topic import SetpointTopic

__all__ = ["ros", "session_ros"]


def test_flights_that_start_over_answer_a_foreign_command_once(ros: Ros) -> None:
    topic = SetpointTopic("/UAV1/", keep=7)
    for _ in range(3):
        topic.guard()
    other = rospy.Subscriber(topic.topic, rospy.AnyMsg)  # without a callback of its own
    assert len(other.impl.callbacks) == 1
    other.unregister()
