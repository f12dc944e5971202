# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from trident_fleet.core.assignment import assign, guaranteed_separation
from trident_fleet.core.errors import FormationError
from trident_fleet.core.patterns import KINDS, Pattern, places
from trident_fleet.core.quintic import Array
from trident_fleet.core.separation import min_separation
from trident_fleet.core.transition import plan_transition

SEEDS = st.integers(0, 2**32 - 1)


def scattered(seed: int, count: int, side_m: float, apart_m: float) -> Array:
    """Points in a cube, at least `apart_m` from each other; fewer if there is no room."""
    candidates = np.random.default_rng(seed).uniform(0.0, side_m, size=(20 * count, 3))
    distances = np.linalg.norm(candidates[:, None] - candidates[None], axis=-1)
    chosen: list[int] = []
    for number in range(len(candidates)):
        if len(chosen) < count and (distances[number, chosen] >= apart_m).all():
            chosen.append(number)
    return np.asarray(candidates[chosen])


def permuted(points: Array, seed: int) -> Array:
    return points[np.random.default_rng(seed).permutation(len(points))]


@given(kind=st.sampled_from(KINDS), count=st.integers(1, 60), spacing=st.floats(0.1, 20.0))
def test_neighbors_of_every_pattern_are_a_spacing_apart(
    kind: str, count: int, spacing: float
) -> None:
    points = places(Pattern(kind, spacing), count)
    assert points.shape == (count, 3)
    np.testing.assert_allclose(points.mean(axis=0), 0.0, atol=1e-9 * spacing * count)
    if count > 1:
        assert min_separation(points[None]) == pytest.approx(spacing, rel=1e-9)


def test_the_places_are_where_the_names_say() -> None:
    s = math.sqrt(0.5)
    line = [[0, 1.5, 0], [0, 0, 0], [0, -1.5, 0]]
    np.testing.assert_allclose(places(Pattern("line"), 3), line)
    wedge = places(Pattern("wedge", 1.0), 5)
    np.testing.assert_allclose(
        wedge - wedge[0],
        [[0, 0, 0], [-s, s, 0], [-s, -s, 0], [-2 * s, 2 * s, 0], [-2 * s, -2 * s, 0]],
        atol=1e-12,
    )
    circle = places(Pattern("circle", radius_m=2.0), 4)
    np.testing.assert_allclose(circle, [[2, 0, 0], [0, 2, 0], [-2, 0, 0], [0, -2, 0]], atol=1e-12)
    grid = places(Pattern("grid", 1.0, columns=2), 4)
    corners = [[0.5, 0.5, 0], [0.5, -0.5, 0], [-0.5, 0.5, 0], [-0.5, -0.5, 0]]
    np.testing.assert_allclose(grid, corners)


@pytest.mark.parametrize(
    ("pattern", "what"),
    [
        (Pattern("square"), "pattern: 'square'; legal: line, wedge, circle, grid"),
        (Pattern("line", 0.0), "spacing_m: 0.0"),
        (Pattern("line", math.nan), "spacing_m: nan"),
        (Pattern("circle", radius_m=-1.0), "radius_m: -1.0"),
        (Pattern("wedge", opening_deg=5.0), "opening_deg: 5.0; legal: 10 to 180"),
        (Pattern("grid", columns=-1), "columns: -1"),
    ],
)
def test_bad_patterns_are_refused(pattern: Pattern, what: str) -> None:
    with pytest.raises(FormationError, match=what):
        places(pattern, 4)


