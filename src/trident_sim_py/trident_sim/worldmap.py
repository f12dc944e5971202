# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Command line: the true occupancy map of a world."""

from __future__ import annotations

import argparse
import sys
import warnings
from pathlib import Path

import numpy as np

from trident_sim._core import Error
from trident_sim._environment import complete_environment
from trident_sim.occupancy import FREE, OCCUPIED, MapConfig, OccupancyMap, occupancy_map
from trident_sim.terrain_map import map_above_ground
from trident_sim.world import SimulationWarning, World


def main(arguments: list[str] | None = None) -> int:
    """Write PGM and YAML.

    Returns:
        0: written; 2: not, and the reason has been reported.
    """
    options = _parser().parse_args(arguments)
    complete_environment()
    warnings.simplefilter("ignore", SimulationWarning)  # only reads; a run reports them
    try:
        out = options.out or Path(Path(options.world).stem + ".pgm")
        make = map_above_ground if options.above_ground else occupancy_map
        result = make(World(_world_file(options.world)), _config(options))
        result.save(out)
    except Error as error:
        print(f"worldmap: {error}", file=sys.stderr)
        return 2
    print(_summary(result, out))
    return 0


def _parser() -> argparse.ArgumentParser:
    default = MapConfig()
    parser = argparse.ArgumentParser(prog="trident worldmap", description=__doc__)
    parser.add_argument("world", metavar="WORLD", help="name of a file in worlds/, or a path")
    parser.add_argument("--out", type=Path, metavar="FILE.pgm", help="default: WORLD.pgm, here")
    parser.add_argument("--resolution", type=float, default=default.resolution, metavar="M")
    parser.add_argument(
        "--height", type=float, action="append", metavar="M", help="to cut at; may be repeated"
    )
    parser.add_argument(
        "--above-ground", action="store_true", help="heights count from the ground below, not z = 0"
    )
    parser.add_argument(
        "--start", default="0,0", metavar="X,Y", help="a free place; free is what it leads to"
    )
    parser.add_argument("--reach", type=float, default=default.reach, metavar="M")
    parser.add_argument("--margin", type=float, default=default.margin, metavar="M")
    return parser


def _config(options: argparse.Namespace) -> MapConfig:
    try:
        x, y = (float(word) for word in options.start.split(","))
    except ValueError as error:
        raise Error(f"--start: '{options.start}', legal: two numbers, X,Y") from error
    heights = tuple(options.height or MapConfig().heights)
    return MapConfig(options.resolution, heights, (x, y), options.reach, options.margin)


def _world_file(word: str) -> str:
    """A bare name stands for a file of worlds/."""
    is_name = not word.endswith((".world", ".sdf")) and "/" not in word
    return f"worlds/{word}.world" if is_name else word


def _summary(result: OccupancyMap, out: Path) -> str:
    rows, columns = result.cells.shape
    area = result.resolution**2
    free = np.count_nonzero(result.cells == FREE) * area
    occupied = np.count_nonzero(result.cells == OCCUPIED) * area
    x, y = result.origin
    return (
        f"{out} and {out.with_suffix('.yaml').name}: {columns} x {rows} cells of "
        f"{result.resolution:g} m from ({x:g}, {y:g}) m; {free:.1f} m^2 free, "
        f"{occupied:.1f} m^2 occupied"
    )


if __name__ == "__main__":
    sys.exit(main())
