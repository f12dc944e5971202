# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What rviz is fed with, and a picture that it makes without a display."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from gazebo_msgs.msg import ModelState
from geometry_msgs.msg import Twist, Vector3
from harness import REPO, Gazebo, Ros, box_sdf, eventually, pose, recorder
from matplotlib.image import imread
from visualization_msgs.msg import Marker, MarkerArray

HOLD = ("rosrun", "trident_viewer", "hold_at.py")
SIZE = (600, 400)


def test_a_simulation_is_held_at_a_time_to_the_step(
    ros: Ros, start_gazebo: Callable[..., Gazebo]
) -> None:
    # So slow that no program starts later than that.
    gazebo = start_gazebo(paused=False, real_time_factor=0.05)
    ros.call(*HOLD, "3.21")
    assert [gazebo.time() for _ in range(20)] == [pytest.approx(3.21)] * 20
    ros.call(*HOLD, "3.21")
    late = ros.launch([*HOLD, "3.2"])
    assert late.wait() == 1
    assert "it is 3.210 s already, past 3.200 s" in late.log


def test_the_fleet_is_shown_where_it_is(ros: Ros, gazebo: Gazebo) -> None:
    gazebo.spawn("UAV1", at=pose(1.0, 2.0, 0.5))
    ros.set_param("/UAV1/robot_description", "")
    ros.launch(["rosrun", "trident_viewer", "fleet_markers.py"])
    with recorder("/fleet_markers", MarkerArray) as heard:
        gazebo.step(1)
        heard.received()
        shapes = [marker for marker in heard.messages[-1].markers if marker.ns == "UAV1/shape"]
    assert [marker.type for marker in shapes] == [Marker.CYLINDER]
    at = shapes[0].pose.position
    assert (at.x, at.y, at.z) == pytest.approx((1.0, 2.0, 0.5), abs=0.01)


def test_a_film_of_a_model_that_is_followed(ros: Ros, gazebo: Gazebo, tmp_path: Path) -> None:
    weightless = box_sdf("box").replace("<inertial>", "<gravity>0</gravity><inertial>", 1)
    gazebo.spawn("box", weightless, at=pose(5.0, 0.0, 1.0))
    state = ModelState(model_name="box", pose=pose(5.0, 0.0, 1.0))
    state.twist = Twist(Vector3(0.5, 0, 0), Vector3(0, 0, 3))
    gazebo.call("set_model_state", model_state=state)
    path = tmp_path / "film.mp4"
    words = ["--follow", "box", "--from", "0", "-1", "0.5", "--at", "0", "0", "0"]
    words += ["--size", "96x64", "--seconds", "0.8", "--out", str(path)]
    film = ros.launch(["rosrun", "trident_viewer", "observer.py", *words])

    def is_filmed() -> bool:
        gazebo.step(4)  # a frame of 25 per second
        return not film.running

    eventually(is_filmed, "a film")
    assert film.wait() == 0, film.log
    assert f"{path}: 0.8 s of simulated time" in film.log
    decode = ["ffmpeg", "-loglevel", "error", "-i", str(path), "-f", "rawvideo"]
    raw = subprocess.run([*decode, "-pix_fmt", "rgb24", "-"], capture_output=True, check=True)
    frames = np.frombuffer(raw.stdout, np.uint8).reshape(-1, 64, 96, 3).astype(float)
    assert len(frames) == 20
    middle = frames[:, 16:48, 32:64]
    assert (np.abs(np.diff(middle, axis=0)).max(axis=(1, 2, 3)) > 20).all(), "the box turns"
    dark = (middle.mean(axis=-1) < middle.mean(axis=-1).max() - 40).mean(axis=(1, 2))
    assert np.ptp(dark) < 0.2, "and stays in the middle"
    assert not [name for name in gazebo.models() if name.startswith("observer")]


