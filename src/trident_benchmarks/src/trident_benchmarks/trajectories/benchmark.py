# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident bench trajectories`: how fast, how good and how true plans of teams are."""

from __future__ import annotations

import argparse
from pathlib import Path

SUITES = ("speed", "optimum", "random", "infeasible")


def add_options(parser: argparse.ArgumentParser) -> None:
    """Its options."""
    parser.add_argument("--quick", action="store_true", help="a twentieth of the problems")
    parser.add_argument("--suite", choices=SUITES, action="append", help="one of them; all")
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")
    parser.add_argument(
        "--picture", type=Path, metavar="FILE.png", help="a swap and a rendezvous over time"
    )


def run(options: argparse.Namespace) -> int:
    """Measure and print; the exit code."""
    from trident_benchmarks.trajectories.measure import measure

    return measure(options)
