# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Plans, medians and tables."""

from __future__ import annotations

import pytest
from trident_benchmarks.sim.rows import (
    Plan,
    caption,
    check_hover,
    failed_row,
    markdown_table,
    number_text,
    plan_rows,
    profile_table,
    same_flight,
    summarize,
)
from trident_eval.core.errors import EvalError

_PLAN = Plan("lockstep_external", 6, 3, 60.0)


def _result(rtf, **more):
    return {"rtf": rtf, "cpu_s_per_sim_s": 1.0 / rtf, "state_hash": "ab", **more}


def test_the_full_benchmark_has_every_row_of_the_issue_three_times():
    plans = plan_rows(quick=False)
    sizes = {mode: [p.n for p in plans if p.mode == mode] for mode in {p.mode for p in plans}}
    assert sizes == {
        "in_process": [1, 6, 24, 100],
        "lockstep_nodelet": [1, 6, 24],
        "lockstep_external": [1, 6, 24],
        "startup": [6],
        "main_job": [6],
        "tutorial_full": [6],
    }
    assert {p.runs for p in plans} == {3}
    assert all(p.window_s >= 60.0 for p in plans)


def test_quick_is_small_but_measures_a_minute():
    plans = plan_rows(quick=True)
    assert {(p.mode, p.n) for p in plans} == {
        (mode, n)
        for mode in ("in_process", "lockstep_nodelet", "lockstep_external")
        for n in (1, 6)
    }
    assert all(p.runs == 1 and p.window_s == 60.0 for p in plans)


def test_equal_sizes_have_equal_windows_so_that_hashes_can_be_compared():
    for quick in (False, True):
        plans = plan_rows(quick)
        windows = {(p.mode, p.n): p.window_s for p in plans}
        for (mode, n), window in windows.items():
            if mode.startswith("lockstep"):
                assert windows["in_process", n] == window


def test_modes_and_runs_can_be_chosen():
    plans = plan_rows(quick=True, modes=["main_job"], runs=5)
    assert [(p.mode, p.runs) for p in plans] == [("main_job", 5)]


def test_an_unknown_mode_is_named_with_the_legal_ones():
    with pytest.raises(EvalError, match=r"'gpu' is unknown; legal: in_process, lockstep_nodelet"):
        plan_rows(quick=False, modes=["gpu"])


def test_a_row_is_the_median_and_keeps_every_factor():
    row = summarize(_PLAN, [_result(60.0), _result(10.0), _result(70.0, lowest_z_m=1.0)])
    assert row["rtf"] == 60.0
    assert row["rtf_all"] == [60.0, 10.0, 70.0]
    assert row["cpu_s_per_sim_s"] == pytest.approx(1 / 60)
    assert (row["mode"], row["n"], row["runs"]) == ("lockstep_external", 6, 3)
    assert row["lowest_z_m"] == 1.0
    assert row["startup_s"] is None


def test_a_measure_that_one_run_lacks_has_no_median():
    row = summarize(_PLAN, [_result(60.0, rss_mb=40.0), _result(61.0)])
    assert row["rss_mb"] is None


@pytest.mark.parametrize(
    ("hashes", "state_hash", "repeatable"),
    [
        (["ab", "ab"], "ab", True),
        (["ab", "cd"], None, False),
        (["ab"], "ab", None),
        ([None, None], None, None),
    ],
)
def test_runs_that_differ_are_reported(hashes, state_hash, repeatable):
    row = summarize(_PLAN, [_result(1.0) | {"state_hash": text} for text in hashes])
    assert row["state_hash"] == state_hash
    assert row["repeatable"] is repeatable


def test_nothing_cannot_be_summarized():
    with pytest.raises(EvalError, match="no result"):
        summarize(_PLAN, [])


@pytest.mark.parametrize("offset_m", [0.2, float("nan")])
def test_a_lost_vehicle_is_no_measurement(offset_m):
    with pytest.raises(EvalError, match=r"legal: <= 0\.1 m"):
        check_hover({"largest_offset_m": offset_m})


def test_a_hovering_vehicle_is_one():
    check_hover({"largest_offset_m": 0.04})
    check_hover({"rtf": 1.0})


def test_flights_are_compared_per_size():
    rows = [
        {"mode": "in_process", "n": 1, "state_hash": "a"},
        {"mode": "in_process", "n": 6, "state_hash": "b"},
        {"mode": "in_process", "n": 24, "state_hash": None},
        {"mode": "in_process", "n": 100, "state_hash": "d"},
        {"mode": "lockstep_nodelet", "n": 1, "state_hash": "a"},
        {"mode": "lockstep_nodelet", "n": 24, "state_hash": "c"},
        {"mode": "lockstep_nodelet", "n": 40, "state_hash": "e"},
        {"mode": "lockstep_external", "n": 1, "state_hash": "a"},
        {"mode": "lockstep_external", "n": 6, "state_hash": "x"},
        {"mode": "lockstep_external", "n": 40, "state_hash": "f"},
        {"mode": "lockstep_external", "n": 24, "state_hash": None},
        {"mode": "main_job", "n": 1, "state_hash": "z"},
    ]
    assert same_flight(rows) == {1: True, 6: False, 24: False, 40: False}


def test_a_row_that_failed_is_not_compared():
    rows = [
        {"mode": "in_process", "n": 1, "state_hash": "a"},
        failed_row(Plan("lockstep_external", 1, 1, 60.0), "roscore is missing"),
    ]
    assert same_flight(rows) == {}


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (None, ""),
        (6, "6"),
        ("in_process", "in_process"),
        (1949.53, "1950"),
        (82.149, "82.1"),
        (0.0317, "0.0317"),
        (0.0000529, "0.0000529"),
        (0.0, "0"),
    ],
)
def test_numbers_are_short(value, text):
    assert number_text(value) == text


def test_the_table_has_a_line_per_row_and_as_many_cells_as_titles():
    rows = [summarize(_PLAN, [_result(61.23)]), failed_row(_PLAN, "no | master")]
    lines = markdown_table(rows).splitlines()
    assert len(lines) == 4
    assert "| lockstep_external | 6 | 61.2 | 0.0163 |" in lines[2]
    assert "failed: no \\| master" in lines[3]
    assert len({line.replace("\\|", "").count("|") for line in lines}) == 1


def test_budgets_have_their_sum():
    row = {"mode": "in_process", "n": 6, "profile_us_per_step": {"sense": 1.0, "physics": 2.5}}
    assert "| 1 | 2.5 | 3.5 |" in profile_table([row, {"mode": "main_job", "n": 6}])


def test_the_caption_says_where_and_how():
    text = caption(
        {
            "machine": {"cores": 2, "cpu_model": "Some CPU", "load_average": [0.25, 0, 0]},
            "commit": "abc",
            "started": "2026-01-01",
            "command": "./trident bench sim",
        }
    )
    assert text == (
        "2 cores, Some CPU; commit abc; 2026-01-01; load average 0.2 before the first row; "
        "`./trident bench sim`"
    )
