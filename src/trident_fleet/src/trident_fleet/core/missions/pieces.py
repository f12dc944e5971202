# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The area cut into pieces that are searched as tasks, and the lanes that cover one."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from trident_fleet.core.missions.kinds import Kind
from trident_fleet.core.missions.routes import Routes
from trident_fleet.core.missions.scene import Place
from trident_fleet.core.search.area import Array, Index, Mask, SearchArea

_SPREAD = 0.1  # of a band, which higher bands take in
_ON_LANE_M = 10.0  # between points of a lane that is followed past obstacles


@dataclass(frozen=True)
class Piece:
    """A rectangle of the area.

    Attributes:
        name: of its task.
        x: from and to, p_common [m].
        y: from and to, p_common [m].
        wet: most of it is water.
    """

    name: str
    x: tuple[float, float]
    y: tuple[float, float]
    wet: bool

    @property
    def place(self) -> Place:
        """Its middle, p_common [m]."""
        return sum(self.x) / 2, sum(self.y) / 2

    def cells(self, area: SearchArea) -> tuple[slice, slice]:
        """Rows and columns."""
        lattice = area.lattice
        low, left = lattice.cell(self.x[0] + 1e-6, self.y[0] + 1e-6)
        high, right = lattice.cell(self.x[1] - 1e-6, self.y[1] - 1e-6)
        return slice(int(low), int(high) + 1), slice(int(left), int(right) + 1)


def pieces_of(
    area: SearchArea, land_m: float, water_m: float, length_m: float = 100.0
) -> list[Piece]:
    """Bands along x, from the borders to the shore, cut into pieces.

    Args:
        area: that is searched.
        land_m: height of a band on land [m].
        water_m: height of a band on the water [m].
        length_m: greatest length of a piece [m].
    """
    lattice = area.lattice
    dry_rows = area.land.mean(axis=1) >= 0.5
    # The shore is the height that parts most of the dry rows from the wet ones.
    wet = int(np.argmax(np.cumsum(np.append(0, np.where(dry_rows, -1, 1)))))
    south, shore = lattice.origin[1], lattice.origin[1] + wet * lattice.cell_m
    north = south + lattice.size[1]
    bands = [(band, True) for band in _bands(south, shore, water_m)]
    bands += [((b, a), False) for a, b in _bands(north, shore, land_m)][::-1]
    columns = _cut(lattice.origin[0], lattice.origin[0] + lattice.size[0], length_m)
    return [
        Piece(f"search/{index}_{number}", x, y, is_wet)
        for index, (y, is_wet) in enumerate(bands)
        for number, x in enumerate(columns)
    ]


def _bands(border: float, shore: float, height: float) -> list[tuple[float, float]]:
    """From the area's border to the shore, of this height; what little is left is spread."""
    count = (shore - border) / height
    sign = 1.0 if count >= 0.0 else -1.0
    whole, left = divmod(abs(count), 1.0)
    edges = [border + sign * number * height for number in range(int(whole) + 1)]
    if left > _SPREAD or not whole:
        edges.append(shore)
    else:
        edges = [float(edge) for edge in np.linspace(border, shore, int(whole) + 1)]
    return [(a, b) for a, b in itertools.pairwise(edges) if abs(b - a) > 1e-6]


def _cut(begin: float, end: float, most: float) -> list[tuple[float, float]]:
    count = math.ceil((end - begin) / most - 1e-9)
    edges = np.linspace(begin, end, count + 1) if count else np.array([begin])
    return [(float(a), float(b)) for a, b in itertools.pairwise(edges)]


