# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the SLAM benchmarks: measured, written, printed."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

from trident_eval.options import DEFAULT_METHOD

from trident_benchmarks.machine import describe_commit, describe_machine
from trident_benchmarks.results import MEASURED, say
from trident_benchmarks.slam import live, public_logs, robustness, simulated

MISSED = 1


def measure(options: argparse.Namespace) -> int:
    """What was asked for; the exit code."""
    if options.live:
        return _bench_live(options)
    if options.world:
        return _bench_world(options)
    folder = options.data or public_logs.data_folder()
    if folder is None:
        print(f"SKIPPED: {public_logs.DATA} does not point to the public logs", file=sys.stderr)
        return MEASURED
    if options.robustness:
        return _bench_robustness(folder, options)
    return _bench_public_logs(folder, options)


def _bench_public_logs(folder: Path, options: argparse.Namespace) -> int:
    runs = options.runs or (1 if options.quick else 5)
    rows = []
    for one in public_logs.plan(folder, options.method, runs, options.quick):
        is_meant = bool(options.method) or one.method == DEFAULT_METHOD
        config = options.config if is_meant else None  # not of the others that come along
        rows.append(public_logs.measure(one, config, say, options.pictures))
    print(public_logs.table(rows))
    _write_rows(options.out, rows)
    return MEASURED


def _bench_world(options: argparse.Namespace) -> int:
    seeds = range(options.seeds or (2 if options.quick else 20))
    rows = simulated.measure_all(options.world, seeds, options.keep, say)
    print(simulated.table(rows))
    missed = simulated.reasons(rows)
    print("\n".join(missed) if missed else "all limits are kept")
    if options.out:
        options.out.write_text(simulated.as_json(rows, _about()), encoding="utf-8")
    return MISSED if missed else MEASURED


def _bench_robustness(folder: Path, options: argparse.Namespace) -> int:
    rows = robustness.measure(folder, options.quick, options.config, say)
    print(robustness.table(rows))
    missed = robustness.reasons(rows)
    print("\n".join(missed) if missed else "all limits are kept")
    _write_rows(options.out, rows)
    return MISSED if missed else MEASURED


def _bench_live(options: argparse.Namespace) -> int:
    plan = live.Plan(seconds=20.0, with_hour=False) if options.quick else live.Plan()
    row = live.measure(plan, say)
    print(live.table(row))
    _write_rows(options.out, [row])
    return MEASURED if live.is_satisfied(row) else MISSED


def _write_rows(out: Path | None, rows: list[dict[str, Any]]) -> None:
    if out:
        out.write_text(json.dumps(_about() | {"rows": rows}, indent=2) + "\n", encoding="utf-8")


def _about() -> dict[str, object]:
    return {"machine": describe_machine(), "commit": describe_commit(Path(__file__).parent)}
