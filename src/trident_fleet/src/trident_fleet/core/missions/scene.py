# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The record of a coast that is searched, as `./trident worldgen coast` writes it next to a world.

The area and the bases are known to robots; where people are only to who simulates and judges.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image

from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.strict_yaml import Section, load
from trident_fleet.core.search.area import Lattice, SearchArea

Place = tuple[float, float]

_LAND, _COVERED, _GROUND, _WATER = 1, 2, 4, 8
_WHITE = 65535.0


@dataclass(frozen=True)
class Person:
    """Somebody who is to be found.

    Attributes:
        name: of the model in the world.
        place: at the start, p_common [m].
        where: `open`, `cover` or `water`.
    """

    name: str
    place: Place
    where: str


@dataclass(frozen=True)
class Scene:
    """What is searched.

    Attributes:
        seed: of the coast.
        area: its cells.
        bases: where robots start by the medium that they move in, p_common [m].
        covers: middles of what only the ground sees below, p_common [m].
        people: who is to be found.
    """

    seed: int
    area: SearchArea
    bases: dict[str, Place]
    covers: tuple[Place, ...]
    people: tuple[Person, ...]


def read_scene(path: Path) -> Scene:
    """A record.

    Raises:
        FormationError: what is wrong, with file, line, key, value and legal range.
    """
    file = load(path)
    seed, cell_m = file.integer("seed", 0), file.number("cell", 2.0)
    length, width = _pair(file, "size")
    if not (0.0 < cell_m <= min(length, width)):
        raise file.error("cell", f"{cell_m:g}; legal: above 0 m, up to the size")
    rows, columns = round(width / cell_m), round(length / cell_m)
    lattice = Lattice(rows, columns, cell_m, (-length / 2, -width / 2))
    flags = _picture(file, path, file.text("cells", ""), lattice)
    heights = file.section("heights")
    lowest, relief = heights.number("lowest", 0.0), heights.number("relief", 1.0)
    levels = _picture(heights, path, heights.text("file", ""), lattice)
    heights.finish()
    area = SearchArea(
        lattice,
        flags & _LAND > 0,
        flags & _COVERED > 0,
        flags & _GROUND > 0,
        flags & _WATER > 0,
        lowest + relief * levels / _WHITE,
    )
    bases = file.section("bases")
    places = {name: _pair(bases, name) for name in ("air", "ground", "water")}
    bases.finish()
    file.text("environment", "")
    covers = tuple(_cover(part) for part in _entries(file, "covers"))
    people = tuple(_person(part) for part in _entries(file, "casualties"))
    file.finish()
    return Scene(seed, area, places, covers, people)


def _entries(file: Section, name: str) -> list[Section]:
    return list(file.sections(name)) if name in file else []


def _pair(file: Section, name: str) -> Place:
    values: list[Any] = file.items(name)
    legal = len(values) == 2 and all(type(value) in (int, float) for value in values)
    if not legal or not np.isfinite(values).all():
        raise file.error(name, f"{values}; legal: [X, Y], finite, in m")
    return float(values[0]), float(values[1])


def _cover(part: Section) -> Place:
    place = part.number("x", 0.0), part.number("y", 0.0)
    part.number("side", 18.0)
    part.text("kind", "roof")
    part.finish()
    return place


def _person(part: Section) -> Person:
    name, place = part.text("name", ""), (part.number("x", 0.0), part.number("y", 0.0))
    person = Person(name, place, part.choice("where", ("open", "cover", "water")))
    part.finish()
    return person


def _picture(file: Section, path: Path, name: str, lattice: Lattice) -> npt.NDArray[np.int64]:
    """A gray picture with a pixel for each cell, row 0 at the smallest y."""
    picture = path.parent / name
    try:
        with Image.open(picture) as image:
            pixels = np.asarray(image, dtype=np.int64)
    except (OSError, ValueError) as error:
        raise FormationError(f"{picture}: cannot be read: {error}") from None
    if pixels.shape != lattice.shape:
        raise FormationError(
            f"{picture}: {pixels.shape} pixels; legal: {lattice.shape}, by size and cell of {path}"
        )
    return pixels[::-1]
