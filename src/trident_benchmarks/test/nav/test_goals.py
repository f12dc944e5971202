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
from trident_benchmarks.nav.goals import Places, Route, Tried, lower_bound_s
from trident_benchmarks.nav.limits import RobotLimits
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
        (x, y, _yaw), route = places.goal(random, (0.0, 0.0, 0.0), 0.5)
        assert places.clearance(x, y) > 0.2 - RESOLUTION_M
        # Nothing is in between, whatever the cells' neighbors are.
        assert route.length_m == pytest.approx(math.hypot(x, y), abs=RESOLUTION_M)
        assert math.cos(route.leaves_rad - math.atan2(y, x)) > 0.9
        assert math.cos(route.arrives_rad - math.atan2(y, x)) > 0.9


def test_routes_go_tight_around_corners() -> None:
    cells = np.full((80, 80), FREE, dtype=np.int8)
    cells[38:42, :60] = OCCUPIED  # a wall from the left, 1 m of door at the right
    places = Places(OccupancyMap(cells, RESOLUTION_M, (-2.0, -2.0)), 0.2, 0.25)
    random = np.random.default_rng(2)
    beyond = 0
    for _ in range(50):
        (x, y, _yaw), route = places.goal(random, (-1.0, -1.0, 0.0), 0.5)
        straight = math.hypot(x + 1.0, y + 1.0)
        if y < -0.3:
            assert route.length_m == pytest.approx(straight, abs=2.0 * RESOLUTION_M)
            continue
        around = math.hypot(2.0, 0.9) + math.hypot(x - 1.0, y - 0.1)  # the corner itself
        assert route.length_m > straight
        assert around < route.length_m + 0.1 or x > 1.0
        beyond += 1
    assert beyond > 10


def test_bounds_of_times_have_the_turns_of_robots_that_drive_straight(tmp_path: Path) -> None:
    text = """
    local_costmap: {robot_radius: 0.2}
    TrajectoryPlannerROS: {max_vel_x: 0.5, max_vel_theta: 2.0, min_turning_radius: %s}
    """
    (tmp_path / "turns.yaml").write_text(text % 0.0)
    (tmp_path / "car.yaml").write_text(text % 0.7)
    route = Route(length_m=3.0, leaves_rad=1.0, arrives_rad=-1.0)
    start, goal = (0.0, 0.0, 0.0), (9.0, 9.0, 2.0 * math.pi - 2.0)
    bounds = [
        lower_bound_s(route, start, goal, RobotLimits(tmp_path / name))
        for name in ("turns.yaml", "car.yaml")
    ]
    assert bounds == pytest.approx([3.0 / 0.5 + (1.0 + 1.0) / 2.0, 3.0 / 0.5])


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
