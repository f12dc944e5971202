# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Robots in the styles of public ones load and drive as they are; what has no effect is named."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

trident_sim = pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")

URDF = Path(__file__).parent / "urdf"
EMPTY = "package://rotors_gazebo/worlds/empty.world"


@dataclass(frozen=True)
class Foreign:
    """One robot: where it listens, where it publishes, how well it turns, and what is left out."""

    name: str
    command: str
    odometry: str
    ignored: tuple[str, ...]
    turn_slip: float = 0.05
    """Part of its turn that it may lose: skid steering scrubs."""
    z: float = 0.0
    """Height of its origin over the ground [m]."""


ROBOTS = (
    Foreign(
        "outdoor_rover",
        "cmd_vel",
        "odom",
        ("libgazebo_ros_control.so",),
        turn_slip=0.3,
    ),
    Foreign(
        "round_base",
        "mobile_base/commands/velocity",
        "odom",
        ("<cliff_sensor_left_name>",),
    ),
    Foreign(
        "field_robot",
        "field/jackal_velocity_controller/cmd_vel",
        "field/jackal_velocity_controller/odom",
        ("libfender_lights.so",),
        turn_slip=0.3,
        z=0.0635,
    ),
    Foreign("omni_platform", "cmd_vel", "odom", ("<joint_properties>",)),
    Foreign(
        "class_robot",
        "cmd_vel",
        "odom",
        (),
        z=0.0425,
    ),
)
NAMES = [robot.name for robot in ROBOTS]


def spawn(robot: Foreign) -> trident_sim.World:
    """The robot alone on a plane; nothing of what has no effect may stop it."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", trident_sim.SimulationWarning)
        world = trident_sim.World(EMPTY)
        urdf = trident_sim.expand_xacro(URDF / f"{robot.name}.urdf.xacro")
        world.spawn(robot.name, urdf=urdf, namespace="", pose=(0.0, 0.0, robot.z))
    for port in world.ports.values():
        if port.is_output:
            port.subscribe()
    return world


def drive(world: trident_sim.World, topic: str, v: float, w: float, seconds: float) -> None:
    """Commands a velocity ten times a second, as a teleoperator does."""
    for _ in range(round(10 * seconds)):
        world.ports[topic].write(trident_sim.TwistCommand((v, 0.0, 0.0), (0.0, 0.0, w)))
        world.step(round(0.1 / world.dt))


def yaw(model: trident_sim.Model) -> float:
    x, y, z, w = model.orientation
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


@pytest.mark.parametrize("robot", ROBOTS, ids=NAMES)
def test_it_drives_ahead_and_turns_left(robot: Foreign) -> None:
    world = spawn(robot)
    model = world.model(robot.name)
    world.step(round(0.5 / world.dt))
    start = np.array(model.position)
    drive(world, robot.command, 0.3, 0.0, 5.0)
    moved = np.array(model.position) - start
    # It takes a moment to be fast.
    assert 1.2 < moved[0] < 1.55
    assert abs(moved[1]) < 0.05
    assert abs(moved[2]) < 0.02
    drive(world, robot.command, 0.0, 0.0, 1.0)
    before = yaw(model)
    drive(world, robot.command, 0.0, 0.4, 3.0)
    turned = math.remainder(yaw(model) - before, 2 * math.pi)
    assert (1 - robot.turn_slip) * 1.2 * 0.85 < turned < 1.25


@pytest.mark.parametrize("robot", ROBOTS, ids=NAMES)
def test_its_odometry_is_heard_under_its_name(robot: Foreign) -> None:
    world = spawn(robot)
    drive(world, robot.command, 0.3, 0.0, 3.0)
    odometry = world.ports[robot.odometry].value
    assert odometry.parent_frame.endswith("odom")
    assert odometry.position[0] == pytest.approx(world.model(robot.name).position[0], rel=0.05)
    assert odometry.linear_velocity[0] == pytest.approx(0.3, abs=0.02)


@pytest.mark.parametrize("robot", ROBOTS, ids=NAMES)
def test_whatever_has_no_effect_is_named_once(robot: Foreign) -> None:
    world = spawn(robot)
    texts = [message.text for message in world.messages]
    for what in robot.ignored:
        assert sum(what in text for text in texts) == 1, (what, texts)
    assert len(texts) == len(robot.ignored), texts
    assert not [message for message in world.messages if message.severity == "error"]
    world.step(100)
    assert len(world.messages) == len(texts), "nothing more while it runs"


def test_a_second_one_of_its_kind_names_its_elements_no_more() -> None:
    robot = ROBOTS[-1]
    world = spawn(robot)
    before = len(world.messages)
    urdf = trident_sim.expand_xacro(URDF / f"{robot.name}.urdf.xacro")
    for topic in ("/camera<", "/scan<", "/range/front<", "/imu<", "/cmd_vel<", "/odom<"):
        urdf = urdf.replace(f">{topic}", f">/second{topic}")
    urdf = urdf.replace("robotBaseFrame>base_link", "robotBaseFrame>second_base")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", trident_sim.SimulationWarning)
        world.spawn("second", urdf=urdf, namespace="second", pose=(3.0, 0.0, robot.z))
    warned = [message.text for message in world.messages[before:]]
    assert not [text for text in warned if "no effect" in text], warned
