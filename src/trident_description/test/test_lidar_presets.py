# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The lidars of sensors.xacro measure as their makers tell, in the simulator."""

from __future__ import annotations

import math
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


def expand(macro: str, tmp_path: Path) -> str:
    file = tmp_path / "carrier.xacro"
    file.write_text(ROBOT.replace("MACRO", macro), encoding="utf-8")
    return str(xacro.process_file(str(file)).toxml())


@pytest.mark.parametrize("macro", FIGURES)
def test_a_lidar_measures_as_its_maker_tells(macro: str, tmp_path: Path) -> None:
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
