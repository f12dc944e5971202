# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Command line: make a world from a seed."""

from __future__ import annotations

import argparse
import dataclasses
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from trident_sim import Error
from trident_worldgen.buoys import RegattaConfig, regatta
from trident_worldgen.coast import CoastConfig, coast
from trident_worldgen.cylinders import CylindersConfig, cylinders
from trident_worldgen.forest import ForestConfig, forest
from trident_worldgen.hall import HallConfig, hall
from trident_worldgen.office import OfficeConfig, office
from trident_worldgen.sdf import Files, write_files

_KINDS: dict[str, tuple[type[Any], Callable[[Any], Files]]] = {
    "office": (OfficeConfig, office),
    "hall": (HallConfig, hall),
    "forest": (ForestConfig, forest),
    "coast": (CoastConfig, coast),
    "cylinders": (CylindersConfig, cylinders),
    "regatta": (RegattaConfig, regatta),
}


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="trident worldgen", description=__doc__)
    parser.add_argument("kind", choices=sorted(_KINDS))
    parser.add_argument("--seed", type=int, default=1, help="default 1")
    parser.add_argument("--length", type=float, metavar="M", help="along x")
    parser.add_argument("--width", type=float, metavar="M", help="along y")
    parser.add_argument("--covers", type=int, metavar="N", help="roofs and groves, of a coast")
    parser.add_argument("--casualties", type=int, metavar="N", help="people to find, on a coast")
    parser.add_argument("--out", type=Path, default=Path(), metavar="FOLDER", help="default: here")
    return parser


def _sizes(options: argparse.Namespace) -> dict[str, float]:
    """Sizes [m] and counts that were given, by name."""
    names = ("length", "width", "covers", "casualties")
    given = {name: getattr(options, name) for name in names}
    return {name: value for name, value in given.items() if value is not None}


def main(arguments: list[str] | None = None) -> int:
    """Write a world and what belongs to it.

    Returns:
        0: written; 2: not, and the reason has been reported.
    """
    options = _parser().parse_args(arguments)
    make_config, make = _KINDS[options.kind]
    sizes = _sizes(options)
    fields = {field.name for field in dataclasses.fields(make_config)}
    for name in sizes.keys() - fields:
        print(f"worldgen: --{name}: a {options.kind} has no such thing", file=sys.stderr)
        return 2
    try:
        files = write_files(make(make_config(seed=options.seed, **sizes)), options.out)
    except Error as error:
        print(f"worldgen: {error}", file=sys.stderr)
        return 2
    world = next(file for file in files if file.suffix == ".world")
    print(f"{world}" + (f" and {len(files) - 1} files next to it" if len(files) > 1 else ""))
    return 0


if __name__ == "__main__":
    sys.exit(main())
