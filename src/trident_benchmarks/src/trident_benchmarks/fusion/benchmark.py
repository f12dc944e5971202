# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident bench fusion`: how true and how dear one belief about a whole team is."""

from __future__ import annotations

import argparse
from pathlib import Path

SUITES = ("consistency", "outliers", "outage", "delays", "sharing", "lies", "speed")


def add_options(parser: argparse.ArgumentParser) -> None:
    """Its options."""
    parser.add_argument("--quick", action="store_true", help="a fifth of the seeds")
    parser.add_argument("--suite", choices=SUITES, action="append", help="one of them; all")
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")
    parser.add_argument(
        "--picture", type=Path, metavar="FILE.png", help="tracks with ellipses of what is believed"
    )


def run(options: argparse.Namespace) -> int:
    """Measure and print; the exit code."""
    from trident_benchmarks.fusion.measure import measure

    return measure(options)