@given(seed=SEEDS, count=st.integers(1, 6))
def test_no_assignment_has_less_squared_distance(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    start, goal = rng.normal(size=(2, count, 3)) * 5.0
    place = assign(start, goal)
    assert sorted(place) == list(range(count))
    best = min(
        float(((goal[list(order)] - start) ** 2).sum())
        for order in itertools.permutations(range(count))
    )
    assert ((goal[place] - start) ** 2).sum() == pytest.approx(best, abs=1e-5)


def test_of_equal_distances_the_one_in_order_is_taken() -> None:
    square = places(Pattern("circle", radius_m=1.0), 8)
    up = square + np.array([0.0, 0.0, 5.0])
    np.testing.assert_array_equal(assign(square, up), range(8))
    np.testing.assert_array_equal(assign(np.zeros((5, 3)), up[:5]), range(5))


@given(seed=SEEDS, count=st.integers(2, 25), apart=st.floats(0.5, 1.5))
def test_assigned_straight_paths_keep_what_theory_promises(
    seed: int, count: int, apart: float
) -> None:
    start = scattered(seed, count, 6.0, apart)
    targets = scattered(seed + 1, len(start), 6.0, 1.0)
    assume(len(start) == len(targets) >= 2)
    goal = targets[assign(start, targets)]
    flown = np.stack([start, goal])
    assert min_separation(flown) >= guaranteed_separation(start, goal) - 1e-5
    assert guaranteed_separation(start, goal) >= apart / math.hypot(1.0, apart) - 1e-9


@given(seed=SEEDS, count=st.integers(1, 20), pair=st.permutations(KINDS))
def test_patterns_change_into_each_other_all_at_once(
    seed: int, count: int, pair: list[str]
) -> None:
    start = permuted(places(Pattern(pair[0], 1.5), count), seed)
    targets = places(Pattern(pair[1], 1.5), count) + np.array([1.0, -2.0, 0.3])
    transition = plan_transition(start, targets, 1.5 / math.sqrt(2.0))
    assert len(transition.waves) == 1
    assert sorted(transition.place) == list(range(count))
    np.testing.assert_array_equal(transition.goal, targets[list(transition.place)])
    np.testing.assert_array_equal(transition.points(), [start, transition.goal])


@given(seed=SEEDS, count=st.integers(2, 12))
def test_what_is_planned_holds_the_separation_in_however_many_waves(seed: int, count: int) -> None:
    start, targets = scattered(seed, count, 5.0, 1.0), scattered(seed + 1, count, 5.0, 1.0)
    assume(len(start) == len(targets) == count)
    try:
        transition = plan_transition(start, targets, 1.0)
    except FormationError as refusal:
        assume("no order of departures" not in str(refusal))
        raise
    points = transition.points()
    assert min_separation(points) >= 1.0 - 1e-6
    assert transition.separation_m == min_separation(points)
    np.testing.assert_array_equal(points[-1], transition.goal)
    movers = [vehicle for wave in transition.waves for vehicle in wave]
    assert sorted(movers) == list(range(count))


def test_a_transition_that_is_too_tight_goes_in_waves() -> None:
    start = places(Pattern("line", 1.2), 12)
    targets = places(Pattern("circle", 1.2), 12)
    transition = plan_transition(start, targets, 1.0)
    assert len(transition.waves) > 1
    assert min_separation(np.stack([start, transition.goal])) < 1.0
    assert transition.separation_m >= 1.0 - 1e-6


def test_what_no_order_solves_is_refused_with_what_would_help() -> None:
    start = places(Pattern("circle", 1.5), 7)
    targets = places(Pattern("grid", 1.5), 7)
    what = r"vehicles \d and \d would come within 1\.\d+ m, .* 1\.4; legal: .* spacing of 1\.980 m"
    with pytest.raises(FormationError, match=what):
        plan_transition(start, targets, 1.4)


def test_places_that_are_too_close_themselves_are_named() -> None:
    start = np.array([[0.0, 0, 1], [0.0, 2, 1], [0.0, 4, 1]])
    with pytest.raises(FormationError, match=r"after: places 2 and 3 are 0.500 m apart; .*1"):
        plan_transition(start, np.array([[0.0, 0, 1], [2.0, 0, 1], [2.5, 0, 1]]), 1.0)
    with pytest.raises(FormationError, match=r"before: vehicles 1 and 2 are 2.000 m apart"):
        plan_transition(start, 2.0 * start, 3.0)
