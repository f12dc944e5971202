# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The command line: what it measures, writes, prints and returns."""

from __future__ import annotations

import json

import pytest
from trident_benchmarks.results import FAILED, MEASURED, UNUSABLE
from trident_benchmarks.sensors import ray_sensors
from trident_benchmarks.sim import coast
from trident_benchmarks.sim import measure as sim
from trident_eval.core.errors import EvalError

from trident_benchmarks import __main__ as bench

_RESULT = {"rtf": 50.0, "cpu_s_per_sim_s": 0.02, "state_hash": "ab", "largest_offset_m": 0.04}


@pytest.fixture
def measured(monkeypatch):
    """Answers of the measurement per mode; an exception is raised."""
    answers = dict.fromkeys(("in_process", "lockstep_nodelet", "lockstep_external"), _RESULT)

    def measure_once(plan, setup, profile):
        answer = answers[plan.mode]
        if isinstance(answer, Exception):
            raise answer
        return dict(answer)

    monkeypatch.setattr(sim, "prepare", lambda controller: None)
    monkeypatch.setattr(sim, "measure_once", measure_once)
    return answers


def test_rows_are_written_and_said(measured, tmp_path, capsys):
    out = tmp_path / "b.json"
    assert bench.main(["sim", "--quick", "--out", str(out)]) == MEASURED
    document = json.loads(out.read_text())
    assert [(row["mode"], row["n"]) for row in document["rows"]] == [
        ("in_process", 1),
        ("in_process", 6),
        ("lockstep_nodelet", 1),
        ("lockstep_nodelet", 6),
        ("lockstep_external", 1),
        ("lockstep_external", 6),
    ]
    assert document["same_flight"] == {"1": True, "6": True}
    assert document["machine"]["cores"] >= 1
    assert document["commit"]
    said = capsys.readouterr()
    assert said.out == ""
    assert "[6/6] lockstep_external n=6 run 1/1: rtf 50" in said.err


def test_the_saved_rows_give_the_printed_table(measured, tmp_path, capsys):
    out = tmp_path / "b.json"
    bench.main(["sim", "--quick", "--out", str(out), "--markdown"])
    printed = capsys.readouterr().out
    assert "| in_process | 6 | 50 | 0.02 |" in printed
    assert "N = 6: in-process and lockstep flights end in the same state" in printed
    assert bench.main(["table", str(out)]) == MEASURED
    assert capsys.readouterr().out.startswith(printed)


def test_a_row_that_fails_leaves_the_others(measured, tmp_path):
    measured["in_process"] = EvalError("sim_benchmark has ended with exit code 1\n  why")
    out = tmp_path / "b.json"
    assert bench.main(["sim", "--quick", "--out", str(out)]) == FAILED
    rows = json.loads(out.read_text())["rows"]
    assert rows[0]["error"] == "sim_benchmark has ended with exit code 1"
    assert rows[3]["rtf"] == 50.0


@pytest.mark.parametrize(
    ("words", "module", "case"),
    [(["sim", "--world", "coast"], coast, "fleet"), (["sensors"], ray_sensors, "scan360_6robots")],
)
def test_a_case_that_fails_has_a_row_that_says_why(
    words, module, case, monkeypatch, tmp_path, capsys
):
    def measure(case, runs, quick):
        raise EvalError(f"{runs} runs of {case.name}: no such world\n  why")

    monkeypatch.setattr(module, "measure", measure)
    out = tmp_path / "b.json"
    words = [*words, "--mode", case, "--out", str(out)]
    assert bench.main(words) == FAILED
    (row,) = json.loads(out.read_text())["rows"]
    assert row["error"] == f"3 runs of {case}: no such world"
    assert row["n"] >= 6
    assert f"[1/1] {case}: failed: 3 runs" in capsys.readouterr().err


def test_lost_vehicles_fail_their_row(measured, tmp_path):
    measured["lockstep_external"] = _RESULT | {"largest_offset_m": 3.0}
    out = tmp_path / "b.json"
    assert bench.main(["sim", "--quick", "--out", str(out)]) == FAILED
    assert "3.000 m from its place" in json.loads(out.read_text())["rows"][4]["error"]


@pytest.mark.parametrize(
    ("words", "error_text"),
    [
        (["sim", "--mode", "gpu"], "mode 'gpu' is unknown"),
        (["sim", "--out", "/no/such/folder/b.json"], "its folder does not exist"),
        (["table", "/no/such/file.json"], "/no/such/file.json"),
    ],
)
def test_bad_words_are_one_clear_error(measured, words, error_text, capsys):
    assert bench.main(words) == UNUSABLE
    assert error_text in capsys.readouterr().err


@pytest.mark.parametrize("text", ["{}", "[]", "not JSON"])
def test_a_file_that_is_no_benchmark_is_refused(text, tmp_path, capsys):
    source = tmp_path / "b.json"
    source.write_text(text)
    assert bench.main(["table", str(source)]) == UNUSABLE
    assert "legal: a file that --out has written" in capsys.readouterr().err


def test_runs_must_be_positive(capsys):
    with pytest.raises(SystemExit):
        bench.main(["sim", "--runs", "0"])
    assert "legal: >= 1" in capsys.readouterr().err
