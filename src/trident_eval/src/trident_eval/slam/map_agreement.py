# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""How well a map agrees with the true one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import binary_dilation
from scipy.spatial import cKDTree

from trident_eval.core.errors import EvalError
from trident_eval.core.tracks import Array
from trident_eval.slam.grid import FREE, OCCUPIED, Grid, wall_thickness

_FIT_STEPS = 40
_FIRST_REACH_M, _LAST_REACH_M = 1.0, 0.15


@dataclass(frozen=True)
class Agreement:
    """A map laid over the true one.

    Attributes:
        T_truth_map: the motion that fits best, a 3 x 3 matrix.
        wall_error_m: distance of each occupied cell to the nearest true surface, shape (N,).
        surface_error_m: distance of each true surface cell near what was seen to the map's nearest
            occupied cell, shape (M,).
        wall_thickness_m: of the map.
        tolerance_m: within which a cell counts as right.
    """

    T_truth_map: Array
    wall_error_m: Array
    surface_error_m: Array
    wall_thickness_m: float
    tolerance_m: float

    def summary(self) -> dict[str, float]:
        """Shares within the tolerance, and distances."""
        return {
            "map_tolerance_m": self.tolerance_m,
            "map_precision": float(np.mean(self.wall_error_m <= self.tolerance_m)),
            "map_recall": float(np.mean(self.surface_error_m <= self.tolerance_m)),
            "map_wall_error_mean_m": float(self.wall_error_m.mean()),
            "map_wall_error_p95_m": float(np.percentile(self.wall_error_m, 95)),
            "wall_thickness_m": self.wall_thickness_m,
        }


def surfaces(grid: Grid) -> Array:
    """Centres of occupied cells next to free ones [m], shape (N, 2): what a lidar can see."""
    next_to_free = binary_dilation(grid.cells == FREE, np.ones((3, 3), bool))
    visible = np.where((grid.cells == OCCUPIED) & next_to_free, OCCUPIED, FREE).astype(np.int8)
    return Grid(visible, grid.resolution, grid.origin).centers(OCCUPIED)


def agreement(
    grid: Grid, truth: Grid, T_truth_map: Array | None = None, tolerance_m: float = 0.1
) -> Agreement:
    """Compare a map with the true one.

    Args:
        grid: the map.
        truth: the true map, e.g. of `./trident worldmap`.
        T_truth_map: where the map lies, roughly: a 3 x 3 matrix; None: at the same place. The rest,
            up to half a metre, is found by itself.
        tolerance_m: within which a cell counts as right.

    Raises:
        EvalError: one of them has nothing occupied, or they do not overlap.
    """
    walls, true_walls = grid.centers(OCCUPIED), surfaces(truth)
    if not len(walls) or not len(true_walls):
        raise EvalError(f"the {'map' if not len(walls) else 'true map'} has no occupied cell")
    T = fitted(walls, true_walls, np.eye(3) if T_truth_map is None else T_truth_map)
    placed = walls @ T[:2, :2].T + T[:2, 2]
    wall_error, _ = cKDTree(true_walls).query(placed)
    seen = np.concatenate([grid.centers(FREE), walls]) @ T[:2, :2].T + T[:2, 2]
    near, _ = cKDTree(seen).query(true_walls)
    near_truth = true_walls[near <= tolerance_m]
    if not len(near_truth):
        raise EvalError("the map and the true map do not overlap")
    surface_error, _ = cKDTree(placed).query(near_truth)
    return Agreement(T, wall_error, surface_error, wall_thickness(grid), tolerance_m)


def fitted(points: Array, target: Array, start: Array) -> Array:
    """The motion near `start` that brings points (N, 2) onto a target (M, 2): trimmed ICP."""
    tree = cKDTree(target)
    T = start.copy()
    for step in range(_FIT_STEPS):
        placed = points @ T[:2, :2].T + T[:2, 2]
        distance, index = tree.query(placed)
        reach = max(_LAST_REACH_M, _FIRST_REACH_M * 0.85**step)
        near = distance <= reach
        if near.sum() < 3:
            return T
        T = _motion(placed[near], target[index[near]]) @ T
    return T


def _motion(source: Array, target: Array) -> Array:
    a, b = source - source.mean(0), target - target.mean(0)
    angle = np.arctan2(np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]), np.sum(a * b))
    c, s = np.cos(angle), np.sin(angle)
    T = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    T[:2, 2] = target.mean(0) - T[:2, :2] @ source.mean(0)
    return T
