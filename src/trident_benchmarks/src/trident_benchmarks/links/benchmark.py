# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident bench links`: radios next to ns-3, and what they cost."""

from __future__ import annotations

import argparse
from pathlib import Path

SUITES = ("per", "goodput", "adaptive", "cost", "silence", "station")


def add_options(parser: argparse.ArgumentParser) -> None:
    """Its options."""
    parser.add_argument(
        "--quick", action="store_true", help="shorter runs, 8 distances of 40, 2 coasts of 30"
    )
    parser.add_argument("--suite", choices=SUITES, action="append", help="one of them; all")
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")
    parser.add_argument("--picture", type=Path, metavar="FILE.png", help="goodput over distance")
    parser.add_argument("--losses", type=Path, metavar="FILE.png", help="loss over ns-3's")
    parser.add_argument("--coast", type=Path, metavar="FILE.png", help="how radios cover the coast")


def run(options: argparse.Namespace) -> int:
    """Measure and print; the exit code."""
    from trident_benchmarks.links.measure import measure

    return measure(options)
