# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Fields of cylinders: their files, the metric, and the program that drives through them."""

from __future__ import annotations

import argparse
import json
import subprocess
from pathlib import Path
from typing import Any

import pytest
from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import package_folder

pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")

from trident_benchmarks.nav import barn
from trident_benchmarks.nav.fields import Field, metric, read_field, read_fields
from trident_benchmarks.nav.trials import JACKAL, Outcome, Task, Trials, default_parameters

STACKS = sorted((package_folder("trident_bringup") / "config" / "nav" / "stacks").glob("*.yaml"))
STRAIGHT = ((-2.25, 3.0), (-2.25, 13.0))  # 10 m: 5 s at full speed


def write_field(folder: Path, number: int, cylinders: list[tuple[float, float]]) -> None:
    """A world in the form of the data set."""
    rows = "".join(f"{x},{y},0.075\n" for x, y in cylinders)
    (folder / f"world_{number}.obstacles.csv").write_text("x_m,y_m,radius_m\n" + rows)
    path = "".join(f"{x},{y}\n" for x, y in STRAIGHT)
    (folder / f"world_{number}.path.csv").write_text("x_m,y_m\n" + path)


def test_worlds_come_in_the_order_of_their_numbers(tmp_path: Path) -> None:
    for number in (12, 6, 102):
        write_field(tmp_path, number, [(1.0, 2.0)])
    fields = read_fields(tmp_path)
    assert [field.number for field in fields] == [6, 12, 102]
    assert fields[0].cylinders == ((1.0, 2.0, 0.075),)
    assert fields[0].optimal_s == pytest.approx(5.0)


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("x_m,y_m\n1,2\n", r"obstacles.csv:2: legal: numbers x_m, y_m, radius_m"),
        ("x_m,y_m,radius_m\n1,2,x\n", "obstacles.csv:2"),
        ("x_m,y_m,radius_m\n1,2,nan\n", "obstacles.csv:2.*not finite"),
    ],
)
def test_a_table_that_is_none_is_named_with_its_line(tmp_path: Path, text: str, what: str) -> None:
    write_field(tmp_path, 1, [])
    (tmp_path / "world_1.obstacles.csv").write_text(text)
    with pytest.raises(EvalError, match=what):
        read_field(tmp_path, 1)


def test_a_folder_without_worlds_is_refused(tmp_path: Path) -> None:
    with pytest.raises(EvalError, match="no world_N"):
        read_fields(tmp_path)


@pytest.mark.parametrize(
    ("is_success", "time_s", "expected"),
    [(True, 4.0, 0.5), (True, 10.0, 0.5), (True, 20.0, 0.25), (True, 90.0, 0.125), (False, 4.0, 0)],
)
def test_the_metric_is_the_challenges(is_success: bool, time_s: float, expected: float) -> None:
    assert metric(Field(1, (), STRAIGHT), is_success, time_s) == pytest.approx(expected)


def test_without_data_the_suite_is_skipped_loudly(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.delenv("TRIDENT_DATA", raising=False)
    assert barn.find_fields(argparse.Namespace(worlds=None, quick=False)) == []
    assert capsys.readouterr().err.startswith("SKIPPED: TRIDENT_DATA")


def test_the_row_has_means_over_worlds_and_the_time_of_successes() -> None:
    def outcome(end: str, time_s: float) -> Outcome:
        return Outcome(1, end, time_s, "", (), (), 0.1)

    fields = [Field(1, (), STRAIGHT), Field(2, (), STRAIGHT)]
    row = barn.row_of(fields, [[outcome("reached", 5.0)], [outcome("collided", 1.0)]])
    assert (row["metric"], row["success"], row["collision"]) == (0.25, 0.5, 0.5)
    assert (row["mean_time_s"], row["runs"], row["suite"]) == (5.0, 2, "barn")
    assert "| this one | 0.250 | 0.500 | 0.500 | 5.0 s | 2 |" in barn.table([row])


def drive(field: Field, config: Path | None = None, **changes: Any) -> Outcome:
    """One run of the challenge's task in a field, with a goal of 5 m."""
    task = barn.task_of(field)
    values = {**task.__dict__, "goal": (5.0, 0.0, 0.0), "time_limit_s": 20.0, **changes}
    parameters = [*default_parameters(JACKAL), *([config] if config else [])]
    trials = Trials(JACKAL, parameters, 1)
    return trials.run([Task(**values)], [1], lambda *_: None)[0][0]


GATE = tuple((x, 5.0, 0.075) for x in (-3.9, -3.6, -3.3, -3.0, -2.4, -2.1, -1.8, -1.5, -1.2))


def test_it_drives_around_an_obstacle() -> None:
    row = tuple((-2.25 + 0.15 * i, 5.0, 0.075) for i in range(-4, 5))
    done = drive(Field(1, row, STRAIGHT))
    assert done.end == "reached", done
    assert done.time_s < 6.0
    assert max(abs(x + 2.25) for x, _, _ in done.track) > 0.7


def test_it_drives_through_a_gate_and_equal_seeds_give_equal_runs() -> None:
    first, second = (drive(Field(2, GATE, STRAIGHT)) for _ in range(2))
    assert first.end == "reached", first
    assert first.track == second.track


def test_what_it_touches_is_named(tmp_path: Path) -> None:
    blind = tmp_path / "blind.yaml"
    layer = "{obstacle_layer: {scan: {obstacle_range: 0.0}}}"
    blind.write_text(f"global_costmap: {layer}\nlocal_costmap: {layer}\n")
    done = drive(Field(3, ((-2.25, 5.0, 0.075),), STRAIGHT), blind)
    assert done.end == "collided"
    assert "cylinder_0" in done.text
    assert done.time_s < 3.0


def test_the_program_names_a_wrong_key(tmp_path: Path) -> None:
    trial = tmp_path / "trial.yaml"
    trial.write_text(json.dumps({"worlds": "x"}))
    program = Trials(JACKAL, [], 1)._program
    done = subprocess.run([program, str(trial)], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "trial.yaml" in done.stderr
    assert "world" in done.stderr


@pytest.mark.parametrize("stack", STACKS, ids=lambda file: file.stem)
def test_each_stack_of_another_controller_drives(stack: Path) -> None:
    done = drive(Field(4, (), STRAIGHT), stack, time_limit_s=30.0)
    assert done.end == "reached", done
