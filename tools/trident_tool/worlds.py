# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The subcommands about worlds."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from trident_tool.formation import Handler, option_words
from trident_tool.modules import run_module
from trident_tool.workspace import Runner, Workspace


def add_world_commands(add: Callable[[str, Handler, str], argparse.ArgumentParser]) -> None:
    """Adds ``worldmap`` and ``worldgen`` to the command line."""
    sub = add("worldmap", _cmd_worldmap, "the true occupancy map of a world, for map_server")
    sub.add_argument("world", metavar="WORLD", help="name of a file in worlds/, or a path")
    sub.add_argument("--out", type=Path, metavar="FILE.pgm", help="default: WORLD.pgm, here")
    sub.add_argument("--resolution", type=float, metavar="M", help="side of a cell; default 0.05")
    sub.add_argument(
        "--height",
        type=float,
        action="append",
        metavar="M",
        help="to cut at; default 0.2; may be repeated",
    )
    sub.add_argument(
        "--above-ground", action="store_true", help="heights count from the ground below, not z = 0"
    )
    sub.add_argument(
        "--start", metavar="X,Y", help="a free place, default 0,0; free is what it leads to"
    )
    sub.add_argument("--reach", type=float, metavar="M", help="around the start; default 100")
    sub.add_argument("--margin", type=float, metavar="M", help="around obstacles; default 0.5")

    sub = add("worldgen", _cmd_worldgen, "make a world from a seed")
    sub.add_argument("kind", choices=["coast", "cylinders", "forest", "hall", "office", "regatta"])
    sub.add_argument("--seed", type=int, metavar="N", help="default 1, as those of worlds/")
    sub.add_argument("--length", type=float, metavar="M", help="along x")
    sub.add_argument("--width", type=float, metavar="M", help="along y")
    sub.add_argument("--covers", type=int, metavar="N", help="roofs and groves, of a coast")
    sub.add_argument("--casualties", type=int, metavar="N", help="people to find, on a coast")
    sub.add_argument("--out", type=Path, metavar="FOLDER", help="default: here")


def _cmd_worldmap(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    names = ("out", "resolution", "height", "reach", "margin")
    words = [options.world, *option_words(options, names)]
    if options.above_ground:
        words.append("--above-ground")
    if options.start is not None:
        words.append(f"--start={options.start}")  # may begin with a minus
    return run_module(workspace, runner, "trident_sim.worldmap", words)


def _cmd_worldgen(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    given = option_words(options, ("seed", "length", "width", "covers", "casualties", "out"))
    return run_module(workspace, runner, "trident_worldgen", [options.kind, *given])
