# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from trident_benchmarks.links.measure import line
from trident_benchmarks.links.station import SHORT_LIMIT_DB, station_row
from trident_benchmarks.links.station_scene import (
    FENCE,
    MARGIN_M,
    best_of_grid,
    grid_of,
    station_scene,
)
from trident_fleet.core.station.config import SearchConfig

BRIEF = SearchConfig(survey_s=40.0, refine_s=30.0, places=1500)


def test_scenes_are_those_of_their_seeds() -> None:
    assert station_scene(3) == station_scene(3)
    boat, mast = station_scene(3).places
    assert boat != station_scene(4).places[0]
    assert boat[1] < -10.0
    assert 35.0 < mast[1] < 75.0


def test_the_grid_fills_the_fence() -> None:
    grid = grid_of(FENCE)
    assert len(grid) == 41 * 41 * 5
    assert FENCE.clearance(grid).min() >= MARGIN_M - 1e-9
    few = grid[::400]
    best_db, place, direct_db = best_of_grid(station_scene(1), few)
    assert any(np.array_equal(place, other) for other in few)
    assert 10.0 < best_db < 40.0
    assert direct_db == pytest.approx(24.18, abs=0.01)


# Two coasts, with a fifth of the flight that the benchmark gives it.
@pytest.mark.parametrize(("seed", "short_db"), [(1, SHORT_LIMIT_DB), (2, 4.0)])
def test_a_brief_search_comes_near_to_the_best_place(seed: int, short_db: float) -> None:
    row = station_row(seed, BRIEF)
    assert row["short_db"] <= short_db
    assert row["clearance_m"] > 0.5 * MARGIN_M
    assert row["found_s"] < 110.0
    assert f"coast {seed}: held" in line(row)
    assert ("limit missed" in line(row)) is not row["passed"]
