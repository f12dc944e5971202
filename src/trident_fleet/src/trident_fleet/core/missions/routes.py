# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Paths of one kind of robot through the area, and how long they are."""

from __future__ import annotations

import math

import numpy as np
from scipy.ndimage import distance_transform_edt
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import dijkstra

from trident_fleet.core.missions.scene import Place
from trident_fleet.core.search.area import Array, Index, SearchArea
from trident_fleet.core.tasks.messages import Point

_SAMPLE_M, _AHEAD = 0.5, 12
_STEPS = ((0, 1), (1, 0), (1, 1), (1, -1))


class Routes:
    """Shortest paths over the cells that a kind of robot gets to; straight lines in the air."""

    def __init__(self, area: SearchArea, domain: str) -> None:
        """Of an area, for robots that move in `air`, on `ground` or in `water`."""
        self.lattice, self.straight = area.lattice, domain == "air"
        self._free = area.reach(domain)
        # The free cell that is nearest to each cell.
        away, nearest = distance_transform_edt(~self._free, return_indices=True)
        # By number of the cell, for quick access one by one.
        self._reached: list[int] = (nearest[0] * self.lattice.columns + nearest[1]).ravel().tolist()
        self.away_m: Array = np.asarray(away) * self.lattice.cell_m
        self._graph = None if self.straight else self._edges()
        self._fields: dict[int, tuple[Array, Index]] = {}

    def __call__(self, start: Point, goal: Point) -> float:
        """Length of the path between two places, or what is nearest to them [m]: a `Travel`."""
        straight_m = math.hypot(goal[0] - start[0], goal[1] - start[1])
        if self.straight:
            return straight_m
        length_m: float = self._field(self._number(goal))[0].item(self._number(start))
        return max(length_m, straight_m) if straight_m < 2.0 * self.lattice.cell_m else length_m

    def path(self, start: Place, goal: Place) -> list[Place]:
        """Corners of the path; the last one is the goal, or the nearest place that is reached."""
        if self.straight or (self.reaches(goal) and self.is_clear(start, goal)):
            return [goal]
        begin, end = self._number(start), self._number(goal)
        numbers = self._cells(begin, end)
        if not numbers:
            return []
        last = goal if self.reaches(goal) else self._middle(end)
        corners = _corners([*map(self._middle, numbers[1:-1]), last])
        return self._pulled(start, corners)

    def _cells(self, begin: int, end: int) -> list[int]:
        """The cells of the shortest path with both its ends; empty: there is no path."""
        lengths, following = self._field(end)
        if not math.isfinite(float(lengths[begin])):
            return []
        numbers = [begin]
        while numbers[-1] != end:
            numbers.append(int(following[numbers[-1]]))
        return numbers

    def is_clear(self, start: Place, goal: Place) -> bool:
        """Whether the robot gets along the straight line."""
        count = max(math.ceil(math.dist(start, goal) / _SAMPLE_M), 1)
        share = np.linspace(0.0, 1.0, count + 1)
        x = start[0] + share * (goal[0] - start[0])
        y = start[1] + share * (goal[1] - start[1])
        return bool(self._free[self.lattice.cell(x, y)].all())

    def _pulled(self, start: Place, corners: list[Place]) -> list[Place]:
        """The path pulled tight: from each place straight to the last corner that is clear."""
        path, index, at = [], 0, start
        while index < len(corners):
            ahead = range(min(index + _AHEAD, len(corners)) - 1, index, -1)
            index = next((one for one in ahead if self.is_clear(at, corners[one])), index)
            at = corners[index]
            path.append(at)
            index += 1
        return path

    def reaches(self, place: Place) -> bool:
        """Whether the robot may be there."""
        row, column = self.lattice.cell(*place)
        return self.straight or bool(self._free[row, column])

    def _number(self, place: Place | Point) -> int:
        lattice = self.lattice
        column = int((place[0] - lattice.origin[0]) / lattice.cell_m)
        row = int((place[1] - lattice.origin[1]) / lattice.cell_m)
        column = min(max(column, 0), lattice.columns - 1)
        return self._reached[min(max(row, 0), lattice.rows - 1) * lattice.columns + column]

    def _middle(self, number: int) -> Place:
        row, column = divmod(number, self.lattice.columns)
        x, y = self.lattice.middle(row, column)
        return float(x), float(y)

    def _field(self, goal: int) -> tuple[Array, Index]:
        """Lengths to a cell, and the next cell on the path from each."""
        if goal not in self._fields:
            lengths, before = dijkstra(
                self._graph, directed=False, indices=goal, return_predecessors=True
            )
            self._fields[goal] = (lengths.astype(np.float32), before.astype(np.int32))
        return self._fields[goal]

    def _edges(self) -> csr_matrix:
        free, shape = self._free, self.lattice.shape
        number = np.arange(free.size).reshape(shape)
        ends, lengths = [], []
        for down, right in _STEPS:
            low, high = slice(0, shape[0] - down), slice(down, shape[0])
            left, width = max(-right, 0), shape[1] - abs(right)
            here, there = slice(left, left + width), slice(left + right, left + right + width)
            both = free[low, here] & free[high, there]
            if down and right:  # past no corner
                both &= free[high, here] & free[low, there]
            ends.append(np.column_stack([number[low, here][both], number[high, there][both]]))
            lengths.append(np.full(len(ends[-1]), math.hypot(down, right) * self.lattice.cell_m))
        pairs, length = np.concatenate(ends), np.concatenate(lengths)
        return csr_matrix((length, (pairs[:, 0], pairs[:, 1])), shape=(free.size, free.size))


def _corners(places: list[Place]) -> list[Place]:
    """The places at which a path turns, and its end."""
    kept: list[Place] = []
    for index, place in enumerate(places[:-1]):
        before = places[index - 1] if index else None
        after = places[index + 1]
        if before is None or not _is_straight(before, place, after):
            kept.append(place)
    return kept + places[-1:]


def _is_straight(one: Place, middle: Place, other: Place) -> bool:
    turn = (middle[0] - one[0]) * (other[1] - one[1]) - (middle[1] - one[1]) * (other[0] - one[0])
    return abs(turn) < 1e-9


def shortened(start: Place, path: list[Place], by_m: float) -> list[Place]:
    """A path that ends earlier by a length [m]; empty: there is nothing left of it."""
    corners, left = [start, *path], by_m
    while left > 0.0 and len(corners) > 1:
        before, end = corners[-2:]
        length = math.dist(before, end)
        if length > left:
            share = 1.0 - left / length
            x, y = (a + share * (b - a) for a, b in zip(before, end, strict=True))
            return [*corners[1:-1], (x, y)]
        left -= length
        corners.pop()
    return corners[1:]