class Lanes:
    """How one kind of robot covers pieces."""

    def __init__(self, area: SearchArea, kind: Kind, routes: Routes) -> None:
        """Of a kind in an area."""
        self._area, self._kind, self._routes = area, kind, routes

    def count(self, piece: Piece) -> int:
        """How many passes a piece needs."""
        lane_m = self._kind.lane_water_m if piece.wet else self._kind.lane_land_m
        return max(math.ceil((piece.y[1] - piece.y[0]) / lane_m - 0.05), 1)

    def work_m(self, piece: Piece) -> float:
        """Length of the passes of a piece that nobody has seen [m]."""
        rows, columns = piece.cells(self._area)
        reach = self._area.reach(self._kind.domain)[rows, columns]
        share = float(reach.mean())
        if share < 0.05:
            return math.inf
        count = self.count(piece)
        length_m = (piece.x[1] - piece.x[0]) - 2.0 * self._inset(piece)
        return count * length_m * max(share, 0.3) + (count - 1) * (piece.y[1] - piece.y[0]) / count

    def _inset(self, piece: Piece) -> float:
        """By how much a pass ends before the piece does: the robot sees ahead."""
        return min(0.2 * self._kind.sensor.range_m, 0.25 * (piece.x[1] - piece.x[0]))

    def path(self, piece: Piece, start: Place, lacks_s: Array) -> list[Place]:
        """Corners of the passes that cover what nobody has seen, from the nearer end on.

        Args:
            piece: it.
            start: where the robot is, p_common [m].
            lacks_s: how long each cell must still be in view [s], shape (rows, columns).
        """
        rows, columns = piece.cells(self._area)
        open_cells: Mask = (lacks_s > 0.0) & (lacks_s < 1e6)
        passes = []
        count = self.count(piece)
        for band in np.array_split(np.arange(rows.start, rows.stop), count):
            seen = np.flatnonzero(open_cells[band[0] : band[-1] + 1, columns].any(axis=0))
            if len(seen):
                passes.append(self._pass(piece, band, seen + columns.start))
        if not passes:
            return []
        corners = _joined(passes, start)
        return self._along(corners, start)

    def _pass(self, piece: Piece, band: Index, seen: Index) -> tuple[Place, Place]:
        lattice = self._area.lattice
        left, _ = lattice.middle(0, int(seen[0]))
        right, _ = lattice.middle(0, int(seen[-1]))
        _, low = lattice.middle(int(band[0]), 0)
        _, high = lattice.middle(int(band[-1]), 0)
        y, inset = float(low + high) / 2, self._inset(piece)
        # Ends at the area's border or at what others cover: the robot sees as far as its range.
        first, last = float(left) + inset, float(right) - inset
        if first > last:
            first = last = (first + last) / 2
        return (first, y), (last, y)

    def _along(self, corners: list[Place], start: Place) -> list[Place]:
        if self._routes.straight:
            return corners
        path: list[Place] = []
        at = start
        for goal in _goals(corners):
            row, column = self._area.lattice.cell(*goal)
            if self._routes.away_m[row, column] <= _ON_LANE_M:
                leg = self._routes.path(at, goal)
                path += leg
                at = leg[-1] if leg else at
        return path


def _goals(corners: list[Place]) -> list[Place]:
    """The corners, and close places along the passes between them."""
    goals = corners[:1]
    for before, corner in itertools.pairwise(corners):
        is_pass = abs(corner[1] - before[1]) < 1e-6
        goals += _between(before, corner) if is_pass else [corner]
    return goals


def _between(one: Place, other: Place) -> list[Place]:
    count = max(math.ceil(math.dist(one, other) / _ON_LANE_M), 1)
    return [
        (one[0] + share * (other[0] - one[0]), one[1] + share * (other[1] - one[1]))
        for share in np.linspace(0.0, 1.0, count + 1)[1:]
    ]


def _joined(passes: list[tuple[Place, Place]], start: Place) -> list[Place]:
    """To and fro over passes from the corner that is nearest."""
    orders = (passes, passes[::-1])
    best: list[Place] = []
    least = math.inf
    for order in orders:
        for flip in (False, True):
            corners: list[Place] = []
            turned = flip
            for one in order:
                corners += one[::-1] if turned else one
                turned = not turned
            length = math.dist(start, corners[0])
            if length < least:
                best, least = corners, length
    return best
