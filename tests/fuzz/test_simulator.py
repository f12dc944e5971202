# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The simulator's server under hostile messages."""

from __future__ import annotations

import subprocess
from typing import Any

import pytest
import rospy
from gazebo_msgs.msg import LinkState, ModelState
from gazebo_msgs.srv import (
    ApplyBodyWrenchRequest,
    GetWorldProperties,
    SetLinkStateRequest,
    SetModelConfigurationRequest,
    SetModelStateRequest,
    SetPhysicsPropertiesRequest,
    SpawnModelRequest,
)
from hostile import withstands
from trident.testing import Gazebo, Ros, box_sdf, package, pose

NAMES = ("UAV1", "box", "box::link", "UAV1::UAV1/base_link", "UAV1::UAV1/rotor_0_joint", "world")
#: Robots of the coast, and arguments of their descriptions.
COAST = {
    "wamv": ("lidar:=false",),
    "heron": (),
    "small_catamaran": (),
    "otter": ("lidar:=false", "control:=plugin"),
    "my_nav_robot": (),
    "ackermann_car": (),
}
#: A world that is asked for 4e9 steps makes them; one that a source has enrolled in waits for it.
OBEYED = ("*/unpause_physics", "*/step", "*/enroll_source")


def examples() -> dict[str, Any]:
    box = box_sdf("other")
    state = ModelState(model_name="box", reference_frame="world")
    link = LinkState(link_name="box::link", reference_frame="world")
    return {
        "/gazebo/set_model_state": SetModelStateRequest(state),
        "/gazebo/set_link_state": SetLinkStateRequest(link),
        "/gazebo/apply_body_wrench": ApplyBodyWrenchRequest(body_name="box::link"),
        "/gazebo/set_model_configuration": SetModelConfigurationRequest(
            model_name="UAV1", joint_names=["UAV1/rotor_0_joint"], joint_positions=[0.1]
        ),
        "/gazebo/spawn_sdf_model": SpawnModelRequest(model_name="other", model_xml=box),
        "/gazebo/set_physics_properties": SetPhysicsPropertiesRequest(time_step=0.01),
    }


@pytest.fixture
def world(ros: Ros) -> Gazebo:
    simulation = Gazebo(ros, "basic").ready()
    simulation.spawn("box", box_sdf("box"))
    simulation.spawn("UAV1")
    return simulation


@pytest.fixture
def coast(ros: Ros) -> Gazebo:
    """Vessels, a thruster's plugin of each kind, and ground robots; what floats not sinks."""
    simulation = Gazebo(ros, package("trident_bringup") / "worlds" / "ocean.world").ready()
    for number, (kind, arguments) in enumerate(COAST.items()):
        simulation.spawn(kind, description(kind, *arguments), pose(x=10.0 * number, z=0.2))
    return simulation


def description(kind: str, *arguments: str) -> str:
    """URDF of a shipped robot."""
    file = package("trident_description") / "urdf" / f"{kind}.urdf.xacro"
    command = [str(package("xacro") / "xacro"), str(file), *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def still_steps(world: Gazebo) -> None:
    begin = world.time()
    world.ask("step", n=2)
    assert world.time() > begin
    assert rospy.ServiceProxy("/gazebo/get_world_properties", GetWorldProperties)().success


@pytest.mark.fuzzes("gazebo_ros/gzserver")
def test_gzserver_with_vessels_and_ground_robots(coast: Gazebo) -> None:
    withstands(
        coast.process,
        "/gazebo",
        lambda: still_steps(coast),
        meanwhile=lambda: coast.ask("step", n=1),
        # A world that has lost its robots is not asked much.
        skip=(*OBEYED, "*/delete_model"),
        words=(*COAST, "world", "base_link"),
        service_share=0.2,
    )


@pytest.mark.fuzzes("gazebo_ros/gzserver")
def test_gzserver(world: Gazebo) -> None:
    withstands(
        world.process,
        "/gazebo",
        lambda: still_steps(world),
        examples(),
        meanwhile=lambda: world.ask("step", n=1),
        skip=OBEYED,
        words=NAMES,
        service_share=0.5,
    )
