# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Controllers under hostile messages."""

from __future__ import annotations

from typing import Any

import pytest
import yaml
from geometry_msgs.msg import PoseStamped, Transform
from hostile import Asked, answers_on, odometry, started
from mav_msgs.msg import Actuators, AttitudeThrust, RateThrust, RollPitchYawrateThrust
from nav_msgs.msg import Path
from std_msgs.msg import Float32, Header
from trajectory_msgs.msg import MultiDOFJointTrajectory, MultiDOFJointTrajectoryPoint
from trident.testing import Ros, package, program


def firefly(gains: str) -> dict[str, Any]:
    merged: dict[str, Any] = {}
    for name in (gains, "firefly.yaml"):
        file = package("rotors_gazebo") / "resource" / name
        merged.update(yaml.safe_load(file.read_text(encoding="utf-8")))
    return merged


def treat(
    ros: Ros, kind: str, parameters: dict[str, Any], examples: dict[str, Any], **where: str
) -> None:
    node = f"/UAV1/{kind}"
    ros.set_param(node, parameters)
    command = [
        program(where.get("package", "rotors_control"), kind),
        "__ns:=/UAV1",
        f"__name:={kind}",
    ]
    process = started(ros, node, command)
    topic = where.get("answer", "command/motor_speed")
    kind_of_answer = Float32 if "answer" in where else Actuators
    asked = Asked("/UAV1/odometry", odometry, f"/UAV1/{topic}", kind_of_answer)
    examples = {f"/UAV1/{name}": message for name, message in examples.items()}
    answers_on(process, node, asked, examples)


@pytest.mark.fuzzes("rotors_control/lee_position_controller_node")
def test_lee_position_controller(ros: Ros) -> None:
    point = MultiDOFJointTrajectoryPoint(transforms=[Transform()])
    point.transforms[0].rotation.w = 1.0
    examples = {
        "command/pose": PoseStamped(),
        "command/trajectory": MultiDOFJointTrajectory(points=[point]),
        "command/attitude_thrust": AttitudeThrust(),
        "command/rate_thrust": RateThrust(),
        "command/stop": Header(),
    }
    parameters = firefly("lee_controller_firefly.yaml")
    treat(ros, "lee_position_controller_node", parameters, examples)


@pytest.mark.fuzzes("rotors_control/roll_pitch_yawrate_thrust_controller_node")
def test_roll_pitch_yawrate_thrust_controller(ros: Ros) -> None:
    parameters = firefly("roll_pitch_yawrate_thrust_controller_firefly.yaml")
    examples = {"command/roll_pitch_yawrate_thrust": RollPitchYawrateThrust()}
    treat(ros, "roll_pitch_yawrate_thrust_controller_node", parameters, examples)


@pytest.mark.fuzzes("trident_control/vessel_controller_node")
def test_vessel_controller(ros: Ros) -> None:
    config = package("trident_bringup") / "config"
    parameters = {
        "vessel": str(config / "vessels" / "wamv.yaml"),
        "controller": str(config / "controllers" / "wamv.yaml"),
    }
    place = PoseStamped()
    place.pose.orientation.w = 1.0
    examples = {"command/path": Path(poses=[place, place]), "command/pose": place}
    treat(
        ros,
        "vessel_controller_node",
        parameters,
        examples,
        package="trident_control",
        answer="thrusters/left_thrust_cmd",
    )
