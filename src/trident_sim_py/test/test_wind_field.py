# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A firefly in a wind field, asked for with the macro of rotors_description."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from conftest import Fly

import trident_sim

SPEED = "UAV1/wind_speed"
CONSTANT = (0.0, 1.5, 0.0)
TOP_M = 20.0
# 6 m/s along x at the ground, none at 20 m, over 40 m x 40 m.
FIELD = """min_x:
-20.0
min_y:
-20.0
n_x:
2
n_y:
2
res_x:
40.0
res_y:
40.0
vertical_spacing_factors:
0.0 1.0
bottom_z:
0 0 0 0
top_z:
20 20 20 20
u:
6 6 6 6 0 0 0 0
v:
0 0 0 0 0 0 0 0
w:
0 0 0 0 0 0 0 0
"""
XACRO = """<?xml version="1.0"?>
<robot name="firefly" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include
    filename="$(find rotors_description)/urdf/mav_generic_odometry_sensor.gazebo"/>
  <xacro:arg name="wind_field" default=""/>
  <xacro:wind_plugin_macro namespace="${namespace}" xyz_offset="0 0 0" wind_direction="0 1 0"
    wind_force_mean="100" wind_gust_direction="0 0 1" wind_gust_duration="100" wind_gust_start="0"
    wind_gust_force_mean="100" wind_speed_mean="1.5" use_custom_static_wind_field="true"
    custom_wind_field_path="$(arg wind_field)"/>
</robot>
"""

Spawn = Callable[[str], trident_sim.World]


@pytest.fixture
def spawn(make_flight: Fly, tmp_path: Path) -> Spawn:
    """Makes a world with a hovering firefly in the wind of a field's text."""

    def make(field: str) -> trident_sim.World:
        (tmp_path / "windy.xacro").write_text(XACRO, encoding="utf-8")
        (tmp_path / "field.txt").write_text(field, encoding="utf-8")
        urdf = trident_sim.expand_xacro(
            tmp_path / "windy.xacro",
            mav_name="firefly",
            namespace="UAV1",
            enable_ground_truth=True,
            enable_logging=False,
            log_file="firefly",
            wait_to_record_bag=False,
            enable_mavlink_interface=False,
            wind_field=tmp_path / "field.txt",
        )
        world = make_flight(controlled=False)
        world.remove("UAV1")
        urdf = trident_sim.with_lee_controller(
            urdf, "UAV1", trident_sim.lee_parameter_files("firefly")
        )
        world.spawn("UAV1", urdf=urdf, pose=(0.0, 0.0, 2.0))
        world.ports["UAV1/command/trajectory"].write([(0.0, 0.0, 2.0)])
        return world

    return make


def wind_at_height(z: float) -> np.ndarray:
    return np.array([6.0 * (1.0 - z / TOP_M), 0.0, 0.0])


def test_the_wind_shown_is_that_of_the_field_where_the_firefly_is(spawn: Spawn) -> None:
    world = spawn(FIELD)
    uav, speed = world.model("UAV1"), world.ports[SPEED]
    speed.subscribe()
    for _ in range(200):
        height = uav.position[2]
        world.step()
        sample = speed.value
        assert sample.stamp == world.time
        np.testing.assert_allclose(sample.velocity, wind_at_height(height), atol=1e-9)


def test_outside_of_the_field_the_constant_wind_blows(spawn: Spawn) -> None:
    world = spawn(FIELD.replace("20 20 20 20", "1 1 1 1"))
    world.ports[SPEED].subscribe()
    world.step(10)
    np.testing.assert_allclose(world.ports[SPEED].value.velocity, CONSTANT, atol=1e-12)


def test_the_firefly_drifts_with_the_field_alone(spawn: Spawn) -> None:
    """The forces of the same macro, 100 N, do not act, and none are shown."""
    windy = spawn(FIELD)
    still = spawn(FIELD.replace("6 6 6 6", "0 0 0 0"))
    force = windy.ports["UAV1/external_force"]
    force.subscribe()
    windy.step(500)
    still.step(500)
    offset = windy.model("UAV1").position - still.model("UAV1").position
    # Six rotors at 540 rad/s feel 8.06e-5 N each per rad/s and m/s; 6 N/m hold the position. What
    # is more comes from their moment about the centre of mass.
    held = 6 * 540 * 8.06e-5 * wind_at_height(2.0)[0] / 6.0
    assert held < offset[0] < 1.3 * held
    assert np.abs(offset[1:]).max() < 0.05
    assert force.count == 0


def test_a_bad_field_refuses_the_firefly(spawn: Spawn) -> None:
    with pytest.raises(trident_sim.Error, match=r"field.txt:9: res_x is '-40', expected a num"):
        spawn(FIELD.replace("res_x:\n40.0", "res_x:\n-40.0"))
