# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the benchmark of trajectories are judged by their limits."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from trident_benchmarks.trajectories.picture import draw
from trident_benchmarks.trajectories.program import trials
from trident_benchmarks.trajectories.rows import (
    SPEED_LIMITS_MS,
    infeasible_row,
    line,
    optimum_row,
    random_row,
    speed_rows,
)


def _timed(**changes: Any) -> dict[str, Any]:
    trial = {"case": "swap of 6", "method": "auglag", "cpu_ms": 10.0, "is_feasible": True}
    return trial | {"jerk": 160.0, "excess": -1e-3} | changes


@pytest.mark.parametrize(
    "changes", [{"cpu_ms": 31.0}, {"is_feasible": False}, {"excess": 2e-4}], ids=str
)
def test_a_plan_that_is_slow_infeasible_or_beyond_its_limits_misses_the_row(
    changes: dict[str, Any],
) -> None:
    assert speed_rows([_timed()])[0]["passed"]
    (row,) = speed_rows([_timed(**changes)])
    assert not row["passed"]
    assert "(limit missed)" in line(row)


def test_the_default_may_be_two_percent_above_the_best_feasible_start() -> None:
    starts = [
        {"jerk": 100.0, "is_feasible": True, "default_jerk": 101.9},
        {"jerk": 50.0, "is_feasible": False, "default_jerk": 101.9},
    ]
    assert optimum_row(starts)["passed"]
    assert not optimum_row([start | {"default_jerk": 102.1} for start in starts])["passed"]


def test_only_problems_that_priorities_solve_count_as_missed() -> None:
    trial = {"seed": 1, "is_feasible": True, "is_shown_feasible": True, "excess": 1e-5}
    unsolved = trial | {"seed": 2, "is_feasible": False, "is_shown_feasible": False}
    assert random_row([trial, unsolved])["passed"]
    row = random_row([trial, unsolved | {"is_shown_feasible": True}])
    assert row["missed_seeds"] == [2]
    assert not row["passed"]


def test_one_wrong_name_misses_the_row_of_the_infeasible() -> None:
    assert infeasible_row([{"seed": 0, "is_true": True}])["passed"]
    assert infeasible_row([{"seed": 0, "is_true": True}, {"seed": 5}])["wrong_seeds"] == [5]


def test_the_program_plans_what_it_is_asked_for(tmp_path: Path) -> None:
    (row,) = trials("infeasible", 0, 1)
    assert not row["is_feasible"]
    cases = trials("picture")
    assert [case["case"] for case in cases] == ["swap of 6", "rendezvous of three"]
    draw(tmp_path / "teams.png", cases)
    assert (tmp_path / "teams.png").stat().st_size > 10_000
    assert ("swap of 6", "mma") in SPEED_LIMITS_MS
