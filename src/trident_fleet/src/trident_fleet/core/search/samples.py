# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Random maps and teams, by seed, on which planners and shares are tested and measured."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import label

from trident_fleet.core.search.area import Mask
from trident_fleet.core.search.planners.base import CoverageProblem
from trident_fleet.core.search.shares import Searcher


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


def of_three_kinds(seed: int) -> list[Searcher]:
    """From one base: one gets everywhere, one stays on land, one on water."""
    land, base = shore(seed)
    random = np.random.default_rng(seed)
    parts = {"uav": np.ones_like(land), "ugv": land, "usv": ~land}
    robots = []
    for name, cells in parts.items():
        near = np.argwhere(cells)
        row, column = near[np.abs(near - base).sum(axis=1).argmin()]
        seconds = 1.0 if name == "uav" else 1.0 / random.uniform(0.25, 0.7)
        robots.append(Searcher(name, (int(row), int(column)), np.where(cells, seconds, np.inf)))
    return robots
