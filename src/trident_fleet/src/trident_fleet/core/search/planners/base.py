# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Coverage planners: the problem that they solve, and what they share."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from scipy.ndimage import label
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import dijkstra

from trident_fleet.core.search.area import Array, Index, Mask, SearchError

Cell = tuple[int, int]

STEPS: tuple[Cell, ...] = ((0, 1), (1, 0), (0, -1), (-1, 0))
"""To the neighbors of a cell: east, north, west, south, as row and column."""


@dataclass(frozen=True)
class CoverageProblem:
    """Cells that are to be covered, each as wide as what the robot sees at once.

    Attributes:
        free: cells that the robot may be in, shape (rows, columns).
        start: cell in which it is.
        gain: what is to be gained in each cell, from 0; None: the same in all.
    """

    free: Mask
    start: Cell
    gain: Array | None = None

    def __post_init__(self) -> None:
        """Refuse what cannot be planned.

        Raises:
            SearchError: names field, value and legal range.
        """
        if self.free.ndim != 2 or not self.free.size:
            raise SearchError(f"coverage: free has shape {self.free.shape}, legal: (rows, columns)")
        if not self._starts_free():
            raise SearchError(f"coverage: start is {self.start}, legal: a free cell")
        if self.gain is not None and self.gain.shape != self.free.shape:
            raise SearchError(
                f"coverage: gain has shape {self.gain.shape}, legal: {self.free.shape}"
            )

    def _starts_free(self) -> bool:
        row, column = self.start
        inside = 0 <= row < self.free.shape[0] and 0 <= column < self.free.shape[1]
        return inside and bool(self.free[row, column])

    @cached_property
    def reachable(self) -> Mask:
        """Free cells that are connected with the start, side by side."""
        labels, _ = label(self.free)
        return np.asarray(labels == labels[self.start])

    @cached_property
    def number(self) -> Index:
        """Of each reachable cell, row by row; -1 for the others."""
        number = np.full(self.free.shape, -1)
        number[self.reachable] = np.arange(int(self.reachable.sum()))
        return number

    @cached_property
    def cells(self) -> Index:
        """Row and column of the reachable cells, shape (N, 2)."""
        return np.argwhere(self.reachable)

    @cached_property
    def graph(self) -> csr_matrix:
        """Steps between reachable cells that are neighbors."""
        number = self.number
        pairs = []
        for one, other in ((number[:, :-1], number[:, 1:]), (number[:-1], number[1:])):
            both = (one >= 0) & (other >= 0)
            pairs.append(np.column_stack([one[both], other[both]]))
        edges = np.concatenate(pairs)
        edges = np.concatenate([edges, edges[:, ::-1]])
        count = len(self.cells)
        return csr_matrix((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=(count, count))

    def distances(self, cells: Iterable[Cell]) -> tuple[Array, Index]:
        """Steps from cells to all reachable ones, and the cells before them on the path.

        Returns:
            By number, shapes (len(cells), N).
        """
        sources = [int(self.number[cell]) for cell in cells]
        steps, before = dijkstra(
            self.graph, indices=sources, unweighted=True, return_predecessors=True
        )
        return steps, before

    def path(self, before: Index, goal: int) -> list[Cell]:
        """Cells from the source, which is left out, to the goal, by a row of `distances`."""
        numbers = []
        while before[goal] >= 0:
            numbers.append(goal)
            goal = int(before[goal])
        return [(int(row), int(column)) for row, column in self.cells[numbers[::-1]]]


class CoveragePlanner(Protocol):
    """A planner of paths that cover an area.

    Attributes:
        name: by which users choose it.
    """

    name: str

    def plan(self, problem: CoverageProblem) -> list[Cell]:
        """A path from the start, cell by neighbor cell, that visits all reachable cells."""
        ...


def walk(problem: CoverageProblem, order: Iterable[Cell]) -> list[Cell]:
    """The path that visits cells in an order, past those that it has come through already."""
    path = [problem.start]
    visited = {problem.start}
    for cell in order:
        if cell in visited:
            continue
        if _are_neighbors(path[-1], cell):
            leg = [cell]
        else:
            _, before = problem.distances([path[-1]])
            leg = problem.path(before[0], int(problem.number[cell]))
        path += leg
        visited.update(leg)
    return path


def _are_neighbors(one: Cell, other: Cell) -> bool:
    return abs(one[0] - other[0]) + abs(one[1] - other[1]) == 1


def lower_bound(problem: CoverageProblem) -> int:
    """Steps that every path needs which visits all reachable cells."""
    return len(problem.cells) - 1
