# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The subcommands that make position files and launch files of formations."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path

from trident_tool.modules import run_module
from trident_tool.workspace import Runner, Workspace

Handler = Callable[[Workspace, Runner, argparse.Namespace], int]

_STEPS = "line, wedge, circle, grid, translate:X,Y,Z, rotate:DEGREES, rescale:FACTOR"


def add_formation_commands(add: Callable[[str, Handler, str], argparse.ArgumentParser]) -> None:
    """Adds ``formation`` and ``formation-launch`` to the command line."""
    sub = add("formation", _cmd_formation, "make a position file from patterns, free of collisions")
    sub.add_argument(
        "words",
        nargs="+",
        metavar="FILE.yaml | PATTERN [STEP …]",
        help=f"a choreography, see config/formations/patterns_tour.yaml; or steps: {_STEPS}",
    )
    sub.add_argument("--uavs", type=int, metavar="N", help="how many; default: 6, or the file's")
    sub.add_argument("--spacing", type=float, metavar="M", help="of all patterns; default 1.5 m")
    sub.add_argument(
        "--min-separation", type=float, metavar="M", help="to be kept; default 1 m, or the file's"
    )
    sub.add_argument(
        "--out",
        type=Path,
        action="append",
        metavar="FILE",
        help="a .mat file, or text by any other suffix; may be given twice",
    )

    sub = add("formation-launch", _cmd_formation_launch, "make a launch file for many vehicles")
    sub.add_argument("--uavs", type=int, required=True, metavar="N", help="how many")
    sub.add_argument(
        "--formation", type=Path, metavar="FILE", help="position file; default: one is made"
    )
    sub.add_argument(
        "--vehicles-in-file", type=int, metavar="N", help="how many its rows interleave; default N"
    )
    sub.add_argument("--layout", metavar="LAYOUT", help="of an ambiguous .mat, e.g. 3xNxT")
    sub.add_argument("--mav", metavar="NAME", help="vehicle; default firefly")
    sub.add_argument("--spacing", type=float, metavar="M", help="on the ground; default 1.6 m")
    sub.add_argument("--out", type=Path, metavar="FILE.launch", help="default fleet_N.launch")


def option_words(options: argparse.Namespace, names: Sequence[str]) -> list[str]:
    """The options of these names that were given, as words of a command line."""
    words = []
    for name in names:
        value = getattr(options, name)
        for item in value if isinstance(value, list) else [value]:
            if item is not None:
                words += [f"--{name.replace('_', '-')}", str(item)]
    return words


def _cmd_formation(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    given = option_words(options, ("uavs", "spacing", "min_separation", "out"))
    words = [*options.words, *given]
    return run_module(workspace, runner, "trident_fleet.cli.make_formation", words)


def _cmd_formation_launch(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    names = ("uavs", "formation", "vehicles_in_file", "layout", "mav", "spacing", "out")
    given = option_words(options, names)
    return run_module(workspace, runner, "trident_fleet.cli.make_launch", given)
