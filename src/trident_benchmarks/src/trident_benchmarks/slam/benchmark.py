# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident bench slam`: SLAM on the public logs, or in a simulated world."""

from __future__ import annotations

import argparse
from pathlib import Path


def add_options(parser: argparse.ArgumentParser) -> None:
    """Its options."""
    parser.add_argument(
        "--quick", action="store_true", help="default method, logs with relations, one run each"
    )
    parser.add_argument("--runs", type=int, metavar="N", help="runs per row (5; --quick: 1)")
    parser.add_argument(
        "--method", action="append", default=[], help="may be repeated; default: all"
    )
    parser.add_argument("--config", type=Path, metavar="FILE.yaml")
    parser.add_argument("--data", type=Path, metavar="DIR", help="other logs, and their .relations")
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")
    parser.add_argument(
        "--live",
        action="store_true",
        help="instead: how long scans wait while a graph of 5,000 nodes is optimised",
    )
    parser.add_argument(
        "--robustness",
        action="store_true",
        help="instead: logs with odometry that errs, a laser that sits elsewhere, worse scans",
    )
    parser.add_argument("--world", metavar="NAME", help="drives through it instead of logs: office")
    parser.add_argument("--seeds", type=int, metavar="N", help="of drives (20; --quick: 2)")
    parser.add_argument(
        "--keep", type=Path, metavar="DIR", help="keeps logs and maps of the drives"
    )
    parser.add_argument("--pictures", type=Path, metavar="DIR", help="maps and reports of all logs")


def run(options: argparse.Namespace) -> int:
    """Measure and print; the exit code."""
    from trident_benchmarks.slam.measure import measure

    return measure(options)
