# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from trident_fleet.core.config import FlightLimits, PlanConfig
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource, read_formation
from trident_fleet.core.quintic import Array
from trident_fleet.core.separation import min_separation, pair_separations
from trident_fleet.core.transit import transit_path, transit_points

CONFIG = PlanConfig()


def grid(rng: np.random.Generator, count: int, height: float) -> Array:
    """Different cells of a 1.5 m grid, shaken by less than keeps them 1 m apart."""
    cells = rng.permutation(36)[:count]
    points = np.stack([cells % 6, cells // 6, np.zeros(count)], axis=1) * 1.5
    points[:, :2] += rng.uniform(-0.15, 0.15, (count, 2))
    points[:, 2] = height
    return points


def flown_separation(points: Array) -> float:
    path = transit_path(points, CONFIG.limits)
    return min_separation(path.derivative(np.arange(0.0, path.duration, 0.02), 0))


def test_separation_counts_between_the_points() -> None:
    points = np.array([[[0.0, 0, 0], [1.0, -1, 0]], [[0.0, 0, 0], [1.0, 1, 0]]])
    assert min_separation(points) == pytest.approx(1.0)
    np.testing.assert_allclose(pair_separations(points[:1]), np.sqrt(2.0))
    assert min_separation(points[:, :1]) == np.inf


def test_who_stands_in_line_goes_straight(line_spawn: Array) -> None:
    goal = line_spawn + np.array([1.0, 0.0, 1.5])
    points = transit_points(line_spawn, goal, CONFIG)
    assert len(points) == 3
    np.testing.assert_array_equal(points[1], line_spawn + np.array([0.0, 0.0, CONFIG.climb_m]))


@pytest.mark.parametrize("order", ["reversed", "grid", "swapped"])
def test_from_any_grid_to_the_line_without_coming_close(
    order: str, own_formation: Path, line_spawn: Array
) -> None:
    goal = read_formation(FormationSource(str(own_formation)))[0]
    spawn = {
        "reversed": line_spawn[::-1],
        "grid": np.array([[2.0 * (i % 3), 2.0 * (i // 3), 0.1] for i in range(6)]),
        "swapped": line_spawn[[1, 0, 3, 2, 5, 4]],
    }[order]
    points = transit_points(spawn, goal, CONFIG)
    np.testing.assert_array_equal(points[0], spawn)
    np.testing.assert_array_equal(points[-1], goal)
    assert flown_separation(points) >= CONFIG.min_separation_m - 1e-6


@settings(max_examples=60)
@given(seed=st.integers(0, 100_000), count=st.integers(1, 12))
def test_any_grid_to_any_grid_is_free_of_collisions(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    spawn, goal = grid(rng, count, 0.1), grid(rng, count, 1.0)
    goal[:, 2] += rng.uniform(0.0, 2.0, count)
    points = transit_points(spawn, goal, CONFIG)
    assert min_separation(points) >= CONFIG.min_separation_m - 1e-6
    # Nobody moves sideways on the ground.
    np.testing.assert_array_equal(points[1][:, :2], spawn[:, :2])


def test_a_column_in_the_air_is_built_in_the_right_order() -> None:
    spawn = np.array([[2.0 * i, 0.0, 0.1] for i in range(4)])
    goal = np.array([[0.0, 5.0, height] for height in (4.0, 1.0, 3.0, 2.0)])
    points = transit_points(spawn, goal, CONFIG)
    assert flown_separation(points) >= 1.0 - 1e-6


def test_only_those_in_conflict_use_more_layers() -> None:
    spawn = np.array([[0.0, 0, 0.1], [2.0, 0, 0.1], [20.0, 0, 0.1], [22.0, 0, 0.1]])
    goal = spawn[[1, 0, 3, 2]] + np.array([0.0, 0.0, 1.0])
    heights = transit_points(spawn, goal, CONFIG)[1][:, 2]
    assert len(np.unique(heights)) == 2


def test_vehicles_that_stand_closer_than_wanted_stay_as_far_apart_as_they_are() -> None:
    spawn = np.array([[0.5 * i, 0.0, 0.1] for i in range(3)])
    goal = spawn[::-1] + np.array([0.0, 3.0, 1.0])
    assert flown_separation(transit_points(spawn, goal, CONFIG)) >= 0.5 - 1e-6


def test_two_vehicles_at_one_place_are_named() -> None:
    spawn = np.array([[0.0, 0, 0.1], [1.0, 0, 0.1], [1.0, 0, 0.1]])
    goal = np.array([[0.0, 0, 1], [1.0, 0, 1], [2.0, 0, 1]])
    with pytest.raises(FormationError, match=r"spawn positions: vehicles 2 and 3 are both at \(1"):
        transit_points(spawn, goal, CONFIG)
    with pytest.raises(FormationError, match=r"first row: vehicles 2 and 3 are both at \(1"):
        transit_points(goal, spawn, CONFIG)


def test_a_path_that_cannot_be_free_is_refused() -> None:
    # One stands above the other, and they have to change places.
    spawn = np.array([[0.0, 0, 0.1], [0.0, 0, 2.0]])
    goal = np.array([[3.0, 0, 3.0], [3.0, 0, 1.0]])
    with pytest.raises(FormationError, match=r"spawn positions of vehicles 1 and 2: .*legal: 1.00"):
        transit_points(spawn, goal, CONFIG)


@settings(max_examples=30)
@given(
    distance=st.floats(0.0, 50.0),
    v=st.floats(0.2, 5),
    a=st.floats(0.2, 5),
    j=st.floats(0.2, 10),
)
def test_legs_keep_the_limits(distance: float, v: float, a: float, j: float) -> None:
    limits = FlightLimits(v, a, j)
    points = np.array([[[0.0, 0, 0]], [[distance, 0, 0]]])
    path = transit_path(points, limits)
    time = np.linspace(0.0, path.duration, 2001)
    for order, limit in ((1, v), (2, a), (3, j)):
        assert np.abs(path.derivative(time, order)).max() <= limit * (1 + 1e-9)
