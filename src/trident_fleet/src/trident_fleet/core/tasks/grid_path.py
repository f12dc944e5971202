# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Lengths of paths around obstacles on a grid, as a cost of tasks."""

from __future__ import annotations

import heapq
import math

import numpy as np
import numpy.typing as npt

from trident_fleet.core.tasks.fields import TaskError
from trident_fleet.core.tasks.messages import Point

Cell = tuple[int, int]

_STEPS = [
    (dx, dy, math.hypot(dx, dy)) for dx in (-1, 0, 1) for dy in (-1, 0, 1) if (dx, dy) != (0, 0)
]


class GridPath:
    """The shortest path over free cells, by A* in eight directions, past no corner of an obstacle.

    Lengths are kept, as the same places are asked for again and again.
    """

    def __init__(
        self, blocked: npt.NDArray[np.bool_], cell_m: float, origin: tuple[float, float]
    ) -> None:
        """Of a map.

        Args:
            blocked: cells that cannot be passed, shape (X, Y).
            cell_m: side of a cell [m].
            origin: corner of the cell (0, 0), p_common [m].

        Raises:
            TaskError: the map is not legal.
        """
        if blocked.ndim != 2 or not blocked.size:
            raise TaskError(f"grid: shape is {blocked.shape}, legal: two numbers above 0")
        if not 0.0 < cell_m < math.inf:
            raise TaskError(f"grid: cell_m is {cell_m}, legal: finite, above 0")
        self._blocked, self._cell_m, self._origin = blocked, cell_m, origin
        self._known: dict[tuple[Cell, Cell], float] = {}

    def __call__(self, start: Point, goal: Point) -> float:
        """Length of the path [m]; infinite where no path exists, or outside the map."""
        one, other = self._cell(start), self._cell(goal)
        pair = (min(one, other), max(one, other))
        if pair not in self._known:
            self._known[pair] = self._search(*pair)
        return max(self._known[pair], math.dist(start, goal))

    def _cell(self, place: Point) -> Cell:
        x, y = (math.floor((place[i] - self._origin[i]) / self._cell_m) for i in (0, 1))
        return x, y

    def _free(self, x: int, y: int) -> bool:
        inside = 0 <= x < self._blocked.shape[0] and 0 <= y < self._blocked.shape[1]
        return inside and not self._blocked[x, y]

    def _search(self, start: Cell, goal: Cell) -> float:
        if not self._free(*start) or not self._free(*goal):
            return math.inf
        best = {start: 0.0}
        queue = [(_octile(start, goal), start)]
        while queue:
            total, cell = heapq.heappop(queue)
            length = best[cell]
            if cell == goal:
                return length * self._cell_m
            if total > length + _octile(cell, goal) + 1e-9:
                continue
            x, y = cell
            for dx, dy, step in _STEPS:
                near = (x + dx, y + dy)
                if not (self._free(*near) and self._free(x + dx, y) and self._free(x, y + dy)):
                    continue
                if length + step < best.get(near, math.inf):
                    best[near] = length + step
                    heapq.heappush(queue, (length + step + _octile(near, goal), near))
        return math.inf


def _octile(one: Cell, other: Cell) -> float:
    """Length of the path over free cells only [cells]."""
    dx, dy = abs(one[0] - other[0]), abs(one[1] - other[1])
    return max(dx, dy) + (math.sqrt(2.0) - 1.0) * min(dx, dy)
