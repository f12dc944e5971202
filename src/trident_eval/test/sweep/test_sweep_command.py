# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The command as a process: it is interrupted and killed, and continues."""

from __future__ import annotations

import contextlib
import csv
import json
import os
import random
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import pyarrow.parquet as pq
import pytest

HERE = Path(__file__).parent
SCENARIO = """
function: subjects:score
parameters: {sleep_s: SLEEP}
axes:
  gain: {range: [0, 1, 3]}
  mode: {list: [joint, alone]}
seeds: SEEDS
limits: {time_s: 60}
metrics:
  score: {unit: m, better: higher}
comparisons:
  - {parameter: mode, first: joint, second: alone, metric: score}
"""
TIMES = {"started", "elapsed_s", "cpu_s", "memory_mb", "worker"}


def write_scenario(folder: Path, sleep_s: float = 0.0, seeds: int = 4) -> Path:
    path = folder / "study.yaml"
    path.write_text(SCENARIO.replace("SLEEP", str(sleep_s)).replace("SEEDS", str(seeds)))
    return path


def start(scenario: Path, *words: str) -> subprocess.Popen[str]:
    path = os.pathsep.join([str(HERE), *filter(None, sys.path)])
    command = [sys.executable, "-m", "trident_eval.sweep", str(scenario), "--workers", "2", *words]
    return subprocess.Popen(
        command,
        cwd=scenario.parent,
        env={**os.environ, "PYTHONPATH": path},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def sweep(scenario: Path, *words: str, code: int = 0) -> str:
    """Runs the command to its end; returns what it says on stderr."""
    process = start(scenario, *words)
    _, errors = process.communicate(timeout=300)
    assert process.returncode == code, errors
    return errors


def table(folder: Path) -> list[dict[str, str]]:
    """runs.csv but for times."""
    with (folder / "runs.csv").open(newline="") as stream:
        return [
            {name: value for name, value in row.items() if name not in TIMES}
            for row in csv.DictReader(stream)
        ]


def wait_for_rows(folder: Path, count: int) -> None:
    """Until so many rows are there."""
    while len(list((folder / "rows").glob("*/*.json"))) < count:
        time.sleep(0.005)


def test_a_sweep_leaves_tables_a_summary_and_a_page(tmp_path: Path) -> None:
    sweep(write_scenario(tmp_path))
    folder = tmp_path / "study_sweep"
    rows = table(folder)
    assert len(rows) == 24
    assert rows[0]["parameter.mode"] == "joint"
    assert float(rows[0]["metric.score"]) == pytest.approx(1.01)
    parquet = pq.read_table(folder / "runs.parquet")
    assert parquet.column("metric.score").to_pylist() == [float(r["metric.score"]) for r in rows]
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["runs"] == {
        "wanted": 24, "counted": 24, "failed": 0, "points_that_had_enough": 0,
    }  # fmt: skip
    assert summary["comparisons"][0]["mean"] == pytest.approx(1.0)
    page = (folder / "report.html").read_text()
    assert page.count("<img") == 3  # intervals, curve along gain, differences
    assert "--only" in page


def test_the_same_command_makes_no_run_twice(tmp_path: Path) -> None:
    scenario = write_scenario(tmp_path)
    sweep(scenario)
    before = table(tmp_path / "study_sweep")
    assert "24 of 24 runs are there already" in sweep(scenario)
    assert table(tmp_path / "study_sweep") == before
    assert len((tmp_path / "study_sweep/calls.txt").read_text().splitlines()) == 24


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGINT])
def test_what_was_done_stays_when_the_command_is_ended(tmp_path: Path, number: int) -> None:
    undisturbed = tmp_path / "undisturbed"
    undisturbed.mkdir()
    sweep(write_scenario(undisturbed, seeds=8))
    scenario = write_scenario(tmp_path, sleep_s=0.02, seeds=8)
    folder = tmp_path / "study_sweep"
    chance = random.Random(number)
    for more in chance.sample(range(1, 12), 3):
        process = start(scenario)
        count = len(table_of_rows(folder)) + more
        wait_for_rows(folder, count)
        process.send_signal(number)
        process.communicate(timeout=60)
        if number == signal.SIGINT:
            assert process.returncode == 130
            assert len(table(folder)) >= count
    sweep(scenario)
    ended = table(folder)
    assert [{**row, "key": "", "parameter.sleep_s": ""} for row in ended] == [
        {**row, "key": "", "parameter.sleep_s": ""} for row in table(undisturbed / "study_sweep")
    ]
    # A run that was at work, or wrote its row, may have begun twice; one that has a row has not.
    calls = Counter((folder / "calls.txt").read_text().splitlines())
    assert len(calls) == 48
    assert sum(calls.values()) <= 48 + 3 * 4


