# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The benchmark of missions: its sweep is legal, and gains are paired by coast."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from trident_benchmarks.mission.measure import FULL, SHORT, Case, gains, line, row_of, scenario_text
from trident_benchmarks.mission.picture import draw_coverage
from trident_benchmarks.mission.subjects import metrics_of
from trident_eval.core.sweep.rows import RunRow
from trident_eval.core.sweep.scenario import read_scenario
from trident_fleet.core.missions.mission import Outcome


def run_row(seed: int, efficiency: float, **changed: float) -> RunRow:
    curve = tuple(0.01 * step for step in range(1, 91))
    outcome = Outcome(
        900.0,
        False,
        0.5,
        12,
        11,
        10,
        9,
        20,
        15.0 * efficiency,
        (30.0, 60.0),
        {"a": 5.0},
        0,
        7,
        curve,
        (),
    )
    metrics = metrics_of(outcome) | changed
    return RunRow("k", 0, seed, {}, "done", "", metrics, "", 1.0, 2.0, 3.0, "w")


def test_the_metrics_of_a_run_are_those_that_the_sweep_asks_for(tmp_path: Path) -> None:
    file = tmp_path / "mission.yaml"
    for case in FULL:
        file.write_text(scenario_text(case, 3))
        scenario = read_scenario(file)
        assert {metric.name for metric in scenario.metrics} == set(run_row(1, 1.0).metrics)
        assert scenario.parameters == case._asdict()
    assert run_row(1, 1.0).metrics["curve_60"] == pytest.approx(0.06)


def test_gains_are_over_the_best_rival_on_the_same_coast() -> None:
    own = {1: 9.0, 2: 6.0, 3: 1.0}
    rivals = [{1: 3.0, 2: 1.0}, {1: 2.0, 2: 2.0}]
    assert gains(own, rivals) == pytest.approx([2.0, 2.0])


def test_a_row_has_means_with_lower_ends_and_fails_where_rivals_are_weak() -> None:
    flown: dict[Case, Any] = {}
    for mode, efficiency in (("uav", 2.0), ("ugv", 3.0), ("usv", 2.0)):
        flown[Case(mode)] = [run_row(seed, efficiency) for seed in (1, 2)]
        row = row_of(Case(mode), flown[Case(mode)], flown)
        assert row["passed"] == (mode != "usv"), "2.0 is less than 90 % of 2.8"
        assert "efficiency_gain" not in row
    joint = row_of(SHORT[-1], [run_row(1, 9.0), run_row(2, 12.0)], flown)
    assert joint["efficiency_gain"] == pytest.approx(2.5)
    assert joint["efficiency_gain_low"] < 2.0
    assert joint["found"] == pytest.approx(11.0 / 12.0)
    assert "+250 %" in line(joint)
    assert "(missed: efficiency at least 2.52)" in line(row)
    assert not joint["passed"]
    for key in ("coverage at least 0.97", "efficiency_gain_low at least 2.2"):
        assert key in line(joint)


def test_curves_are_drawn_with_bands(tmp_path: Path) -> None:
    draw_coverage(tmp_path / "curves.png", {"uav": [run_row(1, 1.0), run_row(2, 1.5)]})
    assert (tmp_path / "curves.png").stat().st_size > 5000
