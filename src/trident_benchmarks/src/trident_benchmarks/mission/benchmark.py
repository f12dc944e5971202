# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident bench mission`: what cooperation is worth in a search and rescue."""

from __future__ import annotations

import argparse
from pathlib import Path

from trident_benchmarks.options import positive


def add_options(parser: argparse.ArgumentParser) -> None:
    """Its options."""
    parser.add_argument(
        "--seeds", type=positive, default=20, metavar="N", help="coasts; default 20"
    )
    parser.add_argument(
        "--full", action="store_true", help="three of a kind, other methods and links, hard days"
    )
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")
    parser.add_argument(
        "--picture", type=Path, metavar="FILE.png", help="coverage over time of all modes"
    )


def run(options: argparse.Namespace) -> int:
    """Measure and print; the exit code."""
    from trident_benchmarks.mission.measure import measure

    return measure(options)
