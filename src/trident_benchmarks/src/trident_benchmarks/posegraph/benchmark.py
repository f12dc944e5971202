# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident bench posegraph`: pose-graph optimisation compared with GTSAM."""

from __future__ import annotations

import argparse
from pathlib import Path


def add_options(parser: argparse.ArgumentParser) -> None:
    """Its options."""
    parser.add_argument(
        "files", nargs="*", type=Path, metavar="FILE", help="default: $TRIDENT_DATA/pose_graph"
    )
    parser.add_argument("--runs", type=int, default=5, metavar="N", help="of each; default 5")
    parser.add_argument("--quick", action="store_true", help="one run of each")
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")
    parser.add_argument(
        "--gtsam-python", type=Path, metavar="PYTHON", help="the Python that has GTSAM"
    )


def run(options: argparse.Namespace) -> int:
    """Measure and print; the exit code."""
    from trident_benchmarks.posegraph.measure import measure

    return measure(options)
