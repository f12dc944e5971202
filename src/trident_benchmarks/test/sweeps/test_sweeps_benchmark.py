# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import json
from pathlib import Path

import pytest
from trident_benchmarks.sweeps.measure import ROWS, SweepRow, judged, line, measure


def test_a_short_form_of_all_rows_is_measured(tmp_path: Path) -> None:
    out = tmp_path / "rows.json"
    measure(argparse.Namespace(quick=True, out=out))
    rows = json.loads(out.read_text(encoding="utf-8"))["rows"]
    assert [row["engine"] for row in rows] == [row.engine for row in ROWS]
    assert all(row["done"] == row["runs"] for row in rows)


@pytest.mark.parametrize(
    ("row", "done", "runs_s", "report_s", "passed"),
    [
        (SweepRow("local", 200, 0.05), 200, 5.7, 1.0, True),
        (SweepRow("local", 200, 0.05), 200, 5.8, 1.0, False),  # 16 % more than the bare runs
        (SweepRow("local", 200, 0.05), 199, 5.0, 1.0, False),
        (SweepRow("dask", 10_000, 0.0), 10_000, 59.0, 5.1, False),
        (SweepRow("dask", 10_000, 0.0), 10_000, 61.0, 1.0, False),
    ],
)
def test_rows_are_judged(
    row: SweepRow, done: int, runs_s: float, report_s: float, passed: bool
) -> None:
    result = judged(row, done, runs_s, report_s)
    assert result["passed"] == passed
    assert ("limit missed" in line(result)) != passed
