# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The lidars of sensors.xacro measure as their makers say, in the simulator."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
import xacro

trident_sim = pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")

URDF = Path(__file__).resolve().parents[1] / "urdf"
EMPTY = "package://rotors_gazebo/worlds/empty.world"
RADIUS_M = 6.0

#: Largest range [m], turns a second [Hz], step between beams [deg].
FIGURES = {
    "rplidar_a1": (12.0, 5.5, 1.0),
    "rplidar_a2": (18.0, 10.0, 0.45),
    "rplidar_s1": (40.0, 10.0, 0.39),
    "ydlidar_x4": (10.0, 7.0, 0.5),
}
ROBOT = f"""<robot name="carrier" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:include filename="{URDF}/parts.xacro"/><xacro:include filename="{URDF}/sensors.xacro"/>
<link name="base"><inertial><mass value="5"/>
<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><box size="0.2 0.2 0.1"/></geometry></collision></link>
<xacro:MACRO link="laser" parent="base" x="0" y="0" z="0.1"/></robot>"""
#: A ring of walls, seen from its middle.
WALL = """<sdf version="1.6"><model name="wall"><static>true</static><link name="l">
<collision name="c"><geometry><box><size>0.2 2.0 2.0</size></box></geometry></collision></link>
</model></sdf>"""

#: Rings, their lowest and highest elevation [deg], columns of a scan, largest range [m].
RINGS = {
    "velodyne_vlp16": (16, -15.0, 15.0, 1808, 100.0),
    "ouster_os1_64": (64, -22.5, 22.5, 1024, 120.0),
}


#: How sensors are turned: roll, pitch, yaw [rad].
TURN = (0.1, -0.2, 0.3)
#: What there is with x, y, z, and what else each needs.
MOUNTED = {
    **dict.fromkeys((*FIGURES, *RINGS, "livox_mid40", "tfmini_plus", "lidar_2d"), ""),
    **dict.fromkeys(("rtk_gnss", "anemometer"), ""),
    "colour_camera": 'name="laser" topic="images"',
}


def turned(macro: str, roll: float, pitch: float, yaw: float) -> str:
    """A macro with an orientation."""
    return f'{macro} roll="{roll}" pitch="{pitch}" yaw="{yaw}"'


def rotation(roll: float, pitch: float, yaw: float) -> np.ndarray:
    """R_parent_sensor of rotations about fixed axes, as URDF has them."""
    (cr, cp, cy), (sr, sp, sy) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


def expand(macro: str, tmp_path: Path) -> str:
    file = tmp_path / "carrier.xacro"
    file.write_text(ROBOT.replace("MACRO", macro), encoding="utf-8")
    return str(xacro.process_file(str(file)).toxml())


@pytest.mark.parametrize("macro", FIGURES)
def test_a_lidar_measures_as_its_maker_says(macro: str, tmp_path: Path) -> None:
    range_m, rate_hz, step_deg = FIGURES[macro]
    world = trident_sim.World(EMPTY)
    for number in range(24):
        yaw = math.tau * number / 24
        place = ((RADIUS_M + 0.1) * math.cos(yaw), (RADIUS_M + 0.1) * math.sin(yaw), 1.0)
        world.spawn(f"wall{number}", sdf=WALL, pose=(*place, 0.0, 0.0, yaw))
    world.spawn("carrier", urdf=expand(macro, tmp_path), pose=(0.0, 0.0, 0.05))
    port = world.ports["carrier/scan"]
    assert port.read() is None, "reading subscribes"
    turns = 3
    world.step(math.ceil(turns / rate_hz / world.dt))
    scan = port.read()
    assert scan.stamp == pytest.approx((turns - 1) / rate_hz, abs=1e-6)
    assert scan.range_max == range_m
    assert scan.scan_time == pytest.approx(1.0 / rate_hz)
    assert math.degrees(scan.angle_increment) == pytest.approx(step_deg, rel=2e-3)
    assert len(scan.ranges) * scan.angle_increment == pytest.approx(math.tau, rel=1e-4)
    assert len(scan.ranges) * scan.time_increment == pytest.approx(1.0 / rate_hz, rel=1e-4)
    # Flat walls: from 6 m in their middle to 6 m / cos(7.5 deg) at their ends.
    ranges = np.asarray(scan.ranges)
    assert np.isfinite(ranges).all()
    assert RADIUS_M - 0.15 < ranges.min() < ranges.max() < RADIUS_M / math.cos(math.pi / 24) + 0.15


def walled_world(macro: str, tmp_path: Path, height_m: float = 0.05) -> trident_sim.World:
    """A carrier at a height among walls 8 m high."""
    world = trident_sim.World(EMPTY)
    for number in range(24):
        yaw = math.tau * number / 24
        place = ((RADIUS_M + 0.1) * math.cos(yaw), (RADIUS_M + 0.1) * math.sin(yaw), 1.0)
        world.spawn(
            f"wall{number}", sdf=WALL.replace("2.0 2.0", "2.0 8.0"), pose=(*place, 0.0, 0.0, yaw)
        )
    world.spawn("carrier", urdf=expand(macro, tmp_path), pose=(0.0, 0.0, height_m))
    return world


