# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Robots in the shipped worlds: they stand on their wheels, and walls stop them."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import xacro

from trident_sim import TwistCommand, World

REPO = Path(__file__).resolve().parents[3]
ROBOTS = ["my_nav_robot", "tutorial_ugv", "turtlebot3_burger"]

# A sensor that is left out is another test's business.
pytestmark = pytest.mark.filterwarnings("ignore::trident_sim.SimulationWarning")


def urdf(robot: str) -> str:
    path = REPO / "src/trident_description/urdf" / f"{robot}.urdf.xacro"
    return str(xacro.process_file(str(path), mappings={}).toxml())


def world_with(world: str, robot: str, pose: tuple[float, ...]) -> World:
    result = World(REPO / "worlds" / f"{world}.world")
    result.spawn(robot, urdf=urdf(robot), namespace="", pose=pose)
    return result


def drive(world: World, v: float, w: float, seconds: float) -> None:
    world.ports["cmd_vel"].write(TwistCommand((v, 0, 0), (0, 0, w)))
    world.step(round(seconds / world.dt))


@pytest.mark.parametrize("file", sorted((REPO / "worlds").glob("*.world")), ids=lambda f: f.stem)
def test_every_world_loads_with_nothing_left_out_and_runs(file: Path) -> None:
    world = World(file, strict=True)
    world.step(10)
    assert world.time == pytest.approx(10 * world.dt)


@pytest.mark.parametrize("robot", ROBOTS)
def test_robots_stand_level_and_still(robot: str) -> None:
    world = world_with("room", robot, (0, 0, 0, 0, 0, 0.3))
    world.step(3000)
    model = world.model(robot)
    x, y, z = model.position
    assert math.hypot(x, y) < 2e-3
    assert abs(z) < 2e-3
    qx, qy = model.orientation[:2]
    assert 2 * math.hypot(qx, qy) < 0.02


#: Where something blocks the path: start, heading, and how far the base's middle may come.
OBSTACLES = {
    "east wall": ((3.5, 0.0), 0.0, 1.5),
    "north wall": ((3.0, 3.5), math.pi / 2, 1.5),
    "inner wall": ((-1.0, 1.0), math.pi / 2, 0.95),
    "west wall": ((-3.5, 0.0), math.pi, 1.5),
}


@pytest.mark.parametrize("name", OBSTACLES)
def test_walls_of_the_room_stop_a_robot(name: str) -> None:
    (x, y), yaw, free = OBSTACLES[name]
    world = world_with("room", "my_nav_robot", (x, y, 0, 0, 0, yaw))
    drive(world, 0.5, 0.0, 6.0)
    moved = np.asarray(world.model("my_nav_robot").position)[:2] - (x, y)
    ahead = float(moved @ (math.cos(yaw), math.sin(yaw)))
    assert ahead == pytest.approx(free - 0.125, abs=0.02)


def test_the_table_stands_on_legs_that_a_flat_robot_passes() -> None:
    world = world_with("room", "my_nav_robot", (0.5, -2.0, 0, 0, 0, 0))
    drive(world, 0.5, 0.0, 6.0)
    assert world.model("my_nav_robot").position[0] > 3.0


def test_pillars_of_the_hexagon_stop_a_robot_and_gaps_do_not() -> None:
    world = world_with("hexagon", "turtlebot3_burger", (-2.0, -0.5, 0, 0, 0, 0))
    drive(world, 0.2, 0.0, 12.0)
    assert world.model("turtlebot3_burger").position[0] > -0.2
    blocked = world_with("hexagon", "turtlebot3_burger", (-2.0, 0.0, 0, 0, 0, 0))
    drive(blocked, 0.2, 0.0, 8.0)
    front = 0.038  # of the body, ahead of the axle
    assert blocked.model("turtlebot3_burger").position[0] < -1.1 - 0.15 - front + 0.02
