# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The suite speed: CPU time of costmaps, planners and controllers, each next to its rival's."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import Any

from trident_benchmarks.nav.programs import rows_of

_QUICK_QUERIES = 20

#: Published or measured on a machine of this size: what a case takes elsewhere [ms].
RIVALS = {
    "6x6 m window, 360 beams": ("costmap_2d", 1.3),
    "4000x4000 all again": ("costmap_2d", 385.0),
    "navfn, office 4000x4000: first plan to a goal": ("navfn, its A*, another map", 109.0),
    "dwa 20x40": ("dwa_local_planner", 8.4),
    "mppi 2000x56": ("Nav2", 10.0),
}


def _row(part: str, name: str, median: float, mean: float, p99: float) -> dict[str, Any]:
    rival, rival_ms = RIVALS.get(name, (None, None))
    return {
        "suite": "speed",
        "part": part,
        "name": name,
        "median_ms": median,
        "mean_ms": mean,
        "p99_ms": p99,
        "rival": rival,
        "rival_ms": rival_ms,
        "unit": "ms of CPU time",
    }


def cpu_rows(part: str, program: str, words: Sequence[str] = ()) -> list[dict[str, Any]]:
    """Rows of a program that times cases.

    Raises:
        EvalError: it failed.
    """
    return [
        _row(part, row["name"], row["median_cpu_ms"], row["mean_cpu_ms"], row["p99_cpu_ms"])
        for row in rows_of(program, words)
    ]


def planner_rows(map_name: str, size: int, queries: int) -> list[dict[str, Any]]:
    """Rows of all planners on a map of so many cells a side, between random poses.

    Raises:
        EvalError: the program failed.
    """
    words = ["--map", map_name, "--size", str(size), "--queries", str(queries)]
    rows = []
    for row in rows_of("nav_planning_bench", words):
        name = f"{row['planner']}, {map_name} {size}x{size}"
        made = _row("planner", name, row["median_ms"], row["mean_ms"], row["p99_ms"])
        made |= {key: row[key] for key in ("paths", "failures", "poses_in_contact", "longest_ms")}
        rows.append(made)
    return rows


def table(rows: Sequence[dict[str, Any]]) -> str:
    """Rows as Markdown."""
    lines = ["| case | median | mean | 99 % | rival |", "|---|---|---|---|---|"]
    for row in rows:
        rival = "-" if row["rival"] is None else f"{row['rival_ms']:g} ms ({row['rival']})"
        lines.append(
            f"| {row['name']} | {row['median_ms']:.3f} ms | {row['mean_ms']:.3f} ms |"
            f" {row['p99_ms']:.3f} ms | {rival} |"
        )
    return "\n".join(lines)


def measure(options: argparse.Namespace) -> list[dict[str, Any]]:
    """Times all cases and prints the table.

    Returns:
        A row per case.

    Raises:
        EvalError: a program failed.
    """
    queries = _QUICK_QUERIES if options.quick else 200
    rows = cpu_rows("costmap", "trident_nav_costmap_bench")
    rows += cpu_rows("controller", "control_bench")
    rows += planner_rows("office", 632, queries)
    rows += cpu_rows("planner", "nav_replan_bench", ["--queries", str(queries // 10)])
    print(table(rows))
    return rows
