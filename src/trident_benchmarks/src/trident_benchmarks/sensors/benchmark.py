# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident bench sensors`: lidars and cameras."""

from __future__ import annotations

import argparse
from pathlib import Path

from trident_benchmarks.options import positive


def add_options(parser: argparse.ArgumentParser) -> None:
    """Its options."""
    parser.add_argument("--quick", action="store_true", help="a fifth of the time, one run each")
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")
    parser.add_argument("--runs", type=positive, metavar="N", help="runs per row (3; --quick: 1)")
    parser.add_argument(
        "--mode", action="append", default=[], help="only this row; may be repeated"
    )


def run(options: argparse.Namespace) -> int:
    """Measure and print; the exit code."""
    from trident_benchmarks.sensors.measure import measure

    return measure(options)
