# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Robots that drive by themselves in simulated worlds in this process, without ROS."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import xacro
from scipy import ndimage
from trident_nav.core.wander import Wander, WanderConfig
from trident_nav.core.waypoints import FollowerConfig, WaypointFollower

trident_sim = pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")
from trident_sim.occupancy import FREE, MapConfig, occupancy_map  # noqa: E402

REPO = Path(__file__).resolve().parents[2]
ROBOT = "my_nav_robot"

pytestmark = pytest.mark.filterwarnings("ignore::trident_sim.SimulationWarning")


def world_with_robot(world: str, seed: int = 0, **arguments: str) -> trident_sim.World:
    path = REPO / "src/trident_description/urdf" / f"{ROBOT}.urdf.xacro"
    result = trident_sim.World(REPO / "worlds" / f"{world}.world", seed=seed)
    urdf = str(xacro.process_file(str(path), mappings=arguments).toxml())
    result.spawn(ROBOT, urdf=urdf, namespace="")
    return result


@pytest.mark.parametrize(("name", "seed"), [("room", 1), ("office", 2)])
def test_a_wandering_robot_touches_nothing(name: str, seed: int) -> None:
    world = world_with_robot(name, seed)
    grid = occupancy_map(world_with_robot(name), MapConfig(heights=(0.1, 0.2), start=(1.0, 0.5)))
    clear = ndimage.distance_transform_edt(grid.cells == FREE) * grid.resolution
    wander = Wander(WanderConfig(seed=seed))
    scans = world.ports["scan"]
    scans.subscribe()
    robot = world.model(ROBOT)
    places = []
    for _ in range(900):
        world.step(100)
        scan = scans.read()
        if scan is None:
            continue
        angles = scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges))
        v, w = wander.command(scan.stamp, angles, scan.ranges.astype(float))
        world.ports["cmd_vel"].write(trident_sim.TwistCommand((v, 0, 0), (0, 0, w)))
        places.append(robot.position[:2])
    track = np.array(places)
    # The map has the robot itself where it began; elsewhere it shows how near walls are.
    away = track[np.linalg.norm(track, axis=1) > 0.5]
    cells = np.floor((away - grid.origin) / grid.resolution).astype(int)
    assert clear[cells[:, 1], cells[:, 0]].min() > 0.14, "half a diagonal of the robot is 0.16 m"
    assert abs(robot.position[2]) < 0.01
    distance = np.linalg.norm(np.diff(track, axis=0), axis=1).sum()
    assert distance > 12.0, "m in 90 s"
    assert np.ptp(track, axis=0).max() > 3.0, "it gets about"


def test_waypoints_are_followed_by_the_encoders() -> None:
    world = world_with_robot("room", odometry_source="encoder")
    corners = [(2.0, 0.0), (2.0, -1.0), (-2.0, -1.0), (-2.0, 0.0), (0.0, 0.0)]
    follower = WaypointFollower(corners, FollowerConfig(speed=0.4))
    odometry = world.ports["odom"]
    odometry.subscribe()
    robot = world.model(ROBOT)
    truth = []
    while not follower.is_done and world.time < 120.0:
        world.step(10)
        sample = odometry.read()
        if sample is None:
            continue
        q = sample.orientation
        pose = (*sample.position[:2], 2.0 * math.atan2(q[2], q[3]))
        v, w = follower.command(sample.stamp, pose)
        world.ports["cmd_vel"].write(trident_sim.TwistCommand((v, 0, 0), (0, 0, w)))
        truth.append(robot.position[:2])
    assert follower.is_done
    assert math.dist(truth[-1], corners[-1]) < 0.25, "what the wheels slip adds up"
    track = np.array(truth)
    for corner in corners[:-1]:
        assert np.linalg.norm(track - corner, axis=1).min() < 0.25
