# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Room for vehicles that have a width: paths are moved away from what stands next to them."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

import numpy as np
from scipy.ndimage import distance_transform_edt

from trident_fleet.core.missions.scene import Place
from trident_fleet.core.search.area import Array, Mask, SearchArea

_FINER = 4  # points of the field along a cell
_SPACING_M = 1.0
_ROUNDS, _ROUND_M = 20, 0.25  # in which a point is moved, and how far at most in one
_PERSON_M = 2.0  # from the middle of a person who lies to that of a robot that passes
_STRAIGHT_M = 0.25  # that a corner that is left out may lie off the line


class Room:
    """How far what stands there is from each place that a kind of robot gets to."""

    def __init__(self, area: SearchArea, domain: str, clearance_m: float) -> None:
        """Of an area.

        Args:
            area: that is searched.
            domain: the medium that the robot moves in.
            clearance_m: from what stands there to the middle of the robot, where there is room [m].
        """
        self._clearance_m, self._origin = clearance_m, area.lattice.origin
        self._step_m = area.lattice.cell_m / _FINER
        free: Mask = np.kron(area.reach(domain), np.ones((_FINER, _FINER), dtype=bool))
        blocked = not free.all()
        away = distance_transform_edt(free) if blocked else np.full(free.shape, np.inf)
        self._away_m: Array = (np.asarray(away) - 0.5) * self._step_m
        finite = np.minimum(self._away_m, 2.0 * clearance_m)
        self._up, self._right = np.gradient(finite, self._step_m)

    def away_m(self, places: Array) -> Array:
        """Distance of places to what stands there [m], shape (N,)."""
        return np.asarray(self._away_m[self._index(places)])

    def widened(
        self, start: Place, path: Sequence[Place], people: Sequence[Place] = ()
    ) -> list[Place]:
        """A path with the same end, moved to where there is room; corners on a line are left out.

        Args:
            start: of the path, p_common [m].
            path: its corners.
            people: who lie there, p_common [m].
        """
        if not path:
            return []
        points = _dense([start, *path])
        inner = points[1:-1]
        for _ in range(_ROUNDS):
            index = self._index(inner)
            by_m = np.clip(0.5 * (self._clearance_m - self._away_m[index]), 0.0, _ROUND_M)
            inner[:, 0] += by_m * self._right[index]
            inner[:, 1] += by_m * self._up[index]
            for person in people:
                _keep_off(inner, person)
        corners = _simplified([(float(x), float(y)) for x, y in points])
        return corners[1:]

    def _index(self, places: Array) -> tuple[Array, Array]:
        rows, columns = self._away_m.shape
        column = ((places[:, 0] - self._origin[0]) / self._step_m).astype(int)
        row = ((places[:, 1] - self._origin[1]) / self._step_m).astype(int)
        return np.clip(row, 0, rows - 1), np.clip(column, 0, columns - 1)


def _keep_off(points: Array, person: Place) -> None:
    """Move points away from who lies there."""
    aside = points - np.array(person)
    away = np.maximum(np.hypot(aside[:, 0], aside[:, 1]), 1e-3)
    points += (np.clip(_PERSON_M - away, 0.0, _ROUND_M) / away)[:, None] * aside


def _dense(corners: Sequence[Place]) -> Array:
    """Points along a path, shape (N, 2)."""
    points = [corners[0]]
    for one, other in itertools.pairwise(corners):
        count = max(math.ceil(math.dist(one, other) / _SPACING_M), 1)
        for share in np.linspace(0.0, 1.0, count + 1)[1:]:
            points.append(
                (one[0] + share * (other[0] - one[0]), one[1] + share * (other[1] - one[1]))
            )
    return np.array(points, dtype=float)


def _simplified(points: list[Place]) -> list[Place]:
    """The same line with fewer corners (Douglas and Peucker 1973)."""
    kept, parts = {0, len(points) - 1}, [(0, len(points) - 1)]
    while parts:
        begin, end = parts.pop()
        inner = range(begin + 1, end)
        off = [_off(points[index], points[begin], points[end]) for index in inner]
        if off and max(off) > _STRAIGHT_M:
            middle = begin + 1 + off.index(max(off))
            kept.add(middle)
            parts += [(begin, middle), (middle, end)]
    return [points[index] for index in sorted(kept)]


def _off(place: Place, begin: Place, end: Place) -> float:
    """Distance of a place to a straight line between two [m]."""
    along_x, along_y = end[0] - begin[0], end[1] - begin[1]
    square = along_x**2 + along_y**2
    share = 0.0
    if square > 0.0:
        share = ((place[0] - begin[0]) * along_x + (place[1] - begin[1]) * along_y) / square
        share = min(max(share, 0.0), 1.0)
    return math.hypot(place[0] - begin[0] - share * along_x, place[1] - begin[1] - share * along_y)
