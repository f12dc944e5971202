# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident bench sim`: the simulator, by itself and with controllers."""

from __future__ import annotations

import argparse
from pathlib import Path

from trident_benchmarks.options import positive


def add_options(parser: argparse.ArgumentParser) -> None:
    """Its options."""
    parser.add_argument(
        "--quick", action="store_true", help="N <= 6, one run each, no launch files"
    )
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")
    parser.add_argument("--profile", action="store_true", help="time per stage of a step")
    parser.add_argument("--markdown", action="store_true", help="a Markdown table on stdout")
    parser.add_argument("--runs", type=positive, metavar="N", help="runs per row (3; --quick: 1)")
    parser.add_argument(
        "--mode", action="append", default=[], help="only this mode; may be repeated"
    )
    parser.add_argument(
        "--controller",
        type=Path,
        metavar="PROGRAM",
        help="for lockstep_external: another build of lee_position_controller_node",
    )
    parser.add_argument(
        "--world",
        choices=["coast"],
        help="measure UAVs, UGVs and USVs together instead, --mode being one of their fleets",
    )


def run(options: argparse.Namespace) -> int:
    """Measure and print; the exit code."""
    from trident_benchmarks.sim.measure import measure

    return measure(options)
