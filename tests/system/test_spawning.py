# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""spawn_model's flags against the real server, and many spawners at once."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from pathlib import Path

import pytest
import rospy
from harness import Gazebo, Process, Ros, box_sdf, eventually, pose, program, vehicle_urdf

#: How many spawners run at once, and how often; 50 and 20 is what a release is tried with.
SPAWNERS = int(os.environ.get("TRIDENT_TEST_SPAWNERS", "20"))
ROUNDS = int(os.environ.get("TRIDENT_TEST_SPAWN_ROUNDS", "2"))

ARM_URDF = """<?xml version="1.0"?><robot name="arm">
  <link name="base"><inertial><mass value="5"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="upper"><inertial><origin xyz="0.3 0 0"/><mass value="1"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="lower"><inertial><origin xyz="0.3 0 0"/><mass value="1"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/>
    <axis xyz="0 0 1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/>
    <origin xyz="0.6 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="10" velocity="10"/></joint>
</robot>"""


def spawn_model(ros: Ros, *words: object, **env: str) -> Process:
    return ros.launch([program("gazebo_ros", "spawn_model"), *words], "spawn_model", **env)


def spawned(ros: Ros, *words: object, **env: str) -> str:
    """Runs spawn_model, which must succeed; its output."""
    process = spawn_model(ros, *words, **env)
    assert process.wait() == 0, process.log
    return process.log


def file_of(ros: Ros, name: str, text: str) -> Path:
    path = ros.folder / name
    path.write_text(text, encoding="utf-8")
    return path


def names(gazebo: Gazebo) -> set[str]:
    return set(gazebo.ask("get_world_properties").model_names)


def position_of(gazebo: Gazebo, joint: str) -> float:
    return float(gazebo.ask("get_joint_properties", joint_name=joint).position[0])


def test_joints_begin_where_they_are_set_to(ros: Ros, gazebo: Gazebo) -> None:
    file = file_of(ros, "arm.urdf", ARM_URDF)
    spawned(
        ros, "-urdf", "-file", file, "-model", "arm", "-J", "shoulder", 0.8, "-J", "elbow", -0.5
    )
    assert position_of(gazebo, "shoulder") == pytest.approx(0.8)
    assert position_of(gazebo, "elbow") == pytest.approx(-0.5)
    assert gazebo.time() == 0.0
    gazebo.step(1)
    assert position_of(gazebo, "elbow") == pytest.approx(-0.5, abs=0.01)


def test_a_joint_that_is_not_there_fails_the_spawner(ros: Ros, gazebo: Gazebo) -> None:
    file = file_of(ros, "arm.urdf", ARM_URDF)
    process = spawn_model(ros, "-urdf", "-file", file, "-model", "arm", "-J", "wrist", 0.1)
    assert process.wait() == 1
    assert "[wrist]" in process.log
    assert "arm" in names(gazebo)


def test_a_spawner_waits_for_a_model(ros: Ros, gazebo: Gazebo) -> None:
    file = file_of(ros, "box.sdf", box_sdf("box"))
    process = spawn_model(
        ros, "-sdf", "-file", file, "-model", "late", "-wait", "early", "__name:=late_spawner"
    )
    eventually(
        lambda: ros.master.lookupNode("/system_tests", "/late_spawner")[0] == 1,
        "the waiting spawner",
    )
    assert "late" not in names(gazebo)
    assert process.running
    gazebo.spawn("early", box_sdf("early"))
    assert process.wait() == 0, process.log
    assert {"early", "late"} <= names(gazebo)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_bound_model_goes_with_its_spawner(ros: Ros, gazebo: Gazebo, number: int) -> None:
    file = file_of(ros, "box.sdf", box_sdf("box"))
    process = spawn_model(ros, "-sdf", "-file", file, "-model", "bound", "-b")
    eventually(lambda: "bound" in names(gazebo), "the bound model")
    gazebo.step(5)
    assert process.running
    process.stop(number)
    assert "bound" not in names(gazebo)


