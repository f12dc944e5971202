# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The ground robots as they ship, on their wheels, against closed forms."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

trident_sim = pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")

URDF = Path(__file__).resolve().parents[1] / "urdf"
#: test_vessels.py is the test of those that float.
VESSELS = {"heron", "otter", "small_catamaran", "wamv"}
ROBOTS = sorted(
    {path.name.removesuffix(".urdf.xacro") for path in URDF.glob("*.urdf.xacro")} - VESSELS
)
EMPTY = "package://rotors_gazebo/worlds/empty.world"


def world_of(robot: str, **args: object) -> trident_sim.World:
    world = trident_sim.World(EMPTY)
    world.spawn(robot, urdf=trident_sim.expand_xacro(URDF / f"{robot}.urdf.xacro", **args))
    for name in ("odom", "joint_states"):
        world.ports[f"{robot}/{name}"].subscribe()
    world.step(round(0.5 / world.dt))
    return world


def command(world: trident_sim.World, robot: str, v: float, w: float) -> None:
    twist = trident_sim.TwistCommand((v, 0.0, 0.0), (0.0, 0.0, w))
    world.ports[f"{robot}/cmd_vel"].write(twist)


def run(world: trident_sim.World, seconds: float) -> None:
    world.step(round(seconds / world.dt))


def circle_radius(points: npt.NDArray[np.float64]) -> float:
    """Least-squares circle through points of shape (n, 2) [m]."""
    rows = np.column_stack([2 * points, np.ones(len(points))])
    (x, y, c), *_ = np.linalg.lstsq(rows, (points**2).sum(axis=1), rcond=None)
    return math.sqrt(c + x * x + y * y)


@pytest.mark.parametrize("robot", ROBOTS)
def test_nothing_in_its_description_is_without_effect(robot: str) -> None:
    assert not [message.text for message in world_of(robot).messages]


@pytest.mark.parametrize("robot", ROBOTS)
def test_it_stands_still_and_goes_straight_ahead(robot: str) -> None:
    world = world_of(robot)
    model = world.model(robot)
    start = np.array(model.position)
    run(world, 2.0)
    assert np.linalg.norm(np.array(model.position) - start) < 2e-3
    command(world, robot, 0.2, 0.0)
    run(world, 5.0)
    moved = np.array(model.position) - start
    assert 0.8 < moved[0] < 1.01
    assert abs(moved[1]) < 0.01


@pytest.mark.parametrize("steering", [0.42, 1.0])
def test_the_smallest_circle_of_the_car(steering: float) -> None:
    world = world_of("ackermann_car", angular_command="steering")
    car = world.model("ackermann_car")
    command(world, "ackermann_car", 0.5, steering)
    run(world, 3.0)
    points = []
    for _ in range(80):
        run(world, 0.1)
        points.append(car.position[:2])
    # The middle of the rear axle is the origin of the car.
    expected = 0.32 / math.tan(0.42)
    assert circle_radius(np.array(points)) == pytest.approx(expected, rel=0.02)


def test_the_car_obeys_a_yaw_rate_and_its_encoders_measure_its_path() -> None:
    world = world_of("ackermann_car")
    car = world.model("ackermann_car")
    for w in (0.5, -0.5, 0.0):
        command(world, "ackermann_car", 0.8, w)
        run(world, 4.0)
        assert world.ports["ackermann_car/odom"].value.angular_velocity[2] == pytest.approx(
            w, abs=0.02
        )
    odometry = np.array(world.ports["ackermann_car/odom"].value.position[:2])
    assert np.linalg.norm(odometry - np.array(car.position[:2])) < 0.02 * 9.6


def test_the_car_is_as_fast_as_it_says_and_says_so_of_more() -> None:
    world = world_of("ackermann_car", odometry_source="world")
    command(world, "ackermann_car", 8.0, 0.0)
    with pytest.warns(trident_sim.SimulationWarning, match="times its limit"):
        run(world, 4.0)
    assert world.ports["ackermann_car/odom"].value.linear_velocity[0] == pytest.approx(5, rel=0.01)
