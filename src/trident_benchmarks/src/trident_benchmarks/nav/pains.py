# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The suite pains: scenes of the issues that users of other navigation stacks report."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

from trident_eval.core.errors import EvalError

from trident_benchmarks.nav.pains_suite.drives import near_goals, silence, walkers
from trident_benchmarks.nav.pains_suite.instructions import instructions
from trident_benchmarks.nav.pains_suite.rows import pain, table
from trident_benchmarks.nav.pains_suite.start_orders import start_orders
from trident_benchmarks.nav.pains_suite.steady_rate import steady_rate
from trident_benchmarks.nav.programs import rows_of
from trident_benchmarks.results import say


def _plain_scenes(quick: bool) -> list[dict[str, Any]]:
    words = ["--quick"] if quick else []
    return [{"suite": "pains"} | row for row in rows_of("nav_pain_scenes", words)]


def measure(options: argparse.Namespace) -> list[dict[str, Any]]:
    """Plays all scenes and prints the table.

    Returns:
        A row for each measurement; one that fails for a scene that could not be played.
    """
    quick = options.quick
    scenes: tuple[tuple[str, Callable[[], list[dict[str, Any]]]], ...] = (
        ("P4", lambda: _plain_scenes(quick)),
        ("P12", lambda: instructions(quick)),
        ("P1", lambda: silence(options.config, options.jobs)),
        ("P2", lambda: near_goals(options.config, options.jobs, quick)),
        ("P11", lambda: walkers(options.config, options.jobs, quick)),
        ("P10", lambda: start_orders(quick)),
        ("P3", lambda: steady_rate(quick)),
    )
    rows: list[dict[str, Any]] = []
    for name, play in scenes:
        say(f"{name} ...")
        try:
            rows += play()
        except EvalError as error:
            say(str(error))
            first = str(error).splitlines()[0]
            rows.append(pain(name, "-", f"not played: {first}", 1.0, 0.0, "scenes"))
    print(table(rows))
    for row in rows:
        if not row["passed"]:
            say(f"{row['scene']}: {row['what']}: {row['note']}")
    return rows
