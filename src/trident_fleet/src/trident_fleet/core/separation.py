# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""How close vehicles come to each other while they move in straight lines together."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from trident_fleet.core.quintic import Array


def pairs(count: int) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.intp]]:
    """Indices i < j of every pair of `count` vehicles, two arrays of equal length."""
    return np.triu_indices(count, k=1)


def pair_separations(points: Array) -> Array:
    """Smallest distance of each pair along a polyline that all fly in step.

    Between two points all vehicles move along straight lines in proportion, so the relative
    position of a pair is a segment, and its distance to the origin is exact.

    Args:
        points: positions [m], shape (M, N, 3), M >= 1.

    Returns:
        Distances [m], shape (pairs,), in the order of `pairs`.
    """
    i, j = pairs(points.shape[1])
    relative = points[:, i] - points[:, j]
    distances = np.sqrt((relative**2).sum(axis=-1)).min(axis=0)
    if len(points) == 1:
        return np.asarray(distances)
    start, along = relative[:-1], np.diff(relative, axis=0)
    length2 = (along**2).sum(axis=-1)
    # Where a pair does not move relative to each other, any fraction will do.
    fraction = -(start * along).sum(axis=-1) / np.where(length2 > 0.0, length2, 1.0)
    nearest = start + np.clip(fraction, 0.0, 1.0)[..., None] * along
    return np.asarray(np.minimum(distances, np.sqrt((nearest**2).sum(axis=-1)).min(axis=0)))


def min_separation(points: Array) -> float:
    """Smallest distance of any two vehicles along the polyline [m]; infinite for one vehicle."""
    distances = pair_separations(points)
    return float(distances.min()) if len(distances) else float("inf")
