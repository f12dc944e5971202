# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Small coasts and random maps, by seed."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import label
from trident_fleet.core.search.area import Lattice, Mask, SearchArea
from trident_fleet.core.search.planners.base import CoverageProblem

LATTICE = Lattice(60, 80, 2.0, (-80.0, -60.0))


def coast(lattice: Lattice = LATTICE) -> SearchArea:
    """Water in the south, level land in the north with one covered square and one house."""
    land = np.zeros(lattice.shape, dtype=bool)
    land[lattice.rows // 2 :] = True
    covered = np.zeros_like(land)
    covered[lattice.rows // 2 + 10 : lattice.rows // 2 + 19, 10:19] = True
    heights = np.where(land, 1.5, -8.0)
    house = np.zeros_like(land)
    house[lattice.rows // 2 + 10 : lattice.rows // 2 + 15, 40:46] = True
    heights[house] = 7.0
    return SearchArea(lattice, land, covered, land & ~house, ~land, heights)


def random_map(seed: int) -> CoverageProblem:
    """Rectangles and discs in a field of 16 to 39 cells; the start lies in its largest part."""
    random = np.random.default_rng(seed)
    rows, columns = (int(side) for side in random.integers(16, 40, 2))
    free = np.ones((rows, columns), dtype=bool)
    down, right = np.mgrid[:rows, :columns]
    for _ in range(int(random.integers(2, 10))):
        row, column = random.integers(0, rows), random.integers(0, columns)
        if random.random() < 0.5:
            height, width = random.integers(2, 8, 2)
            free[row : row + height, column : column + width] = False
        else:
            reach = random.uniform(1.5, 4.5)
            free[(down - row) ** 2 + (right - column) ** 2 <= reach**2] = False
    labels, _ = label(free)
    cells = np.argwhere(labels == np.bincount(labels.ravel())[1:].argmax() + 1)
    row, column = cells[random.integers(len(cells))]
    return CoverageProblem(free, (int(row), int(column)))


def shore(seed: int) -> tuple[Mask, tuple[int, int]]:
    """Land with a wavy shore, and a base on it, as row and column."""
    random = np.random.default_rng(seed)
    rows, columns = (int(side) for side in random.integers(16, 30, 2))
    middle = int(rows * random.uniform(0.35, 0.65))
    land = np.zeros((rows, columns), dtype=bool)
    for column in range(columns):
        land[middle + int(2.0 * np.sin(column / 5.0 + seed)) :, column] = True
    return land, (middle, columns // 2)
