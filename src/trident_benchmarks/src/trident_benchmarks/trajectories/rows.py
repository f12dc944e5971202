# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the benchmark of trajectories: what a trial has printed, judged by limits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

#: CPU time of one plan on one core, all of its starts included [ms], by case and method.
SPEED_LIMITS_MS = {
    ("swap of 6", "auglag"): 30.0,
    ("swap of 12", "auglag"): 100.0,
    ("swap of 30", "auglag"): 1000.0,
    ("rendezvous of three", "auglag"): 15.0,
    ("landing on a moving boat", "auglag"): 15.0,
    ("receding step, 8 robots, 50 obstacles", "auglag"): 10.0,
    ("swap of 6", "mma"): 150.0,
}
EXCESS_LIMIT = 1e-4  # relative violation at samples of 1 kHz
OPTIMUM_LIMIT = 0.02  # of the jerk, above the best of random starts
SOLVED_LIMIT = 0.99  # of the problems that the planner by priorities has solved


def speed_rows(trials: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """A row for each timed case: passed where it is fast enough and keeps its limits."""
    rows = []
    for trial in trials:
        limit = SPEED_LIMITS_MS[trial["case"], trial["method"]]
        passed = (
            trial["is_feasible"] and trial["cpu_ms"] <= limit and trial["excess"] <= EXCESS_LIMIT
        )
        rows.append({"suite": "speed", **trial, "limit_ms": limit, "passed": passed})
    return rows


def optimum_row(trials: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """The default's jerk next to the best of random starts."""
    feasible = [trial["jerk"] for trial in trials if trial["is_feasible"]]
    own = trials[0]["default_jerk"]
    best = min(feasible, default=own)
    return {
        "suite": "optimum",
        "starts": len(trials),
        "feasible_starts": len(feasible),
        "jerk": own,
        "best_jerk": best,
        "gap": own / best - 1.0,
        "limit": OPTIMUM_LIMIT,
        "passed": bool(feasible) and own / best - 1.0 <= OPTIMUM_LIMIT,
    }


def _those(trials: Sequence[dict[str, Any]], key: str) -> list[dict[str, Any]]:
    """The trials of which something is true."""
    return [trial for trial in trials if trial[key]]


def random_row(trials: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """How many of the random problems are solved, and by how much plans miss their limits."""
    solved, shown = _those(trials, "is_feasible"), _those(trials, "is_shown_feasible")
    missed = [trial["seed"] for trial in shown if not trial["is_feasible"]]
    share = 1.0 - len(missed) / len(shown) if shown else 0.0
    worst = max((trial["excess"] for trial in solved), default=0.0)
    return {
        "suite": "random",
        "problems": len(trials),
        "solved": len(solved),
        "shown_feasible": len(shown),
        "share_of_shown": share,
        "missed_seeds": missed,
        "worst_excess": worst,
        "excess_limit": EXCESS_LIMIT,
        "limit": SOLVED_LIMIT,
        "passed": bool(shown) and share >= SOLVED_LIMIT and worst <= EXCESS_LIMIT,
    }


def infeasible_row(trials: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """How many of the planted causes are named."""
    wrong = [trial["seed"] for trial in trials if not trial.get("is_true", False)]
    return {
        "suite": "infeasible",
        "problems": len(trials),
        "named": len(trials) - len(wrong),
        "wrong_seeds": wrong,
        "passed": bool(trials) and not wrong,
    }


def line(row: dict[str, Any]) -> str:
    """A row as one line."""
    verdict = "" if row["passed"] else " (limit missed)"
    if row["suite"] == "speed":
        text = (
            f"{row['case']}, {row['method']}: {row['cpu_ms']:.1f} ms (limit {row['limit_ms']:g}),"
            f" jerk {row['jerk']:.2f}, excess {row['excess']:.1e}"
        )
    elif row["suite"] == "optimum":
        text = (
            f"jerk {row['jerk']:.2f}, best of {row['starts']} random starts"
            f" {row['best_jerk']:.2f}: {100.0 * row['gap']:+.2f} % (limit"
            f" {100.0 * row['limit']:g} %)"
        )
    elif row["suite"] == "random":
        text = (
            f"{row['solved']} of {row['problems']} random problems solved,"
            f" {100.0 * row['share_of_shown']:.1f} % of {row['shown_feasible']} that priorities"
            f" solve (limit {100.0 * row['limit']:g} %), worst excess {row['worst_excess']:.1e}"
        )
    else:
        text = f"{row['named']} of {row['problems']} infeasible problems named truly (limit: all)"
    return text + verdict
