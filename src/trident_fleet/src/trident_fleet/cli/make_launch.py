# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Writes a launch file for a fleet of any size, and a formation for it if none is given."""

from __future__ import annotations

import argparse
import shlex
import sys
from pathlib import Path

import rospkg

from trident_fleet.core.choreography import perform
from trident_fleet.core.choreography_file import parse_words
from trident_fleet.core.config import PlanConfig
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource, flying_rows, read_formation
from trident_fleet.core.files.position_file import write_positions
from trident_fleet.core.fleet_launch import MAX_VEHICLES, Fleet, fleet_launch, spawn_grid
from trident_fleet.core.quintic import Array
from trident_fleet.core.transit import transit_points

TEMPLATE = "launch/multi_uav_simulation.launch"
_TOUR = ("grid", "translate:4,0,0.5", "rotate:90", "circle", "grid")
_SPACING_M = 1.5


def main(arguments: list[str] | None = None) -> int:
    """Make a launch file.

    Returns:
        0: written; 1: it cannot be, and the reason is reported.
    """
    options = _parser().parse_args(arguments)
    try:
        if not 1 <= options.uavs <= MAX_VEHICLES:
            raise FormationError(f"--uavs: {options.uavs}; legal: 1 to {MAX_VEHICLES}")
        out = options.out or Path(f"fleet_{options.uavs}.launch")
        source = _source(options, out)
        rows = flying_rows(read_formation(source), options.uavs)
        fleet = Fleet(
            spawn=_spawn(rows, options.spacing),
            formation_file=_seen_from(out, Path(source.file)),
            vehicles_in_file=source.vehicles_in_file,
            layout=source.layout,
            mav_name=options.mav,
            command=shlex.join(["./trident", "formation-launch", *(arguments or sys.argv[1:])]),
        )
        _write(out, fleet_launch(_template(), fleet))
    except FormationError as error:
        print(f"formation-launch: {error}", file=sys.stderr)
        return 1
    print(f"wrote {out}; fly it: ./trident run {out}")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="formation-launch", description=__doc__)
    parser.add_argument("--uavs", type=int, required=True, metavar="N")
    parser.add_argument("--formation", type=Path, metavar="FILE")
    parser.add_argument("--vehicles-in-file", type=int, metavar="N", help="default: uavs")
    parser.add_argument("--layout", default="", help="of an ambiguous .mat file")
    parser.add_argument("--mav", default="firefly", metavar="NAME")
    parser.add_argument("--spacing", type=float, default=1.6, metavar="M", help="on the ground")
    parser.add_argument("--out", type=Path, metavar="FILE.launch")
    return parser


def _source(options: argparse.Namespace, out: Path) -> FormationSource:
    file: Path | None = options.formation
    if file is None:
        file = out.with_suffix(".txt")
        rows = perform(parse_words(list(_TOUR), options.uavs, _SPACING_M)).rows
        write_positions(file, rows, [f"made by: ./trident formation {shlex.join(_TOUR)}"])
    vehicles: int | None = options.vehicles_in_file
    if vehicles is None:
        vehicles = 0 if file.suffix.lower() == ".mat" else options.uavs
    return FormationSource(
        str(file), vehicles_in_file=vehicles, uavs=options.uavs, layout=options.layout
    )


def _spawn(rows: Array, spacing_m: float) -> Array:
    """Where the vehicles stand at first; makes sure that they can take off from there."""
    spawn = spawn_grid(rows[0], spacing_m)
    transit_points(spawn, rows[0], PlanConfig())
    return spawn


def _seen_from(launch_file: Path, file: Path) -> str:
    """A path for a launch file: relative to it where both lie together."""
    folder, target = launch_file.resolve().parent, file.resolve()
    if target.is_relative_to(folder):
        return f"$(dirname)/{target.relative_to(folder)}"
    return str(target)


def _template() -> str:
    try:
        folder = Path(rospkg.RosPack().get_path("trident_bringup"))
    except rospkg.ResourceNotFound as error:
        raise FormationError("no package trident_bringup; legal: a sourced workspace") from error
    return (folder / TEMPLATE).read_text(encoding="utf-8")


def _write(path: Path, text: str) -> None:
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise FormationError(f"{path}: {error.strerror}; legal: a file in a folder") from error


if __name__ == "__main__":
    sys.exit(main())
