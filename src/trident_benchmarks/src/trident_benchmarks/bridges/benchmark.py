# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident bench bridges`: a message from ROS through two bridges back to ROS."""

from __future__ import annotations

import argparse
from pathlib import Path


def add_options(parser: argparse.ArgumentParser) -> None:
    """Its options."""
    parser.add_argument("--quick", action="store_true", help="3 s of each row, not 60")
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")
    parser.add_argument("--only", metavar="ROW", help="one row, by its name")


def run(options: argparse.Namespace) -> int:
    """Measure and print; the exit code."""
    from trident_benchmarks.bridges.measure import measure

    return measure(options)
