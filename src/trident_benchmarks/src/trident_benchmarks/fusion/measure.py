# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the filter of a team, and writes, prints and draws what came out."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence

from trident_benchmarks.fusion.benchmark import SUITES
from trident_benchmarks.fusion.picture import draw
from trident_benchmarks.fusion.program import runs
from trident_benchmarks.fusion.rows import (
    Row,
    Run,
    consistency_rows,
    delays_row,
    lies_row,
    line,
    outage_row,
    outliers_row,
    sharing_row,
    speed_rows,
)
from trident_benchmarks.results import (
    check_folder,
    limits_code,
    new_document,
    say,
    write_document,
)

#: Seeds of each suite, and what makes rows of its runs.
_MAKERS: dict[str, tuple[int, Callable[[Sequence[Run]], list[Row]]]] = {
    "consistency": (50, consistency_rows),
    "outliers": (50, lambda found: [outliers_row(found)]),
    "outage": (50, lambda found: [outage_row(found)]),
    "delays": (10, lambda found: [delays_row(found)]),
    "sharing": (50, lambda found: [sharing_row(found)]),
    "lies": (20, lambda found: [lies_row(found)]),
    "speed": (1, speed_rows),
}
_QUICK = 5  # by which seeds are divided


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
        draw(options.picture, runs("picture", 1))
        say(f"{options.picture}: tracks with ellipses of two standard deviations")
    return limits_code(document)


def _rows(suite: str, is_quick: bool) -> list[Row]:
    seeds, rows_of = _MAKERS[suite]
    return rows_of(runs(suite, max(1, seeds // _QUICK) if is_quick else seeds))
