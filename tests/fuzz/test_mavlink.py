# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Vehicles that speak MAVLink, under hostile messages of their sensors."""

from __future__ import annotations

from pathlib import Path

import pytest
import rospy
import yaml
from geometry_msgs.msg import Twist
from hostile import Asked, answers_on, started
from nav_msgs.msg import Odometry
from trident.testing import Ros, program
from trident_base.ports import free_port

KINDS = {"uav1": "quadrotor", "ugv1": "rover", "usv1": "boat"}
PORTS = ("offboard", "offboard_remote", "gcs", "tcp", "px4_simulator", "ardupilot_json")


def odometry() -> Odometry:
    message = Odometry()
    message.header.stamp = rospy.Time.now()
    message.header.frame_id = "world"
    message.pose.pose.orientation.w = 1.0
    return message


def vehicles_file(folder: Path) -> Path:
    """Three vehicles, on ports that nobody has."""
    vehicles = [
        {"vehicle": name, "kind": kind, "autopilot": "ardupilot"}
        | {f"{part}_port": free_port() for part in PORTS}
        for name, kind in KINDS.items()
    ]
    ports = {"gcs_remote_port": free_port(), "router_port": free_port()}
    path = folder / "vehicles.yaml"
    path.write_text(yaml.safe_dump({"vehicles": vehicles, **ports}), encoding="utf-8")
    return path


@pytest.mark.fuzzes("trident_bridges/mavlink_vehicle_node")
def test_vehicles_of_all_kinds(ros: Ros, tmp_path: Path) -> None:
    ros.set_param("/fleet/vehicles_file", str(vehicles_file(tmp_path)))
    command = [program("trident_bridges", "mavlink_vehicle_node"), "__name:=fleet"]
    process = started(ros, "/fleet", command)
    answers_on(process, "/fleet", Asked("/ugv1/odom", odometry, "/ugv1/cmd_vel", Twist))
