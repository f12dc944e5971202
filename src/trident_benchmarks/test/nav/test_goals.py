# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The judge of drives to goals: where there is room, and where the robot is."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("rospy", reason="the workspace is not sourced")

from nav_msgs.msg import Odometry
from trident_benchmarks.nav.drive_node import plane_pose
from trident_benchmarks.nav.goals import Places, Tried
from trident_benchmarks.nav.pictures.drives import draw_drive
from trident_sim.occupancy import FREE, OCCUPIED, OccupancyMap

RESOLUTION_M = 0.05


def room() -> Places:
    """From (-1, -2) to (1, 2), with walls of one cell."""
    cells = np.full((80, 40), FREE, dtype=np.int8)
    cells[[0, -1], :] = OCCUPIED
    cells[:, [0, -1]] = OCCUPIED
    return Places(OccupancyMap(cells, RESOLUTION_M, (-1.0, -2.0)), 0.1, 0.2)


@pytest.mark.parametrize("x", np.linspace(-0.94, 0.94, 21))
def test_clearance_is_that_of_the_point_not_of_its_cell(x: float) -> None:
    assert room().clearance(x, 0.0) == pytest.approx(0.95 - abs(x), abs=1e-9)


@pytest.mark.parametrize("place", [(0.97, 0.0), (5.0, 0.0), (0.0, -2.5)])
def test_there_is_no_room_in_walls_and_beyond(place: tuple[float, float]) -> None:
    assert room().clearance(*place) == 0.0


def test_goals_have_the_room_that_was_asked_for() -> None:
    places, random = room(), np.random.default_rng(1)
    for _ in range(50):
        (x, y, _yaw), length_m = places.goal(random, (0.0, 0.0, 0.0), 0.5)
        assert places.clearance(x, y) > 0.2 - RESOLUTION_M
        assert length_m >= 0.5


def test_a_pose_that_is_none_is_not_taken() -> None:
    message = Odometry()
    assert plane_pose(message) is None
    q = message.pose.pose.orientation
    q.z, q.w = math.sin(0.4), math.cos(0.4)
    message.pose.pose.position.x = 3.0
    assert plane_pose(message) == pytest.approx((3.0, 0.0, 0.8))
    for value in (math.nan, math.inf, 1e300):
        message.pose.pose.position.y = value
        assert plane_pose(message) is None


def test_a_drive_has_a_picture_with_the_map_the_track_and_the_goals(tmp_path: Path) -> None:
    from matplotlib.image import imread

    grid = OccupancyMap(np.full((80, 40), FREE, dtype=np.int8), RESOLUTION_M, (-1.0, -2.0))
    reached = Tried((0.5, 1.0, 0.3), True, "Goal reached.", 3.0, 2.5, 0.01, 0.02, 0.5)
    missed = Tried((-0.5, -1.0, 2.0), False, "", 60.0, 0.0, 1.0, 0.5, 0.5)
    empty, full = tmp_path / "empty.png", tmp_path / "full.png"
    draw_drive(empty, grid, [], [])
    draw_drive(full, grid, [(0.0, 0.0, 0.0), (0.5, 1.0, 0.3)], [reached, missed])
    blank, drawn = imread(empty), imread(full)
    assert blank.shape == drawn.shape
    red_to_blue = drawn[..., 0].astype(float) - drawn[..., 2]
    assert (red_to_blue < -0.5).sum() > 50  # the track
    assert (red_to_blue > 0.5).sum() > 20  # the goal that was not reached
