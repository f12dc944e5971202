# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Controllers under hostile messages."""

from __future__ import annotations

from typing import Any

import pytest
import yaml
from geometry_msgs.msg import Pose, PoseStamped, Transform
from hostile import Asked, answers_on, odometry, service, started, withstands
from mav_msgs.msg import Actuators, AttitudeThrust, RateThrust, RollPitchYawrateThrust
from nav_msgs.msg import Path
from std_msgs.msg import Float32, Header
from trajectory_msgs.msg import MultiDOFJointTrajectory, MultiDOFJointTrajectoryPoint
from trident.testing import Ros, package, program

from trident_msgs.msg import TimedPath, TrajectoryLimits
from trident_msgs.srv import OptimizeTrajectories, OptimizeTrajectoriesRequest


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


def team() -> OptimizeTrajectoriesRequest:
    """Two UAVs that change places."""
    request = OptimizeTrajectoriesRequest()
    for robot, x in (("a", 4.0), ("b", -4.0)):
        path = TimedPath(robot=robot, kind="uav", times=[0.0, 6.0], poses=[Pose(), Pose()])
        for pose, sign in zip(path.poses, (1.0, -1.0), strict=True):
            pose.position.x, pose.position.z, pose.orientation.w = sign * x, 5.0, 1.0
        request.initial.append(path)
        limits = TrajectoryLimits(robot=robot, max_velocity=4.0, collision_radius=0.5)
        request.limits.append(limits)
    return request


@pytest.mark.fuzzes("trident_trajectories/trajectory_optimizer_node")
def test_trajectory_optimizer(ros: Ros) -> None:
    node = "/trajectory_optimizer"
    process = started(ros, node, [program("trident_trajectories", "trajectory_optimizer_node")])
    plan = service("/optimize_trajectories", OptimizeTrajectories)

    def is_planned() -> None:
        answer = plan(team())
        assert answer.success, answer.message
        assert len(answer.result) == 2

    withstands(process, node, is_planned, {"/optimize_trajectories": team()})
