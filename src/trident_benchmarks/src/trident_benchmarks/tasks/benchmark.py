# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident bench tasks`: what methods of allocation are worth, and what a network may do."""

from __future__ import annotations

import argparse
from pathlib import Path

from trident_benchmarks.options import positive


def add_options(parser: argparse.ArgumentParser) -> None:
    """Its options."""
    parser.add_argument("suite", nargs="*", metavar="SUITE", help="allocation, days; default: both")
    parser.add_argument("--days", type=positive, default=2000, help="hard days, by seed")
    parser.add_argument("--quick", action="store_true", help="a few small cases of each")
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")
    parser.add_argument("--picture", type=Path, metavar="FILE.png", help="gaps of all methods")
    parser.add_argument(
        "--refresh",
        metavar="PYTHON",
        help="a Python that has OR-tools: compute what the table of its values lacks, 30 s each",
    )


def run(options: argparse.Namespace) -> int:
    """Measure and print; the exit code."""
    from trident_benchmarks.tasks.measure import measure

    return measure(options)
