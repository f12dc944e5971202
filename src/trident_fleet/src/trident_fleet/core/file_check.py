# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What can be said about a formation before anything flies: its file, its reach, its separation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trident_fleet.core.errors import RowError
from trident_fleet.core.files.formation_file import flying_rows, read_formation
from trident_fleet.core.plan import check_height, check_reach
from trident_fleet.core.quintic import Array
from trident_fleet.core.separation import pair_separations, pairs
from trident_fleet.core.settings import FleetSettings

_NUMBERS_AT_ONCE = 1 << 20


@dataclass(frozen=True)
class Closest:
    """The two vehicles of a formation that come closest to each other.

    Attributes:
        distance_m: while all fly straight from row to row [m].
        vehicles: their indices, from 0.
        row: the row before, from 0.
    """

    distance_m: float
    vehicles: tuple[int, int]
    row: int


def closest(rows: Array) -> Closest | None:
    """The closest two of a formation, shape (T, N, 3) [m, world]; None for a lone vehicle."""
    i, j = pairs(rows.shape[1])
    if not len(i):
        return None
    best: Closest | None = None
    block = max(_NUMBERS_AT_ONCE // (3 * len(i)), 1)
    for begin in range(0, max(len(rows) - 1, 1), block):
        distances = pair_separations(rows[begin : begin + block + 1])
        pair = int(np.argmin(distances))
        if best is None or distances[pair] < best.distance_m:
            row = begin + _closest_row(rows[begin : begin + block + 1, [i[pair], j[pair]]])
            best = Closest(float(distances[pair]), (int(i[pair]), int(j[pair])), row)
    return best


def _closest_row(two: Array) -> int:
    """The row, shape (T, 2, 3), with or after which two vehicles are closest."""
    segments = range(max(len(two) - 1, 1))
    return min(segments, key=lambda row: float(pair_separations(two[row : row + 2])[0]))


def check_formation(settings: FleetSettings, lowest_m: float | None = None) -> list[str]:
    """Read a formation as its nodes will.

    Args:
        settings: of the flight.
        lowest_m: height at which the lowest vehicle is spawned [m, world], if it is known.

    Returns:
        What a user may want to know before it flies, a sentence each.

    Raises:
        FormationError: it cannot be flown.
    """
    source = settings.source
    rows = flying_rows(read_formation(source), source.uavs)
    try:
        check_reach(rows)
        if lowest_m is not None:
            check_height(rows, lowest_m)
    except RowError as error:
        raise error.of_file(source.file) from None
    return too_close(rows, settings)


def too_close(rows: Array, settings: FleetSettings) -> list[str]:
    """A sentence if two vehicles of rows, shape (T, N, 3) [m, world], come closer than wanted."""
    source, wanted_m = settings.source, settings.plan.min_separation_m
    near = closest(rows)
    if near is None or near.distance_m >= wanted_m:
        return []
    first, second = (index + 1 for index in near.vehicles)
    return [
        f"{source.file}: vehicles {first} and {second} come within {near.distance_m:.3f} m of each"
        f" other at row {near.row + 1}, below min_separation {wanted_m:g} m"
    ]
