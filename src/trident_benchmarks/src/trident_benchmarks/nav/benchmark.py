# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident bench nav`: a robot drives to goals in worlds of one kind, in one process each."""

from __future__ import annotations

import argparse
from pathlib import Path

from trident_benchmarks.options import positive

#: Names of the suites; each is a module of this package with `measure(options)`.
SUITES = ("barn", "movingai", "office", "pains", "people", "speed", "tight", "turtlebot3")


def add_options(parser: argparse.ArgumentParser) -> None:
    """Its options."""
    parser.add_argument("--quick", action="store_true", help="few worlds and goals, one seed each")
    parser.add_argument("--suite", choices=SUITES, default=SUITES[0], help="default: barn")
    parser.add_argument(
        "--worlds", type=Path, metavar="DIR", help="other worlds; default: $TRIDENT_DATA/SUITE"
    )
    parser.add_argument("--seeds", type=positive, metavar="N", help="of each (10; --quick: 1)")
    parser.add_argument("--jobs", type=positive, metavar="N", help="at a time; default: the cores")
    parser.add_argument(
        "--config", type=Path, action="append", default=[], help="parameters over the default ones"
    )
    parser.add_argument(
        "--launch",
        nargs="+",
        metavar="WORD",
        help="of barn: FILE or PACKAGE FILE, and ARG:=VALUE ...; its move_base's parameters alone",
    )
    parser.add_argument(
        "--robot", action="append", default=[], help="of office, tight and turtlebot3; default: all"
    )
    parser.add_argument(
        "--ros", action="store_true", help="of barn: over ROS, by the action of move_base"
    )
    parser.add_argument(
        "--goals", type=positive, metavar="N", help="of a seed of office (20), turtlebot3 (10)"
    )
    parser.add_argument(
        "--first-seed", type=positive, default=1, metavar="N", help="of office, turtlebot3 (1)"
    )
    parser.add_argument(
        "--first-goal",
        type=positive,
        default=1,
        metavar="N",
        help="of each seed of office, turtlebot3 (1); the robot begins where the goal before it is",
    )
    parser.add_argument("--scene", action="append", default=[], help="of tight; default: all")
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")
    parser.add_argument("--picture", type=Path, metavar="FILE.png", help="worlds and tracks")


def run(options: argparse.Namespace) -> int:
    """Measure and print; the exit code."""
    from trident_benchmarks.nav.suites import measure

    return measure(options)
