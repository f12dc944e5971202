# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from polygons import U_SHAPE, fences, star
from trident_fleet.core.errors import FormationError
from trident_fleet.core.station.fence import Fence

SQUARE = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]])


def test_clearance_is_the_distance_to_the_nearest_face() -> None:
    fence = Fence(SQUARE, 2.0, 6.0)
    points = np.array([[5, 5, 4], [1, 5, 4], [5, 5, 5.5], [-3, 5, 4], [5, 5, 1.5], [-3, -4, 4.0]])
    np.testing.assert_allclose(fence.clearance(points), [2, 1, 0.5, -3, -0.5, -5])


@given(fences(), st.integers(0, 10**6))
@settings(max_examples=60)
def test_clearance_has_the_sign_of_an_independent_test(fence: Fence, seed: int) -> None:
    from matplotlib.path import Path

    random = np.random.default_rng(seed)
    points = np.column_stack([random.uniform(-60, 60, (50, 2)), np.full(50, 25.0)])
    clearance = fence.clearance(points)
    is_in = Path(fence.corners).contains_points(points[:, :2])
    is_clear = np.abs(clearance) > 1e-9
    np.testing.assert_array_equal(clearance[is_clear] > 0.0, is_in[is_clear])


def test_a_path_across_a_bay_leaves_the_fence() -> None:
    fence = Fence(U_SHAPE, 10.0, 20.0)
    across = np.array([[20.0, 90.0, 15.0], [80.0, 90.0, 15.0]])
    assert fence.clearance(across).min() > 0.0
    assert fence.path_clearance(across) < 0.0
    along = np.array([[20.0, 90.0, 15.0], [20.0, 20.0, 15.0]])
    assert fence.path_clearance(along) == pytest.approx(5.0)


def test_a_route_leads_around_a_bay() -> None:
    fence = Fence(U_SHAPE, 10.0, 20.0)
    start, goal = np.array([20.0, 90.0, 12.0]), np.array([80.0, 90.0, 18.0])
    route = fence.route(start, goal, 2.0)
    assert route is not None
    np.testing.assert_array_equal(route[-1], goal)
    path = np.vstack([start, route])
    assert fence.path_clearance(path) >= 2.0
    shortest = 2.0 * math.hypot(20.0, 50.0) + 20.0  # around both corners, without a margin
    length = np.linalg.norm(np.diff(path[:, :2], axis=0), axis=1).sum()
    assert shortest < length < shortest + 8.0


@given(fences(), st.integers(0, 10**6))
@settings(max_examples=60)
def test_a_route_keeps_its_margin(fence: Fence, seed: int) -> None:
    random = np.random.default_rng(seed)
    points = np.column_stack([random.uniform(-50, 50, (60, 2)), random.uniform(22, 28, 60)])
    kept = points[fence.clearance(points) >= 1.0]
    for start, goal in itertools.pairwise(kept):
        route = fence.route(start, goal, 1.0)
        if route is not None:
            assert fence.path_clearance(np.vstack([start, route])) >= 1.0 - 1e-9


def test_where_no_path_leads_there_is_no_route() -> None:
    hourglass = np.array([[0, 0], [10, 0], [5.2, 10], [10, 20], [0, 20], [4.8, 10.0]])
    fence = Fence(hourglass, 10.0, 20.0)
    assert fence.route(np.array([5.0, 3, 15]), np.array([5.0, 17, 15]), 1.0) is None
    assert fence.route(np.array([5.0, 3, 15]), np.array([50.0, 17, 15]), 1.0) is None
    assert fence.route(np.array([5.0, 3, 15]), np.array([5.0, 17, 15]), 0.1) is not None


def test_a_place_near_a_face_is_moved_to_the_margin() -> None:
    fence = Fence(SQUARE, 2.0, 6.0)
    np.testing.assert_allclose(fence.nearest_inside(np.array([0.4, 5, 7]), 1.0), [1, 5, 5])
    corner = fence.nearest_inside(np.array([0.2, 0.3, 4]), 1.0)
    assert corner is not None
    np.testing.assert_allclose(corner, [1, 1, 4])
    own = np.array([5.0, 4.0, 4.0])
    np.testing.assert_array_equal(fence.nearest_inside(own, 1.0), own)


@pytest.mark.parametrize(
    ("corners", "low", "high", "what"),
    [
        ([[0, 0], [1, 1]], 1, 2, "fence: .* legal: 3 or more corners"),
        ([[0, 0], [5, 5], [5, 0], [0, 5]], 1, 2, "whose sides do not cross"),
        ([[0, 0], [5, 0], [9, 0]], 1, 2, "legal: 3 or more corners"),
        ([[0, 0], [5, 0], [math.nan, 3]], 1, 2, "legal: 3 or more corners"),
        (SQUARE, 5, 5, "highest: 5 m; legal: above lowest, 5 m"),
        (SQUARE, 5, math.inf, "highest: inf m; legal"),
    ],
)
def test_what_is_no_fence_is_refused(
    corners: list[list[float]], low: float, high: float, what: str
) -> None:
    with pytest.raises(FormationError, match=what):
        Fence(np.array(corners, dtype=float), low, high).validate()


def test_stars_are_legal() -> None:
    Fence(star([30.0, 12.0, 40.0, 9.0, 25.0]), 20.0, 30.0).validate()
