# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Vehicles that speak MAVLink, under hostile messages of their sensors."""

from __future__ import annotations

from pathlib import Path

import pytest
import rospy
from geometry_msgs.msg import Twist
from hostile import Asked, answers_on, started
from nav_msgs.msg import Odometry
from trident.testing import Ros, program
from trident.testing.mavlink_vehicles import write_fleet


def odometry() -> Odometry:
    message = Odometry()
    message.header.stamp = rospy.Time.now()
    message.header.frame_id = "world"
    message.pose.pose.orientation.w = 1.0
    return message


@pytest.mark.fuzzes("trident_bridges/mavlink_vehicle_node")
def test_vehicles_of_all_kinds(ros: Ros, tmp_path: Path) -> None:
    ros.set_param("/fleet/vehicles_file", str(write_fleet(tmp_path).path))
    command = [program("trident_bridges", "mavlink_vehicle_node"), "__name:=fleet"]
    process = started(ros, "/fleet", command)
    answers_on(process, "/fleet", Asked("/ugv1/odom", odometry, "/ugv1/cmd_vel", Twist))
