# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Along the border, then along what has been visited, inwards; from dead ends to what is nearest.

Source: E. González, P. Aristizábal, M. Alarcón, Backtracking spiral algorithm, ICRA 2005.
"""

from __future__ import annotations

import numpy as np

from trident_fleet.core.search.area import Mask
from trident_fleet.core.search.planners.base import STEPS, Cell, CoverageProblem

# East, north, west, south turn left: to the right first, then ahead, left, and back.
_TURNS = (3, 0, 1, 2)


class Spiral:
    """Keeps what has been visited, or the border, on its right hand."""

    name = "spiral"

    def plan(self, problem: CoverageProblem) -> list[Cell]:
        """A path from the start, cell by neighbor cell, that visits all reachable cells."""
        open_cells = problem.reachable.copy()
        path, heading = [problem.start], 0
        open_cells[problem.start] = False
        while open_cells.any():
            turned = next(
                (
                    (heading + turn) % 4
                    for turn in _TURNS
                    if _is_open(open_cells, path[-1], (heading + turn) % 4)
                ),
                None,
            )
            if turned is None:
                path += _to_nearest(problem, path[-1], open_cells)
            else:
                heading = turned
                path.append(_step(path[-1], heading))
            open_cells[path[-1]] = False
        return path


def _step(cell: Cell, heading: int) -> Cell:
    return cell[0] + STEPS[heading][0], cell[1] + STEPS[heading][1]


def _is_open(open_cells: Mask, cell: Cell, heading: int) -> bool:
    row, column = _step(cell, heading)
    inside = 0 <= row < open_cells.shape[0] and 0 <= column < open_cells.shape[1]
    return bool(inside and open_cells[row, column])


def _to_nearest(problem: CoverageProblem, cell: Cell, open_cells: Mask) -> list[Cell]:
    steps, before = problem.distances([cell])
    waiting = problem.number[open_cells]
    return problem.path(before[0], int(waiting[np.argmin(steps[0][waiting])]))
