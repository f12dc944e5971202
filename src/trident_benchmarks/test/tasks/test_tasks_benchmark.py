# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

import pytest
from trident_benchmarks.tasks import allocation, table
from trident_benchmarks.tasks.days import Day, a_day, judged
from trident_benchmarks.tasks.measure import line, measure
from trident_benchmarks.tasks.picture import draw_gaps
from trident_eval.core.errors import EvalError
from trident_fleet.core.tasks.plan import Objective
from trident_fleet.core.tasks.trials.instances import some_instances


def options(**changed: Any) -> argparse.Namespace:
    default = {"suite": [], "days": 1, "quick": True, "out": None, "picture": None, "refresh": None}
    return argparse.Namespace(**default | changed)


def test_the_committed_values_are_of_the_instances_that_are_measured() -> None:
    values = table.read_table()
    names = {made.name for made in some_instances(table.INSTANCES)}
    assert values
    assert {name for name, _ in values} <= names
    assert all(row["version"] and float(row["length_m"]) > 0.0 for row in values.values())


def test_a_value_that_took_too_little_time_is_made_again() -> None:
    values = {
        (made.name, "sum"): {"cpu_s": "30.0" if made.seed else "12.0"} for made in some_instances(3)
    }
    lacking = table.lacking(values, "sum")  # type: ignore[arg-type]
    assert [made.seed for made in lacking] == [0, *range(3, table.INSTANCES)]


def test_a_python_without_or_tools_and_a_table_of_something_else(tmp_path: Path) -> None:
    with pytest.raises(EvalError, match=r"--refresh /no/python: .*No such file"):
        table.refresh("/no/python", ["sum"], tmp_path / "new.csv")
    file = tmp_path / "other.csv"
    file.write_text("a,b\n1,2\n", encoding="utf-8")
    with pytest.raises(EvalError, match=r"other.csv: columns are a, b, legal: name, objective"):
        table.read_table(file)
    with pytest.raises(EvalError, match=r"suite is 'nights', legal: allocation, days"):
        measure(options(suite=["nights"]))


def test_rows_of_allocation_and_their_picture(tmp_path: Path) -> None:
    rows = allocation.against_exact(2) + allocation.against_hungarian(1)
    values = table.read_table()
    few = dict(sorted(values.items(), key=lambda item: float(item[1]["length_m"]))[:2])
    rows += allocation.against_table(few, Objective.SUM, quick=True)
    assert {row["method"] for row in rows} >= {"improved", "plain", "auction"}
    assert all(row["passed"] for row in rows)
    assert "(limit 2)" in line(rows[-1])
    picture = tmp_path / "gaps.png"
    draw_gaps(picture, rows)
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_a_short_form_of_the_days_is_measured(tmp_path: Path) -> None:
    out = tmp_path / "rows.json"
    measure(options(suite=["days"], out=out))
    (row,) = json.loads(out.read_text(encoding="utf-8"))["rows"]
    assert (row["days"], row["stuck"], row["lost"], row["broken"]) == (1, 0, 0, 0)
    assert a_day(0).messages == round(row["messages_per_task"] * 20)


@pytest.mark.parametrize(
    ("changed", "passed"),
    [
        ({}, True),
        ({"finish_s": 61.0}, False),
        ({"stuck": ("t1",)}, False),
        ({"lost": ("t1",)}, False),
        ({"broken": "t1 was done 2 times"}, False),
    ],
)
def test_days_are_judged(changed: dict[str, Any], passed: bool) -> None:
    usual = {"stuck": (), "lost": (), "reported": {}, "broken": "", "messages": 700}
    days = [Day(**{"seed": 4, "finish_s": 50.0, "lossless_s": 20.0} | usual | changed)]
    row = judged(days)
    assert row["passed"] == passed
    assert ("limit missed" in line(row)) != passed
    assert row["bad"] == [] or row["bad"][0]["seed"] == 4
