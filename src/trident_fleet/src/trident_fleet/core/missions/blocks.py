# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The area in blocks that a robot sees at once, for searching where most is gained."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trident_fleet.core.missions.kinds import Kind
from trident_fleet.core.missions.routes import Routes
from trident_fleet.core.missions.scene import Place
from trident_fleet.core.search.area import Array, Mask, SearchArea
from trident_fleet.core.search.planners.base import CoverageProblem
from trident_fleet.core.search.planners.probabilistic import best_leg

_HORIZON = 40  # blocks


@dataclass(frozen=True)
class Blocks:
    """Squares of cells.

    Attributes:
        area: that is searched.
        side: of a block, in cells.
        free: blocks in which the robot gets to some cell, shape (rows, columns).
    """

    area: SearchArea
    side: int
    free: Mask

    @staticmethod
    def of(area: SearchArea, kind: Kind) -> Blocks:
        """Blocks as wide as the range of a kind's sensor."""
        side = max(round(kind.sensor.range_m / area.lattice.cell_m), 1)
        return Blocks(area, side, _summed(area.reach(kind.domain), side) > 0.0)

    def path(self, place: Place, need: Array, routes: Routes) -> list[Place]:
        """Corners of the path that gains most per block; empty: nothing is to be gained.

        Args:
            place: where the robot is, p_common [m].
            need: what is to be gained in each cell, shape (rows, columns).
            routes: of the robot's kind.
        """
        row, column = (int(value) // self.side for value in self.area.lattice.cell(*place))
        free = self.free.copy()
        free[row, column] = True
        problem = CoverageProblem(free, (row, column))
        left = _summed(need, self.side)[problem.reachable]
        left[problem.number[problem.start]] = 0.0
        corners = [self._middle(*cell) for cell in best_leg(problem, (row, column), left, _HORIZON)]
        path: list[Place] = []
        for corner in corners:
            path += routes.path(path[-1] if path else place, corner)
        return path

    def _middle(self, row: int, column: int) -> Place:
        lattice = self.area.lattice
        low, left = row * self.side, column * self.side
        high = min(low + self.side, lattice.rows)
        right = min(left + self.side, lattice.columns)
        x = lattice.origin[0] + 0.5 * (left + right) * lattice.cell_m
        y = lattice.origin[1] + 0.5 * (low + high) * lattice.cell_m
        return x, y


def _summed(values: Array | Mask, side: int) -> Array:
    rows, columns = np.arange(0, values.shape[0], side), np.arange(0, values.shape[1], side)
    return np.add.reduceat(np.add.reduceat(values.astype(float), rows, axis=0), columns, axis=1)
