# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Services about links and joints, resets and metrics, with gazebo_msgs' types."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest
import rospy
from gazebo_msgs.msg import ODEJointProperties, PerformanceMetrics
from gazebo_msgs.srv import GetJointPropertiesResponse
from geometry_msgs.msg import Pose, Quaternion, Vector3, Wrench
from harness import Gazebo, Ros, box_sdf, eventually, pose, recorder, vehicle_urdf
from sensor_msgs.msg import Imu

DT = 0.01  # of basic.world
LINK_FIELDS = ("com", "gravity_mode", "mass", "ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def arm_sdf(limit_rad: float = 1e16) -> str:
    """A post in the world, and on it an arm of 0.5 m that turns about the vertical."""
    inertia = "<inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>"
    inertial = f"<inertial><mass>2</mass>{inertia}</inertial>"
    limit = f"<limit><lower>-{limit_rad}</lower><upper>{limit_rad}</upper></limit>"
    return f"""<?xml version="1.0"?><sdf version="1.6"><model name="arm">
  <link name="post"><pose>0 0 1 0 0 0</pose>{inertial}</link>
  <link name="boom"><pose>0.5 0 1 0 0 0</pose>{inertial}</link>
  <joint name="mount" type="fixed"><parent>world</parent><child>post</child></joint>
  <joint name="swivel" type="revolute"><parent>post</parent><child>boom</child>
    <pose>-0.5 0 0 0 0 0</pose>
    <axis><xyz>0 0 1</xyz>{limit}</axis>
  </joint></model></sdf>"""


#: Of the boom about the swivel [kg m^2].
ARM_INERTIA = 0.1 + 2.0 * 0.5**2


@pytest.fixture
def arm(gazebo: Gazebo) -> Gazebo:
    gazebo.spawn("arm", arm_sdf())
    return gazebo


def joint(gazebo: Gazebo, name: str = "swivel") -> GetJointPropertiesResponse:
    return gazebo.ask("get_joint_properties", joint_name=name)


def link_properties(gazebo: Gazebo, name: str) -> dict[str, Any]:
    response = gazebo.ask("get_link_properties", link_name=name)
    return {field: getattr(response, field) for field in LINK_FIELDS}


def test_link_properties_are_the_links_own(gazebo: Gazebo) -> None:
    gazebo.spawn("box", box_sdf("box", size_m=0.2, mass_kg=3.0))
    got = link_properties(gazebo, "box::link")
    inertia = 3.0 * 0.2**2 / 6.0
    assert (got["mass"], got["gravity_mode"]) == (3.0, True)
    assert (got["ixx"], got["iyy"], got["izz"], got["ixy"]) == pytest.approx([inertia] * 3 + [0.0])
    assert got["com"] == Pose(orientation=Quaternion(0.0, 0.0, 0.0, 1.0))
    refusal = gazebo.refusal("get_link_properties", link_name="box::nothing")
    assert refusal.startswith(
        "GetLinkProperties: link not found, did you forget to scope the link by model name?"
    )


def test_a_mass_that_is_set_is_felt(gazebo: Gazebo) -> None:
    gazebo.spawn("box", box_sdf("box", mass_kg=2.0), pose(z=1000.0))
    before = link_properties(gazebo, "box::link")
    answer = gazebo.ask(
        "set_link_properties",
        link_name="box::link",
        **{**before, "mass": 8.0, "gravity_mode": False},
    )
    assert answer.status_message == "SetLinkProperties: properties set"
    assert link_properties(gazebo, "box::link") == {**before, "mass": 8.0, "gravity_mode": False}
    gazebo.ask(
        "apply_body_wrench",
        body_name="box::link",
        wrench=Wrench(Vector3(4.0, 0.0, 0.0), Vector3()),
        duration=rospy.Duration(-1),
    )
    gazebo.step(100)
    twist = gazebo.ask("get_model_state", model_name="box").twist
    assert twist.linear.x == pytest.approx(4.0 / 8.0 * 1.0, rel=1e-6)
    assert twist.linear.z == 0.0
    for field, value in (("mass", 0.0), ("mass", math.nan), ("ixx", -1.0)):
        fields = {**before, field: value}
        assert "link" in gazebo.refusal("set_link_properties", link_name="box::link", **fields)
    assert link_properties(gazebo, "box::link")["mass"] == 8.0


def test_a_heavier_vehicle_sinks_under_its_controller(gazebo: Gazebo) -> None:
    gazebo.spawn("UAV1", vehicle_urdf("UAV1"))
    before = link_properties(gazebo, "UAV1::UAV1/base_link")
    assert before["mass"] > 1.0  # with what is fixed to it
    heavier = {**before, "mass": before["mass"] + 1.0}
    gazebo.ask("set_link_properties", link_name="UAV1::UAV1/base_link", **heavier)
    assert link_properties(gazebo, "UAV1::UAV1/base_link")["mass"] == heavier["mass"]
    assert gazebo.step(10) == pytest.approx(0.1)


def test_joint_properties_have_kind_and_state(arm: Gazebo) -> None:
    swivel = joint(arm)
    assert swivel.type == GetJointPropertiesResponse.CONTINUOUS
    assert (list(swivel.position), list(swivel.rate), list(swivel.damping)) == ([0.0], [0.0], [0.0])
    mount = joint(arm, "mount")
    assert mount.type == GetJointPropertiesResponse.FIXED
    assert not mount.position
    assert arm.refusal("get_joint_properties", joint_name="no_such").startswith(
        "GetJointProperties: joint not found"
    )


def test_a_joint_effort_acts_for_its_time(arm: Gazebo) -> None:
    answer = arm.ask(
        "apply_joint_effort",
        joint_name="swivel",
        effort=0.3,
        start_time=rospy.Time(0.5),
        duration=rospy.Duration(1.0),
    )
    assert answer.status_message == "ApplyJointEffort: effort set"
    arm.step(50)
    assert joint(arm).rate[0] == 0.0
    arm.step(200)
    assert joint(arm).rate[0] == pytest.approx(0.3 / ARM_INERTIA * 1.0, rel=1e-3)
    refusal = arm.refusal("apply_joint_effort", joint_name="no_such", effort=1.0)
    assert refusal.startswith("ApplyJointEffort: joint not found")


@pytest.mark.parametrize("service", ["clear_joint_forces", "clear_joint_efforts"])
def test_a_joint_effort_without_end_ends_when_it_is_cleared(arm: Gazebo, service: str) -> None:
    arm.ask("apply_joint_effort", joint_name="swivel", effort=0.3, duration=rospy.Duration(-1))
    arm.step(100)
    rate = joint(arm).rate[0]
    assert rate == pytest.approx(0.3 / ARM_INERTIA * 1.0, rel=1e-3)
    arm.call(service, joint_name="swivel")
    arm.step(100)
    assert joint(arm).rate[0] == pytest.approx(rate, rel=1e-4)
    with pytest.raises(rospy.ServiceException):
        arm.call(service, joint_name="no_such")


def test_a_name_that_two_models_have_is_scoped(arm: Gazebo) -> None:
    arm.spawn("other", arm_sdf(), pose(x=5.0))
    assert "more than one model" in arm.refusal("get_joint_properties", joint_name="swivel")
    arm.ask(
        "apply_joint_effort", joint_name="other::swivel", effort=0.3, duration=rospy.Duration(-1)
    )
    arm.step(10)
    assert joint(arm, "arm::swivel").rate[0] == 0.0
    assert joint(arm, "other::swivel").rate[0] > 0.0


def test_joint_parameters_of_ode_are_set(arm: Gazebo) -> None:
    def set_joint(**lists: list[float]) -> None:
        answer = arm.ask(
            "set_joint_properties",
            joint_name="swivel",
            ode_joint_config=ODEJointProperties(**lists),
        )
        assert answer.status_message == "SetJointProperties: properties set"

    set_joint(fmax=[1.0], vel=[0.5])
    arm.step(200)
    assert joint(arm).rate[0] == pytest.approx(0.5, abs=1e-6)
    set_joint(fmax=[0.0], damping=[0.2])
    assert joint(arm).damping[0] == 0.2
    arm.step(100)
    assert joint(arm).rate[0] == pytest.approx(0.5 * math.exp(-0.2 / ARM_INERTIA), rel=0.01)
    here = joint(arm).position[0]
    set_joint(
        damping=[0.0],
        hiStop=[here + 0.1],
        loStop=[here - 1.0],
        stop_erp=[0.3],
        stop_cfm=[1e-6],
        fudge_factor=[1.0],
        cfm=[1e-9],
        erp=[0.2],
    )
    assert joint(arm).type == GetJointPropertiesResponse.REVOLUTE
    farthest = 0.0
    for _ in range(60):
        arm.step(1)
        farthest = max(farthest, joint(arm).position[0])
    assert farthest == pytest.approx(here + 0.1, abs=0.01)
    assert joint(arm).rate[0] < 0.01


@pytest.mark.parametrize(
    ("name", "lists", "words"),
    [
        ("no_such", {}, "SetJointProperties: joint not found"),
        ("swivel", {"damping": [-1.0]}, "damping is -1"),
        ("swivel", {"hiStop": [-2.0], "loStop": [1.0]}, "hiStop is -2"),
        ("swivel", {"damping": [0.1, 0.1]}, "has 1 axes"),
        ("swivel", {"erp": [0.5]}, "set_physics_properties"),
        ("swivel", {"fmax": [math.nan]}, "fmax is nan"),
        ("mount", {"damping": [0.1]}, "has 0 axes"),
    ],
)
def test_bad_joint_parameters_are_refused(
    arm: Gazebo, name: str, lists: dict[str, list[float]], words: str
) -> None:
    config = ODEJointProperties(**lists)
    assert words in arm.refusal("set_joint_properties", joint_name=name, ode_joint_config=config)
    assert joint(arm).damping[0] == 0.0


def test_a_model_is_configured(gazebo: Gazebo) -> None:
    gazebo.spawn("arm", arm_sdf(limit_rad=1.2))
    answer = gazebo.ask(
        "set_model_configuration",
        model_name="arm",
        urdf_param_name="robot_description",
        joint_names=["swivel"],
        joint_positions=[0.7],
    )
    assert answer.status_message == "SetModelConfiguration: success"
    assert joint(gazebo).position[0] == pytest.approx(0.7)
    boom = gazebo.ask("get_link_state", link_name="arm::boom").link_state.pose
    assert (boom.position.x, boom.position.y) == pytest.approx(
        (0.5 * math.cos(0.7), 0.5 * math.sin(0.7))
    )
    clamped = gazebo.ask(
        "set_model_configuration",
        model_name="arm",
        joint_names=["swivel"],
        joint_positions=[3.0],
    )
    assert "[swivel] was stopped by its limit" in clamped.status_message
    assert joint(gazebo).position[0] == pytest.approx(1.2)


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"model_name": "nobody"}, "SetModelConfiguration: model does not exist"),
        (
            {"joint_names": ["swivel"]},
            "SetModelConfiguration: joint name and position list have different lengths",
        ),
        ({"joint_names": ["no_such"], "joint_positions": [0.1]}, "[no_such]"),
        ({"joint_names": ["mount"], "joint_positions": [0.1]}, "fixed"),
        ({"joint_names": ["swivel"], "joint_positions": [math.inf]}, "finite"),
    ],
)
def test_a_bad_configuration_is_refused_and_moves_nothing(
    arm: Gazebo, fields: dict[str, Any], words: str
) -> None:
    assert words in arm.refusal("set_model_configuration", **{"model_name": "arm", **fields})
    assert joint(arm).position[0] == 0.0


