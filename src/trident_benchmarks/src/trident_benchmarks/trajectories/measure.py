# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the trial program of trajectories, and writes, prints and draws what came out."""

from __future__ import annotations

import argparse
from typing import Any

from trident_benchmarks.results import (
    check_folder,
    limits_code,
    new_document,
    say,
    write_document,
)
from trident_benchmarks.trajectories.benchmark import SUITES
from trident_benchmarks.trajectories.picture import draw
from trident_benchmarks.trajectories.program import trials
from trident_benchmarks.trajectories.rows import (
    infeasible_row,
    line,
    optimum_row,
    random_row,
    speed_rows,
)

_RUNS, _STARTS, _RANDOM, _INFEASIBLE = 21, 100, 1000, 200
_QUICK = 20  # by which counts are divided


def _rows(suite: str, is_quick: bool) -> list[dict[str, Any]]:
    """What a suite gives.

    Raises:
        EvalError: the program is not built, or failed.
    """
    share = _QUICK if is_quick else 1
    if suite == "speed":
        return speed_rows(trials("speed", 3 if is_quick else _RUNS))
    if suite == "optimum":
        return [optimum_row(trials("optimum", _STARTS // share))]
    if suite == "random":
        return [random_row(trials("random", 0, _RANDOM // share))]
    return [infeasible_row(trials("infeasible", 0, _INFEASIBLE // share))]


def measure(options: argparse.Namespace) -> int:
    """All rows; the exit code."""
    for file in (options.out, options.picture):
        check_folder(file)
    document = new_document() | {"rows": []}
    for suite in options.suite or SUITES:
        for row in _rows(suite, options.quick):
            print(line(row), flush=True)
            document["rows"].append(row)
        write_document(options.out, document)
    if options.picture:
        draw(options.picture, trials("picture"))
        say(f"{options.picture}: a swap and a rendezvous in space and time")
    return limits_code(document)
