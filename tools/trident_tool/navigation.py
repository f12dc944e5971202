# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The subcommands about navigation."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from trident_tool.evaluation import words_of
from trident_tool.formation import Handler
from trident_tool.modules import run_module
from trident_tool.workspace import Runner, Workspace


def add_navigation_commands(add: Callable[[str, Handler, str], argparse.ArgumentParser]) -> None:
    """Adds ``plan`` and ``lattice`` to the command line; their words go to trident_nav."""
    sub = add("plan", _run, "plan a path on a map, with any of the planners, and draw it")
    sub.set_defaults(module="trident_nav.plan", passes_on=True)
    sub.add_argument(
        "words",
        nargs="*",
        metavar="MAP.yaml X,Y,YAW X,Y,YAW",
        help="a map of map_server, start and goal [m, rad]",
    )
    sub.add_argument(
        "--planner", metavar="NAME", help="or all; default nav2_smac_planner/SmacPlannerHybrid"
    )
    sub.add_argument("--params", metavar="YAML", help="of the planner: a file, or the text")
    sub.add_argument("--footprint", metavar="[[X,Y],…]", help="of the robot; default: a Jackal's")
    sub.add_argument("--radius", type=float, metavar="M", help="of a round robot instead")
    sub.add_argument("--turning-radius", type=float, metavar="M", help="of the robot; default 0")
    sub.add_argument("--inflation", type=float, metavar="M", help="its radius; default 0.55")
    sub.add_argument("--scaling", type=float, metavar="K", help="of inflation's costs; default 10")
    sub.add_argument("--controller", metavar="NAME", help="draw what it weighs at the start, too")
    sub.add_argument("--speed", type=float, metavar="V", help="of the robot there; default 0.5")
    sub.add_argument(
        "--obstacle",
        action="append",
        metavar="X,Y,R",
        help="a round one that the map does not have [m]; may be repeated",
    )
    sub.add_argument("--layers", type=Path, metavar="FILE.png", help="a picture layer by layer")
    sub.add_argument("--out", type=Path, metavar="FILE.png", help="a picture of map and path")
    sub.add_argument("--json", type=Path, metavar="FILE.json", help="the path's poses")

    sub = add("lattice", _run, "make a control set for the State Lattice planner")
    sub.set_defaults(module="trident_nav.lattice", passes_on=True)
    sub.add_argument(
        "--model", choices=("diff", "ackermann", "omni"), help="of motion; default ackermann"
    )
    sub.add_argument(
        "--radius",
        type=float,
        metavar="M",
        help="of the tightest turn, a vessel's too; default 0.5",
    )
    sub.add_argument("--resolution", type=float, metavar="M", help="of the map; default 0.05")
    sub.add_argument("--headings", type=int, choices=(8, 16, 32), help="default 16")
    sub.add_argument("--out", type=Path, metavar="FILE.json", help="default: standard output")


def _run(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    return run_module(workspace, runner, options.module, words_of(options, options.argv))
