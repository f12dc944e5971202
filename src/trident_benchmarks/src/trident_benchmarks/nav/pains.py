# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The suite pains: a scene for each group of issues that users of other navigation stacks report."""

from __future__ import annotations

import argparse
from typing import Any

from trident_benchmarks.nav.pains_suite.drives import near_goals, silence, walkers
from trident_benchmarks.nav.pains_suite.instructions import instructions
from trident_benchmarks.nav.pains_suite.rows import table
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
        A row for each measurement.

    Raises:
        EvalError: a scene could not be played.
    """
    scenes = (
        ("P4 - P9", lambda: _plain_scenes(options.quick)),
        ("P12", lambda: instructions(options.quick)),
        ("P1", lambda: silence(options.config, options.jobs)),
        ("P2", lambda: near_goals(options.config, options.jobs, options.quick)),
        ("P11", lambda: walkers(options.config, options.jobs, options.quick)),
        ("P10", lambda: start_orders(options.quick)),
        ("P3", lambda: steady_rate(options.quick)),
    )
    rows: list[dict[str, Any]] = []
    for name, play in scenes:
        say(f"{name} ...")
        rows += play()
    print(table(rows))
    for row in rows:
        if not row["passed"]:
            say(f"{row['scene']}: {row['what']}: {row['note']}")
    return rows
