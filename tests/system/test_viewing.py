# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What rviz is fed with, and a picture that it makes without a display."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from harness import REPO, Gazebo, Ros, pose, recorder
from matplotlib.image import imread
from visualization_msgs.msg import Marker, MarkerArray

HOLD = ("rosrun", "trident_eval", "hold_at.py")
SIZE = (600, 400)


def test_a_simulation_is_held_at_a_time_to_the_step(
    ros: Ros, start_gazebo: Callable[..., Gazebo]
) -> None:
    gazebo = start_gazebo(paused=False, real_time_factor=1.0)
    ros.call(*HOLD, "3.21")
    assert [gazebo.time() for _ in range(20)] == [pytest.approx(3.21)] * 20
    ros.call(*HOLD, "3.21")
    late = ros.launch([*HOLD, "3.2"])
    assert late.wait() == 1
    assert "it is 3.210 s already, past 3.200 s" in late.log


def test_the_fleet_is_shown_where_it_is(ros: Ros, gazebo: Gazebo) -> None:
    gazebo.spawn("UAV1", at=pose(1.0, 2.0, 0.5))
    ros.set_param("/UAV1/robot_description", "")
    ros.launch(["rosrun", "trident_eval", "fleet_markers.py"])
    with recorder("/fleet_markers", MarkerArray) as heard:
        gazebo.step(1)
        heard.received()
        shapes = [marker for marker in heard.messages[-1].markers if marker.ns == "UAV1/shape"]
    assert [marker.type for marker in shapes] == [Marker.CYLINDER]
    at = shapes[0].pose.position
    assert (at.x, at.y, at.z) == pytest.approx((1.0, 2.0, 0.5), abs=0.01)


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
