# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import random

import pytest
from trident_eval.core.sweep.comparing import compare
from trident_eval.core.sweep.jobs import Job
from trident_eval.core.sweep.rows import DONE, FAILED, RunRow
from trident_eval.core.sweep.scenario import Comparison, Enough
from trident_eval.core.sweep.selection import Selection


def job(point: int, seed: int) -> Job:
    return Job(f"{point}-{seed}", point, "m:f", {"mode": "ab"[point]}, seed, 1.0, 0.0, ("y",))


def row(one: Job, value: float | None) -> RunRow:
    status, metrics = (FAILED, {}) if value is None else (DONE, {"y": value})
    return RunRow(
        one.key, one.point, one.seed, one.parameters, status, "", metrics, "", 0.0, 0.0, 0.0, ""
    )


JOBS = [job(point, seed) for seed in range(1, 11) for point in (0, 1)]
VALUES = {one.key: 1.0 + 0.01 * one.seed + (one.seed % 3) * one.point for one in JOBS}


@pytest.mark.parametrize("order", range(10))
def test_what_counts_does_not_depend_on_the_order_in_which_runs_end(order: int) -> None:
    shuffled = random.Random(order).sample(JOBS, len(JOBS))
    selection = Selection(JOBS, Enough("y", 0.05, 3))
    for one in shuffled:
        selection.add(row(one, VALUES[one.key]))
    assert selection.narrowed == {0: 3}
    assert [(one.point, one.seed) for one in selection.rows()] == (
        [(0, seed) for seed in (1, 2, 3)] + [(1, seed) for seed in range(1, 11)]
    )


def test_a_point_that_has_enough_needs_no_more_runs() -> None:
    selection = Selection(JOBS, Enough("y", 0.05, 3))
    for seed in (1, 2, 3):
        assert selection.is_needed(job(0, seed))
        selection.add(row(job(0, seed), 1.0 + 0.01 * seed))
        assert not selection.is_needed(job(0, seed))
    assert not selection.is_needed(job(0, 4))
    assert selection.is_needed(job(1, 1))


def test_failed_runs_count_as_made_and_not_as_numbers() -> None:
    selection = Selection(JOBS, Enough("y", 0.05, 3))
    for seed, value in ((1, 1.0), (2, None), (3, 1.0)):
        selection.add(row(job(0, seed), value))
    assert selection.narrowed == {0: 3}
    assert selection.width(0) == 0.0


def test_comparisons_pair_runs_of_the_same_seed() -> None:
    rows = [row(one, one.seed + 5.0 * (one.point == 0)) for one in JOBS if one.seed != 4]
    rows.append(row(job(0, 4), 100.0))  # its partner is missing
    (found,) = compare([Comparison("mode", "a", "b", "y")], rows)
    assert found.difference is not None
    assert found.difference.estimate.mean == 5.0
    assert found.difference.estimate.count == 9
    assert found.unpaired == 1


def test_a_comparison_without_pairs() -> None:
    (found,) = compare([Comparison("mode", "a", "b", "y")], [row(job(0, 1), 1.0)])
    assert found.difference is None
