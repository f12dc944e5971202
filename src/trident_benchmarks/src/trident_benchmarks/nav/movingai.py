# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The suite movingai: shortest paths on public grid maps, next to a plain A* in the same run.

Sturtevant, "Benchmarks for Grid-Based Pathfinding" (2012): a scenario file gives the optimal length
of each query, without diagonal steps between blocked cells. Reading a map is not part of a query:
what it takes is reported apart, so that few queries (``--quick``) are judged as many are.
"""

from __future__ import annotations

import argparse
import os
import statistics
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from trident_benchmarks.nav.programs import rows_of
from trident_benchmarks.results import say

DATA = "TRIDENT_DATA"
_PROGRAM = "nav_movingai_bench"
_QUICK_STRIDE = 20
MAX_LENGTH_ERROR = 1e-5  #: relative, to the lengths of the scenario files
MIN_MEAN_SPEED_UP, MIN_SPEED_UP = 6.0, 1.5  #: geometric mean of the maps, and of each map


def find_maps(options: argparse.Namespace) -> list[Path]:
    """The maps of a folder that have a scenario file; none where there are no data."""
    folder = options.worlds or Path(os.environ.get(DATA, "")) / "movingai"
    maps = sorted(folder.glob("*.map")) if folder.is_dir() else []
    found = [file for file in maps if file.with_name(f"{file.name}.scen").is_file()]
    if not found:
        say(f"SKIPPED: {folder} has no .map file with its .map.scen ({DATA} or --worlds)")
    return found


def table(rows: Sequence[dict[str, Any]]) -> str:
    """Rows as Markdown."""
    lines = [
        "| map | read once | queries | jump points | plain A* | speed-up | length error |"
        " Theta* / octile |",
        "|---|---|---|---|---|---|---|---|",
    ]
    lines += [
        f"| {row['map']} | {row['read_ms']:.2f} ms | {row['queries']} | {row['mean_ms']:.3f} ms |"
        f" {row['plain_a_star_ms']:.3f} ms | {row['speed_up']:.2f} |"
        f" {row['worst_length_error']:.1e} | {row['theta_star_ratio']:.4f} |"
        for row in rows
    ]
    return "\n".join(lines)


def summary(rows: Sequence[dict[str, Any]]) -> str:
    """The geometric mean of the speed-ups, and which limits are not kept."""
    mean = statistics.geometric_mean(row["speed_up"] for row in rows)
    misses = [
        f"{row['map']}: {text}"
        for row in rows
        for text, is_missed in (
            (f"{row['failures']} queries without a path", row["failures"] > 0),
            ("lengths differ", row["worst_length_error"] > MAX_LENGTH_ERROR),
            (f"speed-up below {MIN_SPEED_UP:g}", row["speed_up"] < MIN_SPEED_UP),
            ("Theta* is longer than octile", row["theta_star_worst_ratio"] > 1 + MAX_LENGTH_ERROR),
        )
        if is_missed
    ]
    if mean < MIN_MEAN_SPEED_UP:
        misses.append(f"the mean is below {MIN_MEAN_SPEED_UP:g}")
    verdict = "; ".join(misses) or "all limits kept"
    return f"geometric mean of the speed-ups: {mean:.2f}; {verdict}"


def measure(options: argparse.Namespace) -> list[dict[str, Any]]:
    """Answers all queries (``--quick``: every twentieth) and prints the table.

    Returns:
        A row per map; none where there are no data.

    Raises:
        EvalError: a map cannot be read.
    """
    stride = [str(_QUICK_STRIDE)] if options.quick else []
    rows = [
        {"suite": "movingai", "map": file.stem, **row, "unit": "times: ms per query"}
        for file in find_maps(options)
        for row in rows_of(_PROGRAM, [str(file), *stride])
    ]
    if rows:
        print(table(rows))
        print(summary(rows))
    return rows
