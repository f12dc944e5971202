# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The benchmark of environments: what its rows hold, and a learner whose return rises."""

from __future__ import annotations

import pytest
from trident_benchmarks.envs.measure import (
    learning_row,
    line,
    repeated_row,
    reset_row,
    speed_row,
    vector_row,
)


def test_a_row_says_whether_its_limit_was_missed() -> None:
    row = speed_row("Hover", 200, limit=1e12)
    assert row["us"] == pytest.approx(1e6 / row["per_s"])
    assert not row["passed"]
    assert "limit missed" in line(row)
    assert "limit missed" not in line(vector_row(200))


def test_resets_are_counted_and_repeat() -> None:
    assert reset_row(1000)["growth_mb"] <= 1.0
    assert repeated_row()["passed"]


def test_the_return_of_the_example_rises() -> None:
    row = learning_row(3600.0, generations=12)
    assert row["generations"] == 12
    assert row["last_return"] > row["first_return"] + 20.0
