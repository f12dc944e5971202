# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the benchmark of sweeps: runs of a known time, and the tables and the page of many."""

from __future__ import annotations

import argparse
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from trident_eval.core.sweep.jobs import jobs_of
from trident_eval.core.sweep.scenario import read_scenario
from trident_eval.sweep.code_version import code_version
from trident_eval.sweep.dask_engine import DaskEngine
from trident_eval.sweep.engine import Engine
from trident_eval.sweep.local_engine import LocalEngine
from trident_eval.sweep.sweeping import Sweep

from trident_benchmarks.results import check_folder, limits_code, new_document, write_document

_WORKERS = 2
_GAINS = 10
_SUBJECT = "trident_benchmarks.sweeps.subjects:wait"
_SCENARIO = """
function: {subject}
parameters: {{sleep_s: {sleep_s}}}
axes: {{gain: {{range: [0, 1, {gains}]}}}}
seeds: {seeds}
metrics: {{score: {{unit: m, better: higher}}}}
"""
# Limits: overhead on two workers, runs that cost nothing, and the page of as many.
_OVERHEAD, _TINY_S, _REPORT_S = 0.15, 60.0, 5.0

_ENGINES: dict[str, Callable[[Path], Engine]] = {
    "local": lambda folder: LocalEngine(folder, _SUBJECT, _WORKERS),
    "dask": lambda folder: DaskEngine(folder, _SUBJECT, _WORKERS, ""),
}


class SweepRow(NamedTuple):
    """What is measured.

    Attributes:
        engine: `local` or `dask`.
        runs: of the sweep.
        sleep_s: that each run lasts [s].
    """

    engine: str
    runs: int
    sleep_s: float


ROWS = (
    SweepRow("local", 200, 0.05),
    SweepRow("dask", 200, 0.05),
    SweepRow("local", 10_000, 0.0),
    SweepRow("dask", 10_000, 0.0),
)


def measure_row(row: SweepRow, folder: Path) -> dict[str, Any]:
    """Sweep, and time it: from the first run handed out to the last row, and the report.

    Raises:
        EvalError: the engine is of no use.
    """
    file = folder / "study.yaml"
    text = _SCENARIO.format(
        subject=_SUBJECT, sleep_s=row.sleep_s, gains=_GAINS, seeds=row.runs // _GAINS
    )
    file.write_text(text, encoding="utf-8")
    scenario = read_scenario(file)
    code = code_version(_SUBJECT)
    sweep = Sweep(scenario, jobs_of(scenario, code), folder, code)
    engine = _ENGINES[row.engine](folder)
    try:
        begin = time.perf_counter()
        sweep.run(engine)
        runs_s = time.perf_counter() - begin
    finally:
        engine.close()
    begin = time.perf_counter()
    sweep.write("./trident bench sweeps")
    report_s = time.perf_counter() - begin
    return judged(row, sum(row.status == "done" for row in sweep.rows()), runs_s, report_s)


def judged(row: SweepRow, done: int, runs_s: float, report_s: float) -> dict[str, Any]:
    """A row with its figures and limits.

    Args:
        row: what was measured.
        done: runs that have ended well.
        runs_s: wall time of all runs [s].
        report_s: wall time of tables, pictures and page [s].
    """
    bare_s = row.runs * row.sleep_s / _WORKERS
    overhead = runs_s / bare_s - 1.0 if bare_s > 0.0 else None
    is_quick_enough = runs_s <= _TINY_S if overhead is None else overhead <= _OVERHEAD
    return row._asdict() | {
        "done": done,
        "runs_s": runs_s,
        "overhead": overhead,
        "report_s": report_s,
        "passed": done == row.runs and is_quick_enough and report_s <= _REPORT_S,
    }


def line(row: dict[str, Any]) -> str:
    """A row as one line."""
    overhead = "" if row["overhead"] is None else f", overhead {100.0 * row['overhead']:.1f} %"
    verdict = "" if row["passed"] else " (limit missed)"
    return (
        f"{row['engine']}: {row['done']} of {row['runs']} runs of {1e3 * row['sleep_s']:.0f} ms in"
        f" {row['runs_s']:.2f} s{overhead}; report {row['report_s']:.2f} s{verdict}"
    )


def measure(options: argparse.Namespace) -> int:
    """All rows; the exit code."""
    check_folder(options.out)
    document = new_document() | {"rows": []}
    for row in ROWS:
        runs = row.runs // 200 // _GAINS * _GAINS or _GAINS
        with tempfile.TemporaryDirectory() as folder:
            case = row._replace(runs=runs) if options.quick else row
            result = measure_row(case, Path(folder))
        print(line(result), flush=True)
        document["rows"].append(result)
        write_document(options.out, document)
    return limits_code(document)