def test_without_a_configuration_a_vehicle_is_framed_and_named(tmp_path: Path) -> None:
    target = tmp_path / "picture.png"
    words = ["rotors_gazebo", "mav_hovering_example.launch", "--at", "3", "--size", "600x400"]
    command = [str(REPO / "trident"), "view", *words, "--screenshot", str(target)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert f"{target}: t = 3.000 s" in done.stdout
    picture = imread(target)[..., :3]
    rotors = (np.ptp(picture, axis=-1) > 0.4) & (picture.max(axis=-1) > 0.5)
    rows, columns = np.nonzero(rotors)
    assert 0.1 * SIZE[0] < np.ptp(columns) < 0.5 * SIZE[0], "it is no dot, and whole"
    assert abs(columns.mean() - SIZE[0] / 2) < 0.1 * SIZE[0]
    assert abs(rows.mean() - SIZE[1] / 2) < 0.15 * SIZE[1]
    paper = np.nonzero((picture > 0.85).all(axis=-1))[0]
    assert len(paper) > 200
    assert paper.max() < rows.max(), "its name is above it"


def test_a_launch_file_is_photographed_without_a_display(tmp_path: Path) -> None:
    target = tmp_path / "picture.png"
    size = "x".join(map(str, SIZE))
    words = ["rotors_gazebo", "mav_hovering_example.launch", "--at", "8", "--config", "hovering"]
    command = [str(REPO / "trident"), "view", *words, "--screenshot", str(target), "--size", size]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    picture = imread(target)[..., :3]
    assert picture.shape[:2] == SIZE[::-1]
    path = np.abs(picture - np.array([0.0, 0.447, 0.698])).max(axis=-1) < 0.1
    rows = np.nonzero(path.any(axis=1))[0]
    assert np.ptp(rows) > SIZE[1] // 5, "it has climbed, and left its path"
    assert (picture.min(axis=-1) < 0.2).mean() > 0.002, "the vehicle and its name"
    assert (picture.min(axis=-1) > 0.9).mean() > 0.5, "on a light ground"


def test_a_robot_without_odometry_is_shown_in_its_own_frame(tmp_path: Path) -> None:
    urdf = REPO / "src" / "trident_description" / "urdf"
    robot = tmp_path / "bare.urdf.xacro"
    robot.write_text(
        f"""<robot name="bare" xmlns:xacro="http://ros.org/wiki/xacro">
        <xacro:include filename="{urdf}/parts.xacro"/>
        <xacro:include filename="{urdf}/sensors.xacro"/>
        <xacro:arg name="odometry_source" default=""/>
        <xacro:arg name="command_timeout" default=""/>
        <link name="base_link">
        <xacro:box_inertial mass="2" x="0.3" y="0.2" z="0.1"><origin/></xacro:box_inertial>
        <collision><geometry><box size="0.3 0.2 0.1"/></geometry></collision>
        </link>
        <xacro:rplidar_a2 link="laser" parent="base_link" x="0" y="0" z="0.1"/></robot>""",
        encoding="utf-8",
    )
    target = tmp_path / "picture.png"
    words = ["robot_in_room.launch", "robot:=bare", f"description:={robot}", "--at", "3"]
    words += ["--live", "1", "--config", "robot", "--size", "x".join(map(str, SIZE))]
    command = [str(REPO / "trident"), "view", *words, "--screenshot", str(target)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "the robot has no odometry: the fixed frame is base_link" in done.stdout + done.stderr
    picture = imread(target)[..., :3]
    red = (picture[..., 0] > 0.6) & (picture[..., 1:].max(axis=-1) < 0.3)
    assert red.mean() > 0.002, "what its lidar sees"


def test_a_world_that_is_none_is_refused_with_its_line(tmp_path: Path) -> None:
    world = tmp_path / "noise.world"
    world.write_bytes(bytes(range(128, 250)))
    picture = tmp_path / "picture.png"
    command = [REPO / "trident", "view", world, "--screenshot", picture]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert f"{world}:1: not well-formed XML" in done.stderr
    assert not picture.exists()
