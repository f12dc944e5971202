# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""To where most is gained per step, again and again."""

from __future__ import annotations

import numpy as np

from trident_fleet.core.search.area import Array, Index
from trident_fleet.core.search.planners.base import Cell, CoverageProblem

_HORIZON = 40  # steps ahead that are weighed, while something is to be gained within
_COMMITTED = 6  # steps that are gone before it is weighed again


class Probabilistic:
    """Greatest gain per step over a horizon, along shortest paths.

    Of all cells within the horizon it goes to the one whose path gains most per step, and weighs
    again after a few steps (a receding horizon as in P. Lanillos and others, "Minimum time search
    in uncertain dynamic domains with complex sensorial platforms", Sensors 14(8), 2014).
    """

    name = "probabilistic"

    def plan(self, problem: CoverageProblem) -> list[Cell]:
        """A path from the start, cell by neighbor cell, that visits all reachable cells."""
        gain = np.ones(problem.free.shape) if problem.gain is None else problem.gain
        left = gain.astype(float)[problem.reachable]
        # What gains nothing comes last, but it comes.
        left = left + 1e-6 * max(float(left.max(initial=0.0)), 1e-9)
        path = [problem.start]
        left[problem.number[problem.start]] = 0.0
        while left.any():
            leg = best_leg(problem, path[-1], left, _HORIZON)
            for cell in leg[:_COMMITTED]:
                left[problem.number[cell]] = 0.0
                path.append(cell)
        return path


def best_leg(
    problem: CoverageProblem, start: Cell, left: Array, horizon: int | float
) -> list[Cell]:
    """The path that gains most per step.

    Args:
        problem: the cells.
        start: where it begins; the cell is not in the path.
        left: what is to be gained by number of the cell, shape (N,).
        horizon: steps that are weighed; without any gain within, all are.

    Returns:
        Cells, ending in one that gains something; empty: nothing is to be gained.
    """
    steps, before = problem.distances([start])
    gained = _along(steps[0], before[0], left)
    rate = np.where((steps[0] > 0.0) & (left > 0.0), gained / np.maximum(steps[0], 1.0), 0.0)
    near = np.where(steps[0] <= horizon, rate, 0.0)
    rate = near if near.any() else rate
    if not rate.any():
        return []
    return problem.path(before[0], int(np.argmax(rate)))


def _along(steps: Array, before: Index, left: Array) -> Array:
    """What the shortest path to each cell gains, by doubling of jumps along it."""
    count = len(left)
    gained = np.append(left, 0.0)
    jump = np.append(np.where(before >= 0, before, count), count)
    length = 1
    while length <= steps.max(initial=1.0):
        gained, jump = gained + gained[jump], jump[jump]
        length *= 2
    return np.asarray(gained[:count])
