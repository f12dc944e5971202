# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The area of a search as a grid: geometry of its cells, and what is known of each."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trident_fleet.core.errors import FormationError

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]
Index = npt.NDArray[np.intp]


class SearchError(FormationError):
    """Bad input about a search: the message names what it is of, field, value and what is legal."""


@dataclass(frozen=True)
class Lattice:
    """Square cells; row 0 has the smallest y, column 0 the smallest x.

    Attributes:
        rows: along y.
        columns: along x.
        cell_m: side of a cell [m].
        origin: outer corner of the cell (0, 0), p_common [m].
    """

    rows: int
    columns: int
    cell_m: float
    origin: tuple[float, float]

    def __post_init__(self) -> None:
        """Refuse what is no grid.

        Raises:
            SearchError: names field, value and legal range.
        """
        if self.rows < 1 or self.columns < 1:
            raise SearchError(
                f"search grid: {self.rows} x {self.columns} cells, legal: 1 x 1 or more"
            )
        if not 0.0 < self.cell_m < math.inf:
            raise SearchError(f"search grid: cell_m is {self.cell_m}, legal: finite, above 0")

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)."""
        return self.rows, self.columns

    @property
    def size(self) -> tuple[float, float]:
        """Along x and y [m]."""
        return self.columns * self.cell_m, self.rows * self.cell_m

    def middle(self, row: Index | int, column: Index | int) -> tuple[Array, Array]:
        """Of cells, x and y, p_common [m]."""
        x = self.origin[0] + (np.asarray(column) + 0.5) * self.cell_m
        y = self.origin[1] + (np.asarray(row) + 0.5) * self.cell_m
        return x, y

    def cell(self, x: Array | float, y: Array | float) -> tuple[Index, Index]:
        """Row and column of the cells that have these places; of the nearest cell, if none has."""
        column = np.floor((np.asarray(x) - self.origin[0]) / self.cell_m).astype(np.intp)
        row = np.floor((np.asarray(y) - self.origin[1]) / self.cell_m).astype(np.intp)
        # Array.clip of numpy 1.24 takes ten times as long for few places.
        return (
            np.minimum(np.maximum(row, 0), self.rows - 1),
            np.minimum(np.maximum(column, 0), self.columns - 1),
        )

    def has(self, x: Array | float, y: Array | float) -> Mask:
        """Whether places lie on the grid."""
        along, across = np.asarray(x) - self.origin[0], np.asarray(y) - self.origin[1]
        length, width = self.size
        return np.asarray((along >= 0.0) & (along < length) & (across >= 0.0) & (across < width))

    def check(self, values: npt.NDArray[np.generic], name: str) -> None:
        """Refuse values of another grid.

        Raises:
            SearchError: names them, their shape and the legal one.
        """
        if values.shape != self.shape:
            raise SearchError(f"{name}: shape is {values.shape}, legal: {self.shape}, the grid's")


@dataclass(frozen=True)
class SearchArea:
    """What is known of the area before a search; all of shape (rows, columns).

    Attributes:
        lattice: the cells.
        land: dry cells; the others are water.
        covered: cells below roofs and trees, which are not seen from above.
        ground: cells that a ground robot gets to.
        water: cells that a boat gets to.
        heights: of the ground and of what is built on it, above the still water [m].
    """

    lattice: Lattice
    land: Mask
    covered: Mask
    ground: Mask
    water: Mask
    heights: Array

    def __post_init__(self) -> None:
        """Refuse layers of another shape.

        Raises:
            SearchError: names the layer, its shape and the legal one.
        """
        for name in ("land", "covered", "ground", "water", "heights"):
            self.lattice.check(getattr(self, name), f"search area: {name}")

    def reach(self, domain: str) -> Mask:
        """Cells that a robot which moves in `air`, on `ground` or in `water` gets to."""
        if domain == "air":
            return np.ones(self.lattice.shape, dtype=bool)
        return self.ground if domain == "ground" else self.water
