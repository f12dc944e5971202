# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Drives of joints, and snapshots."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from conftest import BALL, GRAVITY

import trident_sim

WHEEL = """<?xml version="1.0"?>
<sdf version="1.6">
  <model name="wheel">
    <link name="rim">
      <inertial><mass>1.0</mass>
        <inertia><ixx>0.2</ixx><iyy>0.2</iyy><izz>0.25</izz></inertia></inertial>
    </link>
    <joint name="hub" type="revolute">
      <parent>world</parent><child>rim</child><axis><xyz>0 0 1</xyz></axis>
    </joint>
  </model>
</sdf>
"""


@pytest.fixture
def wheel(world: trident_sim.World) -> trident_sim.World:
    world.spawn(sdf=WHEEL)
    return world


def test_a_position_drive_reaches_its_target(wheel: trident_sim.World) -> None:
    drive = wheel.drive("wheel", "hub", "position", target=2.0, p=5.0, d=2.0)
    wheel.step(800)
    hub = wheel.model("wheel").joint("hub")
    assert hub.position == pytest.approx(2.0, abs=1e-3)
    drive.target = -10.0
    wheel.step(1500)
    assert hub.position == pytest.approx(-10.0, abs=1e-3)
    assert abs(drive.effort) < 0.01


def test_an_effort_drive_accelerates_until_it_is_removed(wheel: trident_sim.World) -> None:
    drive = wheel.drive("wheel", "hub", "effort", target=1.0, effort_limit=0.5)
    wheel.step(100)
    hub = wheel.model("wheel").joint("hub")
    assert hub.velocity == pytest.approx(0.5 / 0.25, rel=1e-6)
    drive.remove()
    wheel.step(100)
    assert hub.velocity == pytest.approx(0.5 / 0.25, rel=1e-6)
    with pytest.raises(trident_sim.Error, match="has no drive any more"):
        drive.target = 1.0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"mode": "torque"}, "mode is 'torque', legal: effort, velocity, position"),
        ({"target": math.nan}, "target is nan, must be finite"),
        ({"p": math.inf}, "gain p is inf, must be finite"),
        ({"effort_limit": -1.0}, "output_limit is -1.000000, must be >= 0"),
        ({"axis": 1}, "the joint has 1 axes"),
        ({"axis": -1}, "axis is -1, legal: 0 or 1"),
    ],
)
def test_bad_drives_are_refused(
    wheel: trident_sim.World, arguments: dict[str, object], message: str
) -> None:
    make: Callable[..., trident_sim.Drive] = wheel.drive
    with pytest.raises(trident_sim.Error, match=message):
        make("wheel", "hub", **arguments)


def test_a_flight_continues_from_a_snapshot_as_it_did(
    make_flight: Callable[..., trident_sim.World],
) -> None:
    straight = make_flight((1.0, 0.0, 1.5), seed=3)
    straight.step(600)

    world = make_flight((1.0, 0.0, 1.5), seed=3)
    odometry = world.ports["UAV1/odometry_sensor1/odometry"]
    odometry.subscribe()
    world.step(300)
    snapshot = world.save_snapshot()
    assert (snapshot.time, snapshot.step_count) == (3.0, 300)
    before = odometry.value.position
    world.ports["UAV1/command/trajectory"].write([(-1.0, 0.0, 3.0)])
    world.step(150)
    world.restore_snapshot(snapshot)
    assert world.time == 3.0
    np.testing.assert_array_equal(odometry.value.position, before)
    sample = odometry.read()
    assert sample is not None
    world.step(300)
    assert world.state_hash() == straight.state_hash()


def test_a_snapshot_fits_its_own_models_only(wheel: trident_sim.World) -> None:
    snapshot = wheel.save_snapshot()
    wheel.remove("wheel")
    with pytest.raises(trident_sim.Error, match="model 'wheel'"):
        wheel.restore_snapshot(snapshot)
    with pytest.raises(trident_sim.Error, match="of another world"):
        trident_sim.World("<sdf version='1.6'><world name='other'/></sdf>").restore_snapshot(
            snapshot
        )


def test_a_scaled_mass_is_pushed_less_and_falls_as_fast(world: trident_sim.World) -> None:
    world.spawn("ball", sdf=BALL, pose=(0.0, 0.0, 100.0))
    ball, snapshot = world.model("ball"), world.save_snapshot()
    ends = []
    for factor in (1.0, 2.0, 0.5, 1.0):
        world.restore_snapshot(snapshot)  # fits whatever the mass is
        ball.scale_mass(factor)
        assert ball.mass == pytest.approx(2.0 * factor)
        ball.link("body").apply_wrench((4.0, 0.0, 0.0), (0.0, 0.0, 0.3), duration=1.0)
        world.step(100)
        assert ball.linear_velocity[0] == pytest.approx(2.0 / factor)
        assert ball.linear_velocity[2] == pytest.approx(-GRAVITY)
        assert ball.angular_velocity[2] == pytest.approx(10.0 / factor, rel=1e-6)
        ends.append(world.state_hash())
    assert ends[0] == ends[3]  # factors do not pile up


@pytest.mark.parametrize("factor", [0.0, -1.0, 101.0, math.nan])
def test_a_mass_is_not_scaled_by_what_is_no_factor(world: trident_sim.World, factor: float) -> None:
    world.spawn("ball", sdf=BALL)
    with pytest.raises(trident_sim.Error, match=r"factor is .*, legal: 0.01 to 100"):
        world.model("ball").scale_mass(factor)
    assert world.model("ball").mass == 2.0
