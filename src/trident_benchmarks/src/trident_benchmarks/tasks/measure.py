# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Both suites of the benchmark of tasks, their lines and their picture."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import Any

from trident_eval.core.errors import EvalError

from trident_benchmarks.results import (
    check_folder,
    limits_code,
    new_document,
    say,
    write_document,
)
from trident_benchmarks.tasks import allocation, days
from trident_benchmarks.tasks.table import FILE, read_table, refresh

SUITES = ("allocation", "days")


def line(row: dict[str, Any]) -> str:
    """A row as one line, with its limits."""
    verdict = "" if row["passed"] else " (limit missed)"
    head = f"{row['row']}, {row['method']}: "
    if row["suite"] == "days":
        return head + _days_line(row) + verdict
    if "cpu_s" in row:
        return head + (
            f"{row['cpu_s']:.2f} s of CPU (limit {allocation.LARGE_CPU_S}), "
            f"{row['messages_per_task']:.1f} messages a task (limit {allocation.MESSAGES:.0f})"
            f"{verdict}"
        )
    return head + _gaps_line(row) + verdict


def _gaps_line(row: dict[str, Any]) -> str:
    figures = [
        f"{name} {100.0 * row[name]:+.2f} %" + _limit(row["limits"].get(name))
        for name in ("mean", "worst")
    ]
    if "messages_per_task" in row:
        figures.append(f"at most {row['messages_per_task']:.0f} messages a task")
    of = f" of {row['of_instances']}" if row.get("of_instances", 0) > row["instances"] else ""
    return f"{', '.join(figures)} ({row['instances']}{of} instances)"


def _limit(limit: float | None) -> str:
    return "" if limit is None else f" (limit {100.0 * limit:g})"


def _days_line(row: dict[str, Any]) -> str:
    return (
        f"{row['days']} days: {row['stuck']} stuck, {row['lost']} with a task lost, "
        f"{row['broken']} with an invariant broken (limits 0); finish over that without losses: "
        f"mean {row['ratio_mean']:.2f}, 95 % {row['ratio_p95']:.2f}, worst {row['ratio']:.2f} "
        f"(limit {days.RATIO:g}); {row['messages_per_task']:.0f} messages a task; "
        f"{row['reported']} tasks reported as not done"
    )


def measure(options: argparse.Namespace) -> int:
    """All rows; the exit code.

    Raises:
        EvalError: an option is not legal.
    """
    chosen = _chosen_suites(options.suite)
    check_folder(options.out)
    check_folder(options.picture)
    if options.refresh:
        refresh(options.refresh, ("sum", "makespan"))
    document = new_document() | {"rows": []}
    if "allocation" in chosen:
        _measure_allocation(document, options)
    if "days" in chosen:
        count = min(options.days, 12) if options.quick else options.days
        _keep([days.judged(list(days.days(count)))], document, options)
    if options.picture:
        from trident_benchmarks.tasks.picture import draw_gaps

        draw_gaps(options.picture, document["rows"])
    return limits_code(document)


def _chosen_suites(names: Sequence[str]) -> Sequence[str]:
    """Those of the names; all without names."""
    for name in names:
        if name not in SUITES:
            raise EvalError(f"suite is {name!r}, legal: {', '.join(SUITES)}")
    return names or SUITES


def _measure_allocation(document: dict[str, Any], options: argparse.Namespace) -> None:
    table = read_table()
    if not table:
        say(f"{FILE} is not there: no row against OR-tools; --refresh makes it")
    for suite in allocation.suites(table, options.quick):
        _keep(suite(), document, options)


def _keep(
    rows: list[dict[str, Any]], document: dict[str, Any], options: argparse.Namespace
) -> None:
    for row in rows:
        print(line(row), flush=True)
    document["rows"] += rows
    write_document(options.out, document)
