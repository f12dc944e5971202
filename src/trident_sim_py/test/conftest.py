# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Small worlds and one real vehicle."""

from __future__ import annotations

from collections.abc import Callable

import pytest

import trident_sim

DT_S = 0.01
GRAVITY = 9.8
WORLD = f"""<?xml version="1.0"?>
<sdf version="1.6">
  <world name="tiny">
    <gravity>0 0 -{GRAVITY}</gravity>
    <physics type="ode"><max_step_size>{DT_S}</max_step_size></physics>
  </world>
</sdf>
"""
BALL = """<?xml version="1.0"?>
<sdf version="1.6">
  <model name="ball">
    <link name="body">
      <inertial><mass>2.0</mass>
        <inertia><ixx>0.01</ixx><iyy>0.02</iyy><izz>0.03</izz></inertia></inertial>
    </link>
  </model>
</sdf>
"""
ROTORS = 6


@pytest.fixture
def world() -> trident_sim.World:
    """Nothing but gravity."""
    return trident_sim.World(WORLD)


@pytest.fixture(scope="session")
def firefly_urdf() -> str:
    return trident_sim.multirotor("UAV1", controlled=False)


Fly = Callable[..., trident_sim.World]


@pytest.fixture
def make_flight(firefly_urdf: str) -> Fly:
    """A world with one firefly, by default with its controller and a place to hover at."""

    def make(
        hover: tuple[float, float, float] | None = (0.0, 0.0, 1.0),
        *,
        controlled: bool = True,
        seed: int = 0,
        timing: str = "rotors",
    ) -> trident_sim.World:
        world = trident_sim.World(
            "package://rotors_gazebo/worlds/basic.world", seed=seed, timing=timing
        )
        urdf = firefly_urdf
        if controlled:
            urdf = trident_sim.with_lee_controller(
                urdf, "UAV1", trident_sim.lee_parameter_files("firefly")
            )
        world.spawn("UAV1", urdf=urdf, pose=(0.0, 0.0, 0.1))
        if controlled and hover is not None:
            world.ports["UAV1/command/trajectory"].write([hover])
        return world

    return make
