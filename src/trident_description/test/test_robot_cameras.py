# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The cameras of the ground robots see a wall where it is."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

trident_sim = pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")

URDF = Path(__file__).resolve().parents[1] / "urdf"
EMPTY = "package://rotors_gazebo/worlds/empty.world"
#: A white wall in the sun, its lower edge on the ground, its face at x = 0 of itself.
WALL = """<sdf version="1.6"><model name="wall"><static>true</static><link name="l">
<visual name="v"><pose>0.5 0 1 0 0 0</pose><geometry><box><size>1 SIZE 2</size></box></geometry>
<material><emissive>1 1 1 1</emissive></material></visual></link></model></sdf>"""
PITCH_RAD = 0.2
BASELINE_M = 0.12


def look(robot: str, wall_m: float, size_m: float) -> trident_sim.World:
    """A robot at the origin and a wall ahead, all its pictures taken once it stands."""
    world = trident_sim.World(EMPTY)
    world.spawn("wall", sdf=WALL.replace("SIZE", str(size_m)), pose=(wall_m, 0.0, 0.0))
    urdf = trident_sim.expand_xacro(URDF / f"{robot}.urdf.xacro")
    world.spawn("r", urdf=urdf)
    for name, port in world.ports.items():
        if "image_raw" in name or "camera_info" in name:
            port.subscribe()
    world.step(math.ceil(1.0 / world.dt))
    return world


def test_the_rgbd_camera_of_my_nav_robot() -> None:
    world = look("my_nav_robot", wall_m=3.0, size_m=20.0)
    color = world.ports["r/camera/rgb/image_raw"].value
    depth = world.ports["r/camera/depth/image_raw"].value
    assert color.frame == depth.frame == "camera_optical_frame"
    assert color.pixels.shape == (240, 320, 3)
    # 0.12 m ahead of the axle.
    assert depth.pixels[120, 160] == pytest.approx(3.0 - 0.12, abs=5e-3)
    assert np.median(color.pixels[120]) > 250


def test_the_stereo_camera_of_tutorial_ugv() -> None:
    distance = 2.0
    world = look("tutorial_ugv", wall_m=distance + 0.3, size_m=0.2)
    columns, rows = [], []
    for side in ("left", "right"):
        image = world.ports[f"r/stereo/{side}/image_raw"].value
        assert image.frame == "stereo_optical_frame"
        wall = image.pixels[..., 0] > 240
        # Its foot, and where it is 40 rows over that.
        lowest = np.nonzero(wall.any(axis=1))[0].max()
        rows.append(lowest)
        columns.append(np.nonzero(wall[lowest - 40])[0].mean())
    right = world.ports["r/stereo/right/camera_info"].value
    focal = right.k[0, 0]
    assert right.p[0, 3] == pytest.approx(-focal * BASELINE_M)
    # The foot of the wall: 0.3 m below the camera, which looks down by 0.2 rad.
    expected = right.k[1, 2] + focal * math.tan(math.atan2(0.3, distance) - PITCH_RAD)
    assert rows == pytest.approx([expected, expected], abs=1.5)
    assert columns[0] - columns[1] == pytest.approx(focal * BASELINE_M / distance, rel=0.06)
    assert columns[0] + columns[1] == pytest.approx(2.0 * right.k[0, 2], abs=1.5)
