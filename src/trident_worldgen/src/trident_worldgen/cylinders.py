# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Fields of cylinders for a small ground robot, in the form of the BARN data set.

A cellular automaton grows clusters on a grid of 0.15 m, and their outer cells become cylinders
(Perille, Truong, Xiao, Stone, "Benchmarking Metric Ground Navigation", SSRR 2020).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import ndimage
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

from trident_sim import Error
from trident_worldgen.checks import require, require_seed
from trident_worldgen.sdf import Color, Files, StaticModel, world_text

Cells = npt.NDArray[np.bool_]
Point = tuple[float, float]

CELL_M = 0.15
RADIUS_M = 0.075
_HEIGHT_M = 0.5  # above ground; the cylinders' middles lie at z = 0
_COLUMNS, _ROWS = 30, 30  # of the field
_ENTRY_ROWS = 34  # of free ground before it, the row behind the start included
_FIRST = (-4.425, 0.075)  # middle of the cell of column and row 0 [m]
START: Point = (-2.25, 3.0)
GOAL: Point = (-2.25, 13.0)
_FILLS = 5  # filled neighbors that fill a cell
_CLEARS = 1  # no more filled neighbors than that clear a cell
_TRIES = 200


@dataclass(frozen=True)
class CylindersConfig:
    """How dense a field is.

    Attributes:
        seed: decides the clusters, and is the world's number.
        least_fill: share of cells that are filled at first, at least.
        greatest_fill: at most.
        clearance: that a path to the goal leaves to the cylinders' surfaces [m].
    """

    seed: int = 1
    least_fill: float = 0.15
    greatest_fill: float = 0.25
    clearance: float = 0.225

    def validate(self) -> None:
        """Raises Error naming the field, its value and what is legal."""
        require_seed(self.seed)
        require("least_fill", self.least_fill, 0.0, 0.35, "")
        require("greatest_fill", self.greatest_fill, self.least_fill, 0.35, "")
        require("clearance", self.clearance, 0.0, 0.5)


def cylinders(config: CylindersConfig | None = None) -> Files:
    """`world_SEED.world`, its obstacles, and a path through them, as tables.

    Raises:
        Error: an illegal configuration, or so dense a field that no path was found.
    """
    config = config or CylindersConfig()
    config.validate()
    random = np.random.default_rng([config.seed, 0xBA12])
    for _ in range(_TRIES):
        filled = _field(random, config)
        path = _path(filled, config.clearance)
        if path is not None:
            return _files(config, _places(filled), path)
    raise Error(f"cylinders: {_TRIES} fields had no path through, legal: a lower fill or clearance")


def _field(random: np.random.Generator, config: CylindersConfig) -> Cells:
    """Shape (rows, columns): cells that hold something after a few rounds of the automaton."""
    share = random.uniform(config.least_fill, config.greatest_fill)
    filled = random.random((_ROWS, _COLUMNS)) < share
    kernel = np.array([[1, 1, 1], [1, 0, 1], [1, 1, 1]])
    for _ in range(int(random.integers(1, 4))):
        # What lies left and right of the field counts as filled, before and after it as free.
        padded = np.pad(np.pad(filled, ((0, 0), (1, 1)), constant_values=True), ((1, 1), (0, 0)))
        count = ndimage.convolve(padded.astype(int), kernel, mode="constant")[1:-1, 1:-1]
        filled = (filled | (count >= _FILLS)) & (count > _CLEARS)
    filled[:, [0, -1]] = True
    return filled


def _all_rows(filled: Cells) -> Cells:
    """The field behind the free ground with its fence."""
    cells = np.zeros((_ENTRY_ROWS + _ROWS, _COLUMNS), dtype=bool)
    cells[_ENTRY_ROWS:] = filled
    cells[:, [0, -1]] = True
    cells[0] = True
    return cells


def _middle(row: int, column: int) -> Point:
    return (_FIRST[0] + CELL_M * column, _FIRST[1] + CELL_M * row)


def _places(filled: Cells) -> list[Point]:
    """Middles of the cells that can be seen: those within a cluster are left out."""
    cells = _all_rows(filled)
    inner = ndimage.binary_erosion(cells, np.ones((3, 3)), border_value=0)
    return [_middle(int(row), int(column)) for row, column in np.argwhere(cells & ~inner)]


def _path(filled: Cells, clearance_m: float) -> list[Point] | None:
    """The shortest path over cells with room from start to goal; None: no such path exists."""
    room_m = ndimage.distance_transform_edt(~_all_rows(filled)) * CELL_M - RADIUS_M
    rows, columns = np.nonzero(room_m[_ENTRY_ROWS:] >= clearance_m - 1e-9)
    places = [_middle(_ENTRY_ROWS + int(r), int(c)) for r, c in zip(rows, columns, strict=True)]
    first, last = np.flatnonzero(rows == 0), np.flatnonzero(rows == _ROWS - 1)
    if not len(first) or not len(last):
        return None
    graph = _graph(rows, columns, places, first, last)
    lengths, before = dijkstra(graph, indices=len(places), return_predecessors=True)
    if not np.isfinite(lengths[-1]):
        return None
    path, at = [], int(before[-1])
    while at < len(places):
        path.append(places[at])
        at = int(before[at])
    return [START, *reversed(path), GOAL]


def _graph(
    rows: npt.NDArray[np.intp],
    columns: npt.NDArray[np.intp],
    places: list[Point],
    first: npt.NDArray[np.intp],
    last: npt.NDArray[np.intp],
) -> coo_matrix:
    """Steps between neighbors; the last two nodes are the start and the goal."""
    index = np.full((_ROWS + 2, _COLUMNS + 2), -1)
    index[rows + 1, columns + 1] = np.arange(len(rows))
    edges = []
    for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
        other = index[rows + 1 + down, columns + 1 + right]
        has = np.flatnonzero(other >= 0)
        length = CELL_M * np.hypot(down, right)
        edges.append((has, other[has], np.full(len(has), length)))
    points = np.array(places)
    for ends, node, point in ((first, 0, START), (last, 1, GOAL)):
        lengths = np.linalg.norm(points[ends] - point, axis=1)
        edges.append((np.full(len(ends), len(places) + node), ends, lengths))
    a, b, length = (np.concatenate(part) for part in zip(*edges, strict=True))
    size = len(places) + 2
    both = (np.concatenate((a, b)), np.concatenate((b, a)))
    return coo_matrix((np.concatenate((length, length)), both), shape=(size, size)).tocsr()


def _files(config: CylindersConfig, places: list[Point], path: list[Point]) -> Files:
    model = StaticModel("cylinders")
    look = Color((0.15, 0.38, 0.72))
    for number, (x, y) in enumerate(places):
        model.cylinder(f"cylinder_{number}", RADIUS_M, 2.0 * _HEIGHT_M, (x, y, 0.0), look)
    comment = (
        f"A field of cylinders for robots of half a meter, with a start at {START} and a goal at "
        f"{GOAL}. Made by ./trident worldgen cylinders, seed {config.seed}"
    )
    name = f"world_{config.seed}"
    obstacles = "".join(f"{x:.3f},{y:.3f},{RADIUS_M:.3f}\n" for x, y in places)
    return {
        f"{name}.world": world_text(comment, [model]),
        f"{name}.obstacles.csv": "x_m,y_m,radius_m\n" + obstacles,
        f"{name}.path.csv": "x_m,y_m\n" + "".join(f"{x:.3f},{y:.3f}\n" for x, y in path),
    }
