# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Fields of cylinders: fenced in, with room along their path, the same again from the same seed."""

from __future__ import annotations

import csv
import io
import itertools
import math

import numpy as np
import pytest

import trident_sim
from trident_worldgen import CylindersConfig, Files, cylinders


def table(files: Files, name: str) -> np.ndarray:
    """Rows of numbers of a table."""
    text = files[name]
    assert isinstance(text, str)
    return np.array([[float(v) for v in row] for row in list(csv.reader(io.StringIO(text)))[1:]])


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_path_leaves_the_clearance_that_is_promised(seed: int) -> None:
    files = cylinders(CylindersConfig(seed=seed))
    places = table(files, f"world_{seed}.obstacles.csv")
    path = table(files, f"world_{seed}.path.csv")
    assert tuple(path[0]) == (-2.25, 3.0)
    assert tuple(path[-1]) == (-2.25, 13.0)
    for x, y in path[1:-1]:
        assert np.hypot(*(places[:, :2] - (x, y)).T).min() >= 0.3 - 1e-6
    steps = [math.dist(a, b) for a, b in itertools.pairwise(path[1:-1])]
    assert max(steps) <= 0.15 * math.sqrt(2.0) + 2e-3


def test_the_field_is_closed_on_three_sides_and_dense() -> None:
    places = table(cylinders(), "world_1.obstacles.csv")
    assert len({tuple(place) for place in places}) == len(places)
    for fence in (places[:, 0].min(), places[:, 0].max()):
        assert np.count_nonzero(np.isclose(places[:, 0], fence)) == 64
    assert np.count_nonzero(np.isclose(places[:, 1], places[:, 1].min())) == 30
    within = (places[:, 1] > 5.1) & (np.abs(places[:, 0] + 2.25) < 2.0)
    assert np.count_nonzero(within) > 20
    entry = (places[:, 1] > 0.1) & (places[:, 1] < 5.1) & (np.abs(places[:, 0] + 2.25) < 2.0)
    assert not np.any(entry)


def test_a_seed_decides_everything() -> None:
    assert cylinders() == cylinders(CylindersConfig(seed=1))
    assert cylinders(CylindersConfig(seed=2)) != cylinders()


def test_a_field_without_a_path_is_refused() -> None:
    config = CylindersConfig(least_fill=0.35, greatest_fill=0.35, clearance=0.5)
    with pytest.raises(trident_sim.Error, match="no path through"):
        cylinders(config)
