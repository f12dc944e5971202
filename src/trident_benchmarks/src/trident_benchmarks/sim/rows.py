# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the benchmark: the median of several runs, as JSON and as a table."""

from __future__ import annotations

import statistics
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from trident_eval.core.errors import EvalError

#: Numbers of which a row gives the median over its runs.
MEASURES = (
    "rtf",
    "cpu_s_per_sim_s",
    "rss_mb",
    "peak_rss_mb",
    "startup_s",
    "sim_s",
    "wall_s",
    "others_cpu_cores",
)
_COLUMNS = (
    ("mode", "mode"),
    ("n", "N"),
    ("rtf", "real-time factor"),
    ("cpu_s_per_sim_s", "CPU s per simulated s"),
    ("rss_mb", "RSS flying [MB]"),
    ("peak_rss_mb", "RSS peak [MB]"),
    ("startup_s", "start-up [s]"),
    ("sim_s", "simulated [s]"),
    ("runs", "runs"),
)
_FLIGHTS = ("in_process", "lockstep_nodelet", "lockstep_external")
_SIGNIFICANT_DIGITS = 3
#: The controller's steady offset is 0.04 m; a vehicle further away is not hovering.
MAX_OFFSET_M = 0.1


@dataclass(frozen=True)
class Plan:
    """One row to measure.

    Attributes:
        mode: what is measured, see docs/reference/benchmarks.md.
        n: number of vehicles.
        runs: how often.
        window_s: simulated seconds of a run's measurement.
    """

    mode: str
    n: int
    runs: int
    window_s: float


_SIZES = {
    "in_process": (1, 6, 24, 100),
    "lockstep_nodelet": (1, 6, 24),
    "lockstep_external": (1, 6, 24),
}
_LAUNCHES = ("startup", "main_job", "tutorial_full")


def plan_rows(quick: bool, modes: Sequence[str] = (), runs: int | None = None) -> list[Plan]:
    """The rows of a benchmark, in the order in which they are measured.

    Args:
        quick: only N <= 6, one run each, the shortest windows.
        modes: only these; empty: all.
        runs: another number of runs.

    Raises:
        EvalError: a mode is unknown.
    """
    unknown = sorted(set(modes) - {*_SIZES, *_LAUNCHES})
    if unknown:
        known = [*_SIZES, *_LAUNCHES]
        raise EvalError(f"mode {unknown[0]!r} is unknown; legal: {', '.join(known)}")
    count = runs or (1 if quick else 3)
    rows = [*_sized_rows(quick, modes), *_launched_rows(quick, modes)]
    return [Plan(mode, n, count, window_s(n, quick)) for mode, n in rows]


def _chosen(known: Iterable[str], modes: Sequence[str]) -> list[str]:
    return [mode for mode in known if not modes or mode in modes]


def _sized_rows(quick: bool, modes: Sequence[str]) -> list[tuple[str, int]]:
    """Mode and number of vehicles of the rows that are measured with several numbers."""
    rows = [(mode, n) for mode in _chosen(_SIZES, modes) for n in _SIZES[mode]]
    return [(mode, n) for mode, n in rows if n <= 6] if quick else rows


def _launched_rows(quick: bool, modes: Sequence[str]) -> list[tuple[str, int]]:
    """The same of launch files; in haste only of those that are named."""
    if quick and not modes:
        return []
    return [(mode, 6) for mode in _chosen(_LAUNCHES, modes)]


def window_s(n: int, quick: bool) -> float:
    """Simulated seconds of a measurement: long enough for /proc's ticks of 10 ms to be small."""
    if quick:
        return 60.0
    return 300.0 if n <= 6 else 120.0


def _median(key: str, results: Sequence[Mapping[str, Any]]) -> float | None:
    """Of a measure; None if a result is without it."""
    values = [result[key] for result in results if result.get(key) is not None]
    return statistics.median(values) if len(values) == len(results) else None


