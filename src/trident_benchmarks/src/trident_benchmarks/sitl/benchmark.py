# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident bench sitl`: vehicles flown by stand-ins for PX4 and ArduPilot, in lockstep."""

from __future__ import annotations

import argparse
from pathlib import Path


def add_options(parser: argparse.ArgumentParser) -> None:
    """Its options."""
    parser.add_argument("--quick", action="store_true", help="6 s of each row, not 17")
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")


def run(options: argparse.Namespace) -> int:
    """Measure and print; the exit code."""
    from trident_benchmarks.sitl.measure import measure

    return measure(options)
