# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Conformance of coverage planners: a new one is in the registry, and so in here."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from trident_fleet.core.search.area import SearchError
from trident_fleet.core.search.planners import PLANNERS, planner_named
from trident_fleet.core.search.planners.base import CoverageProblem, lower_bound
from trident_fleet.core.search.planners.boustrophedon import parts_of
from trident_fleet.core.search.samples import random_map

MAPS = range(6)
# Mean length over the lower bound, of those that promise short paths.
SHORT = {"boustrophedon": 1.10, "tree": 1.10, "spiral": 1.15}


def check(problem: CoverageProblem, name: str) -> int:
    """A path is one, and covers what can be reached. Returns its steps."""
    path = planner_named(name).plan(problem)
    assert path[0] == problem.start
    assert all(abs(a - c) + abs(b - d) == 1 for (a, b), (c, d) in itertools.pairwise(path))
    visited = np.zeros(problem.free.shape, dtype=bool)
    visited[tuple(np.array(path).T)] = True
    np.testing.assert_array_equal(visited, problem.reachable)
    assert path == planner_named(name).plan(problem), "the same again"
    return len(path) - 1


@pytest.mark.parametrize("name", PLANNERS)
def test_paths_cover_all_that_can_be_reached_and_are_short(name: str) -> None:
    ratios = [check(random_map(seed), name) / lower_bound(random_map(seed)) for seed in MAPS]
    assert np.mean(ratios) <= SHORT.get(name, 2.0)


@pytest.mark.parametrize("name", PLANNERS)
@settings(max_examples=15, deadline=None)
@given(
    free=arrays.arrays(bool, st.tuples(st.integers(1, 9), st.integers(1, 9))),
    pick=st.integers(0, 80),
)
def test_whatever_the_map_all_is_covered(name: str, free: np.ndarray, pick: int) -> None:
    cells = np.argwhere(free)
    if len(cells):
        row, column = cells[pick % len(cells)]
        check(CoverageProblem(free, (int(row), int(column))), name)


@pytest.mark.parametrize("name", PLANNERS)
def test_an_open_field_is_covered_without_a_detour(name: str) -> None:
    problem = CoverageProblem(np.ones((8, 10), dtype=bool), (0, 0))
    steps = check(problem, name)
    assert steps <= 1.3 * lower_bound(problem)
    if name in SHORT:
        assert steps == lower_bound(problem)


def test_the_probabilistic_planner_goes_to_what_is_worth_most_per_step() -> None:
    gain = np.full((5, 31), 0.01)
    gain[:, :3] = 1.0  # nearby
    gain[:, -3:] = 1.5  # far away
    path = planner_named("probabilistic").plan(
        CoverageProblem(np.ones(gain.shape, dtype=bool), (2, 8), gain)
    )
    first = next(cell for cell in path if gain[cell] >= 1.0)
    assert first[1] < 3
    collected = np.cumsum([gain[cell] * (path.index(cell) == i) for i, cell in enumerate(path)])
    assert collected[60] > 0.8 * gain.sum(), "what is worth most comes first"


def test_parts_are_strips_without_an_obstacle_between() -> None:
    free = np.ones((6, 9), dtype=bool)
    free[2:4, 3:6] = False
    parts = parts_of(free)
    assert len(parts) == 4, "below, left, right, above"
    covered = np.zeros(free.shape, dtype=int)
    for part in parts:
        for strip in part:
            covered[strip.row, strip.first : strip.last + 1] += 1
    np.testing.assert_array_equal(covered, free.astype(int))


def test_bad_input_names_what_is_wrong() -> None:
    free = np.ones((3, 3), dtype=bool)
    free[1, 1] = False
    with pytest.raises(SearchError, match=r"start is \(1, 1\), legal: a free cell"):
        CoverageProblem(free, (1, 1))
    with pytest.raises(SearchError, match=r"start is \(3, 0\)"):
        CoverageProblem(free, (3, 0))
    with pytest.raises(SearchError, match=r"gain has shape \(2, 2\), legal: \(3, 3\)"):
        CoverageProblem(free, (0, 0), np.ones((2, 2)))
    with pytest.raises(SearchError, match="planner is 'zigzag', legal: boustrophedon, spiral"):
        planner_named("zigzag")