def summarize(plan: Plan, results: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """One row from the results of its runs: the median of every measure that all of them have.

    Raises:
        EvalError: there are no results.
    """
    if not results:
        raise EvalError(f"{plan.mode}, n = {plan.n}: there is no result to summarize")
    row: dict[str, Any] = {"mode": plan.mode, "n": plan.n}
    for key in MEASURES:
        row[key] = _median(key, results)
    row["rtf_all"] = [result.get("rtf") for result in results]
    row |= _repeatability(results)
    row["runs"] = len(results)
    return row | _details(results[-1])


def _repeatability(results: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """The hash of the state in which all runs have ended, and whether they have ended in one."""
    hashes = [result["state_hash"] for result in results if result.get("state_hash")]
    return {
        "state_hash": hashes[0] if len(set(hashes)) == 1 else None,
        "repeatable": len(set(hashes)) == 1 if len(hashes) > 1 else None,
    }


def _details(result: Mapping[str, Any]) -> dict[str, Any]:
    """What is not a measure, as the last run has it."""
    known = {*MEASURES, "state_hash", "n", "mode"}
    return {key: value for key, value in result.items() if key not in known}


def check_hover(result: Mapping[str, Any]) -> None:
    """A simulator that loses its vehicles is not measured.

    Raises:
        EvalError: at the end of the run a vehicle is not where it was commanded to hover.
    """
    offset_m = result.get("largest_offset_m")
    if offset_m is not None and not offset_m <= MAX_OFFSET_M:
        raise EvalError(
            f"a vehicle is {offset_m:.3f} m from its place at the end; legal: <= {MAX_OFFSET_M} m"
        )


def same_flight(rows: Iterable[Mapping[str, Any]]) -> dict[int, bool]:
    """Per N: whether the flights in-process and in lockstep end in the same state, to the bit.

    All modes fly the same vehicles for the same simulated time, so they must.
    """
    hashes: dict[int, dict[str, Any]] = {}
    for row in rows:
        if row["mode"] in _FLIGHTS and "error" not in row:
            hashes.setdefault(row["n"], {})[row["mode"]] = row["state_hash"]
    return {
        n: None not in by_mode.values() and len(set(by_mode.values())) == 1
        for n, by_mode in hashes.items()
        if len(by_mode) > 1
    }


def failed_row(plan: Plan, reason: str) -> dict[str, Any]:
    """A row that could not be measured, with the reason."""
    return {"mode": plan.mode, "n": plan.n, "error": reason}


def number_text(value: object) -> str:
    """A number with three significant digits and no exponent; "" for what is missing."""
    if value is None:
        return ""
    if not isinstance(value, float):
        return str(value)
    if value == 0.0 or abs(value) >= 10 ** (_SIGNIFICANT_DIGITS - 1):
        return f"{value:.0f}"
    text = f"{value:.{_SIGNIFICANT_DIGITS}g}"
    return f"{value:.7f}".rstrip("0") if "e" in text else text


def markdown_table(rows: Iterable[Mapping[str, Any]]) -> str:
    """The rows as a Markdown table; a row that failed says why."""
    lines = [
        "| " + " | ".join(title for _, title in _COLUMNS) + " |",
        "|" + "|".join(" --- " if key == "mode" else " ---: " for key, _ in _COLUMNS) + "|",
    ]
    for row in rows:
        cells = (cell.replace("|", "\\|") for cell in _cells(row))
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def _cells(row: Mapping[str, Any]) -> list[str]:
    if "error" not in row:
        return [number_text(row.get(key)) for key, _ in _COLUMNS]
    cells = [str(row["mode"]), str(row["n"]), f"failed: {row['error']}"]
    return cells + [""] * (len(_COLUMNS) - len(cells))


def profile_table(rows: Iterable[Mapping[str, Any]]) -> str:
    """The per-stage budgets and CPU shares of the rows that have them, as Markdown tables."""
    blocks = []
    for row in rows:
        for key, unit in (
            ("profile_us_per_step", "µs per step"),
            ("cpu_split_s_per_sim_s", "CPU s per simulated s"),
        ):
            budget = row.get(key)
            if not budget:
                continue
            blocks += ["", f"{row['mode']}, N = {row['n']} [{unit}]", ""]
            blocks.append("| " + " | ".join(budget) + " | sum |")
            blocks.append("|" + " ---: |" * (len(budget) + 1))
            values = [*budget.values(), float(sum(budget.values()))]
            blocks.append("| " + " | ".join(number_text(float(v)) for v in values) + " |")
    return "\n".join(blocks)


def caption(document: Mapping[str, Any]) -> str:
    """One line below a table: where, when and of what it was measured."""
    machine = document["machine"]
    load = machine.get("load_average") or [0.0]
    return (
        f"{machine['cores']} cores, {machine['cpu_model']}; commit {document['commit']}; "
        f"{document['started']}; load average {load[0]:.1f} before the first row; "
        f"`{document['command']}`"
    )