def test_text_comes_from_standard_input(ros: Ros, gazebo: Gazebo) -> None:
    file = file_of(ros, "piped.sdf", box_sdf("box"))
    spawner = program("gazebo_ros", "spawn_model")
    command = f"'{spawner}' -sdf -stdin -model piped -x 1 -y 2 -z 3 < '{file}'"
    ros.call("sh", "-c", command)
    assert gazebo.position("piped") == pytest.approx((1.0, 2.0, 3.0))


def test_frame_namespace_and_unpause(ros: Ros, gazebo: Gazebo) -> None:
    gazebo.spawn("base", box_sdf("base"), pose(1.0, 1.0, 5.0, yaw_rad=1.5707963267948966))
    file = file_of(ros, "uav.urdf", vehicle_urdf("elsewhere"))
    spawned(
        ros, "-urdf", "-file", file, "-model", "UAV1",
        "-reference_frame", "base::link", "-x", 2, "-gazebo_namespace", "/gazebo", "-unpause",
    )  # fmt: skip
    gazebo.until(0.1)
    assert gazebo.position("UAV1")[1] == pytest.approx(3.0, abs=0.05)
    assert not gazebo.ask("get_physics_properties").pause


@pytest.mark.parametrize(
    ("words", "env", "namespace"),
    [
        ((), {"ROS_NAMESPACE": "/fleet/UAV1"}, "fleet/UAV1"),
        (("-robot_namespace", "/given"), {"ROS_NAMESPACE": "/fleet/UAV1"}, "given"),
    ],
)
def test_plugins_without_a_namespace_get_the_spawners(
    ros: Ros, gazebo: Gazebo, words: tuple[str, ...], env: dict[str, str], namespace: str
) -> None:
    plugin = (
        '<plugin name="imu" filename="librotors_gazebo_imu_plugin.so">'
        "<linkName>link</linkName></plugin>"
    )
    file = file_of(ros, "imu.sdf", box_sdf("box", extra=plugin))
    spawned(ros, "-sdf", "-file", file, "-model", "box", *words, **env)
    assert gazebo.time() == 0.0
    topics = {topic for topic, _ in rospy.get_published_topics("/")}
    assert f"/{namespace}/imu" in topics


def test_package_meshes_are_found_as_models(ros: Ros, start_gazebo: Callable[..., Gazebo]) -> None:
    text = ARM_URDF.replace(
        '</inertial></link>\n  <link name="upper">',
        '</inertial><visual><geometry><mesh filename="package://nowhere/a.stl"/></geometry>'
        '</visual></link>\n  <link name="upper">',
    )
    assert "package://" in text
    gazebo = start_gazebo()
    file = file_of(ros, "mesh.urdf", text)
    spawned(ros, "-urdf", "-file", file, "-model", "arm", "-package_to_model")
    assert "arm" in names(gazebo)
    gazebo.process.eventually_logs("model://nowhere/a.stl")


def test_many_spawners_at_once_never_fail(ros: Ros, start_gazebo: Callable[..., Gazebo]) -> None:
    gazebo = start_gazebo(paused=False, real_time_factor=0.0)
    vehicles = [f"UAV{index}" for index in range(1, SPAWNERS + 1)]
    for name in vehicles:
        ros.set_param(f"/{name}/robot_description", vehicle_urdf(name))
    for attempt in range(ROUNDS):
        spawners = [
            spawn_model(
                ros, "-urdf", "-param", "robot_description", "-model", name,
                "-x", 2.0 * (index % 10), "-y", 2.0 * (index // 10), "-z", 0.1,
                ROS_NAMESPACE=f"/{name}",
            )
            for index, name in enumerate(vehicles)
        ]  # fmt: skip
        failed = [p.log for p in spawners if p.wait(limit_s=300.0) != 0]
        assert not failed, f"round {attempt}: {len(failed)} of {SPAWNERS}:\n{failed[0]}"
        assert set(vehicles) <= names(gazebo)
        for name in vehicles:
            gazebo.ask("delete_model", model_name=name)
        assert names(gazebo) == {"ground_plane"}