def test_performance_metrics_are_sent_while_someone_listens(
    start_gazebo: Callable[..., Gazebo],
) -> None:
    gazebo = start_gazebo(paused=False, real_time_factor=2.0)
    gazebo.spawn("UAV1", vehicle_urdf("UAV1"))
    with (
        recorder("/UAV1/imu", Imu),
        recorder("/gazebo/performance_metrics", PerformanceMetrics) as metrics,
    ):
        eventually(
            lambda: bool(metrics.messages) and bool(metrics.messages[-1].sensors),
            "metrics with a sensor",
        )
        seen = len(metrics.messages)
        last = metrics.received(seen + 4)[-1]
    assert 0.5 < last.real_time_factor < 2.5
    (imu,) = last.sensors
    assert imu.name == "UAV1/imu"
    assert imu.sim_update_rate == pytest.approx(1.0 / DT, rel=0.05)
    assert imu.real_update_rate == pytest.approx(
        imu.sim_update_rate * last.real_time_factor, rel=0.05
    )
    assert imu.fps == -1.0
    gazebo.ask("pause_physics")
    with recorder("/gazebo/performance_metrics", PerformanceMetrics) as metrics:
        assert metrics.received(2)[-1].real_time_factor == 0.0


def test_types_are_upstreams(ros: Ros, gazebo: Gazebo) -> None:
    assert gazebo.time() == 0.0
    for name, kind in {
        "get_link_properties": "gazebo_msgs/GetLinkProperties",
        "set_link_properties": "gazebo_msgs/SetLinkProperties",
        "get_joint_properties": "gazebo_msgs/GetJointProperties",
        "set_joint_properties": "gazebo_msgs/SetJointProperties",
        "apply_joint_effort": "gazebo_msgs/ApplyJointEffort",
        "clear_joint_forces": "gazebo_msgs/JointRequest",
        "clear_joint_efforts": "gazebo_msgs/JointRequest",
        "clear_body_wrenches": "gazebo_msgs/BodyRequest",
        "set_model_configuration": "gazebo_msgs/SetModelConfiguration",
    }.items():
        assert ros.call("rosservice", "type", f"/gazebo/{name}").strip() == kind