@pytest.mark.parametrize("macro", RINGS)
def test_a_lidar_of_many_rings_turns_as_its_maker_says(macro: str, tmp_path: Path) -> None:
    rings, lowest_deg, highest_deg, columns, range_m = RINGS[macro]
    world = walled_world(f'{macro} topic="points"', tmp_path, height_m=2.0)
    port = world.ports["carrier/points"]
    assert port.read() is None, "reading subscribes"
    world.step(round(0.3 / world.dt))
    cloud = port.read()
    assert cloud.stamp == pytest.approx(0.2, abs=1e-6)
    assert cloud.frame == "carrier/laser"
    points = cloud.points
    assert len(points) == rings * columns, "walls and ground all around, none too near"
    assert set(points["ring"]) == set(range(rings))
    assert (np.diff(points["time"]) >= 0.0).all()
    assert 0.099 < points["time"][-1] < 0.1
    ranges = np.sqrt(points["x"] ** 2 + points["y"] ** 2 + points["z"] ** 2)
    assert ranges.max() < range_m
    elevations = np.degrees(np.arcsin(points["z"] / ranges))
    step_deg = (highest_deg - lowest_deg) / (rings - 1)
    assert elevations == pytest.approx(lowest_deg + step_deg * points["ring"], abs=1e-3)
    azimuths = np.arctan2(points["y"], points["x"])
    turned = math.tau * 10.0 * points["time"]
    assert np.abs(np.angle(np.exp(1j * (azimuths - turned)))).max() < 1e-4


def test_a_rosette_fills_its_cone(tmp_path: Path) -> None:
    world = walled_world('livox_mid40 topic="points"', tmp_path, height_m=2.0)
    port = world.ports["carrier/points"]
    assert port.read() is None, "reading subscribes"
    world.step(round(0.2 / world.dt))
    points = port.read().points
    assert len(points) == 20_000
    off_axis = np.degrees(np.arctan2(np.hypot(points["y"], points["z"]), points["x"]))
    assert 19.0 < off_axis.max() < 19.2 + 1e-3
    assert off_axis.min() < 1.0


def test_a_point_lidar_of_1000_hz_measures_each_millisecond(tmp_path: Path) -> None:
    world = walled_world("tfmini_plus", tmp_path)
    port = world.ports["carrier/scan"]
    assert port.read() is None, "reading subscribes"
    world.step(round(0.1 / world.dt))
    scan = port.read()
    assert port.count == pytest.approx(100, abs=1), "one a millisecond, whatever the step"
    assert len(scan.ranges) == 1
    assert scan.ranges[0] == pytest.approx(RADIUS_M, abs=0.05)


@pytest.mark.parametrize("macro", MOUNTED)
def test_every_sensor_with_a_place_takes_an_orientation(macro: str, tmp_path: Path) -> None:
    words = turned(f"{macro} {MOUNTED[macro]}", *TURN)
    text = expand(words, tmp_path) if macro != "colour_camera" else expand_camera(words, tmp_path)
    origin = re.search(r'xyz="0 0 0.1" rpy="([^"]*)"|rpy="([^"]*)" xyz="0 0 0.1"', text)
    assert origin is not None
    found = [float(word) for word in (origin[1] or origin[2]).split()]
    assert found == pytest.approx(TURN)


def expand_camera(words: str, tmp_path: Path) -> str:
    """As `expand`: a camera has no link of that name."""
    file = tmp_path / "carrier.xacro"
    text = ROBOT.replace('MACRO link="laser"', words)
    file.write_text(text, encoding="utf-8")
    return str(xacro.process_file(str(file)).toxml())


@pytest.mark.parametrize("macro", [*FIGURES, "lidar_2d", "tfmini_plus"])
def test_a_lidar_that_is_turned_looks_elsewhere(macro: str, tmp_path: Path) -> None:
    yaw = 1.0
    world = trident_sim.World(EMPTY)
    place = ((RADIUS_M + 0.1) * math.cos(yaw), (RADIUS_M + 0.1) * math.sin(yaw), 1.0)
    world.spawn("wall", sdf=WALL, pose=(*place, 0.0, 0.0, yaw))
    urdf = expand(turned(macro, 0.0, 0.0, yaw), tmp_path)
    world.spawn("carrier", urdf=urdf, pose=(0.0, 0.0, 0.05))
    port = world.ports["carrier/scan"]
    assert port.read() is None, "reading subscribes"
    world.step(round(0.5 / world.dt))
    scan = port.read()
    assert scan.ranges[0] == pytest.approx(RADIUS_M, abs=0.1), "beam 0 points along its x"


@pytest.mark.parametrize("macro", [*RINGS, "livox_mid40"])
def test_a_lidar_of_many_rings_is_tilted(macro: str, tmp_path: Path) -> None:
    world = trident_sim.World(EMPTY)
    wall = WALL.replace("2.0 2.0", "60.0 60.0")
    world.spawn("wall", sdf=wall, pose=(RADIUS_M + 0.1, 0.0, 1.0, 0.0, 0.0, 0.0))
    urdf = expand(turned(f'{macro} topic="points"', *TURN), tmp_path)
    world.spawn("carrier", urdf=urdf, pose=(0.0, 0.0, 2.0))
    port = world.ports["carrier/points"]
    assert port.read() is None, "reading subscribes"
    world.step(round(0.25 / world.dt))
    points = port.read().points
    seen = np.column_stack([points["x"], points["y"], points["z"]]) @ rotation(*TURN).T
    above = seen[seen[:, 2] > -1.0]  # the ground is 2 m below, less what it has fallen
    assert len(above) > 1000
    assert np.abs(above[:, 0] - RADIUS_M).max() < 0.2, "all on the wall"


@pytest.mark.parametrize("macro", [*FIGURES, *RINGS, "livox_mid40", "lidar_2d", "tfmini_plus"])
def test_rviz_shows_what_a_lidar_sends(macro: str, tmp_path: Path) -> None:
    topic = re.search(r"<topicName>([^<]*)</topicName>", expand(macro, tmp_path))
    assert topic is not None
    rviz = (URDF.parents[2] / "config" / "rviz" / "robot.rviz").read_text(encoding="utf-8")
    assert f"Topic: /{topic[1]}\n" in rviz