def test_workers_and_fork_servers_that_are_killed_cost_no_run(tmp_path: Path) -> None:
    scenario = write_scenario(tmp_path, sleep_s=0.02, seeds=6)
    folder = tmp_path / "study_sweep"
    process = start(scenario)
    for count in (3, 12, 20):
        wait_for_rows(folder, count)
        for child in descendants(process.pid):
            with_row = len(table_of_rows(folder))
            assert with_row >= count
            kill(child)
    _, errors = process.communicate(timeout=120)
    assert process.returncode == 0, errors
    rows = table(folder)
    assert len(rows) == 36
    assert {row["status"] for row in rows} == {"done"}


def table_of_rows(folder: Path) -> list[Path]:
    return list((folder / "rows").glob("*/*.json"))


def descendants(pid: int) -> list[int]:
    """Children and their children."""
    found = []
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        try:
            children = [int(word) for word in task.read_text().split()]
        except OSError:
            continue
        for child in children:
            found += [child, *descendants(child)]
    return found


def kill(pid: int) -> None:
    with contextlib.suppress(ProcessLookupError):
        os.kill(pid, signal.SIGKILL)


def test_changed_code_is_a_new_sweep_and_says_so(tmp_path: Path) -> None:
    module = tmp_path / "mine.py"
    text = "def run(parameters, seed, folder):\n    return {'score': VALUE}\n"
    module.write_text(text.replace("VALUE", "1.0"))
    scenario = tmp_path / "mine.yaml"
    scenario.write_text("function: mine:run\nseeds: 2\nmetrics: {score: {}}\n")
    sweep(scenario)
    module.write_text(text.replace("VALUE", "2.0"))
    assert "the code has changed" in sweep(scenario)
    assert [row["metric.score"] for row in table(tmp_path / "mine_sweep")] == ["2.0", "2.0"]
    assert len(table_of_rows(tmp_path / "mine_sweep")) == 4


def test_enough_is_enough(tmp_path: Path) -> None:
    scenario = write_scenario(tmp_path, seeds=40)
    text = scenario.read_text() + "enough: {metric: score, half_width: 0.02, least: 3}\n"
    scenario.write_text(text)
    sweep(scenario)
    summary = json.loads((tmp_path / "study_sweep/summary.json").read_text())
    assert summary["runs"]["points_that_had_enough"] == 6
    assert summary["runs"]["counted"] == 6 * 4
    assert len(table_of_rows(tmp_path / "study_sweep")) < 240


def test_one_run_is_repeated(tmp_path: Path) -> None:
    scenario = write_scenario(tmp_path)
    sweep(scenario)
    key = table(tmp_path / "study_sweep")[3]["key"]
    process = start(scenario, "--only", key[:12])
    output, _ = process.communicate(timeout=60)
    assert "seed 4" in output
    assert len((tmp_path / "study_sweep/calls.txt").read_text().splitlines()) == 25


def test_a_plan_makes_no_run(tmp_path: Path) -> None:
    process = start(write_scenario(tmp_path), "--plan")
    output, _ = process.communicate(timeout=60)
    assert "6 points x 4 seeds = 24 runs" in output
    assert not (tmp_path / "study_sweep").exists()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("function: nowhere:run\nmetrics: {x: {}}\n", "no module nowhere"),
        ("function: subjects:nothing\nmetrics: {x: {}}\n", "has no function nothing"),
        ("metrics: [\n", "study.yaml:"),
    ],
)
def test_what_cannot_be_swept_is_one_message(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "study.yaml"
    path.write_text(text)
    errors = sweep(path, code=2)
    assert message in errors
    assert errors.count("\n") == 1


def test_runs_that_fail_are_rows_and_the_exit_code_says_so(tmp_path: Path) -> None:
    path = tmp_path / "study.yaml"
    path.write_text(
        "function: subjects:odd\naxes: {how: {list: [write, raise, crash]}}\n"
        "metrics: {score: {unit: m}}\n"
    )
    assert "2 of 3 runs have failed" in sweep(path, code=1)
    rows = table(tmp_path / "study_sweep")
    assert [row["status"] for row in rows] == ["done", "failed", "failed"]
    assert "2 of 3 runs have failed" in (tmp_path / "study_sweep/report.html").read_text()


def test_two_sweeps_in_one_folder_are_refused(tmp_path: Path) -> None:
    scenario = write_scenario(tmp_path, sleep_s=0.2)
    first = start(scenario)
    wait_for_rows(tmp_path / "study_sweep", 1)
    assert "another sweep is at work in it" in sweep(scenario, code=2)
    first.send_signal(signal.SIGINT)
    first.communicate(timeout=60)
