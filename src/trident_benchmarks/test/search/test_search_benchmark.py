# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The benchmark of searches: rows pass on a few maps, and say so."""

from __future__ import annotations

import pytest
from trident_benchmarks.search.measure import detection_row, line, planner_row, shares_row


@pytest.mark.parametrize("name", ["tree", "spiral"])
def test_a_planner_covers_all_maps(name: str) -> None:
    row = planner_row(name, 2)
    assert row["covered"] == row["maps"] == 2
    assert 1.0 <= row["length_over_bound"] <= row["worst"]
    assert row["passed"]


def test_shares_are_balanced() -> None:
    row = shares_row(3)
    assert row["worst"] <= 0.05
    assert "limit missed" not in line(row)
    assert "limit missed" in line(row | {"passed": False})


def test_detection_is_as_often_as_the_model_says() -> None:
    assert detection_row(1500)["worst"] < 0.06
