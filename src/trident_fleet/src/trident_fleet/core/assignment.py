# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Who goes where: the assignment of vehicles to places with the least total squared distance.

Source: Turpin, Michael, Kumar, CAPT: Concurrent assignment and planning of trajectories for
multiple robots, Int. J. Robotics Research 33(1), 2014. For two vehicles with relative position u at
the start and w at the goal, that assignment has u . w >= 0 (else swapping their goals would be
shorter). Flying straight and in step, they come no closer than where u and w are at right angles.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from trident_fleet.core.quintic import Array
from trident_fleet.core.separation import min_separation

# Costs are distinguished down to this [m^2]: rounding must not decide between equal distances.
_RESOLUTION_M2 = 1e-6


def assign(start: Array, places: Array) -> npt.NDArray[np.intp]:
    """Find the assignment (the Hungarian method's problem) with the least sum of |goal - start|^2.

    Where several are equal, vehicles take the places whose numbers are nearest to their own.

    Args:
        start: p_world of the vehicles [m], shape (N, 3).
        places: p_world of the places [m], shape (N, 3).

    Returns:
        The place of each vehicle, shape (N,).
    """
    count = len(start)
    cost = ((start[:, None] - places[None]) ** 2).sum(axis=-1)
    number = np.arange(count)
    apart = (number[:, None] - number[None]) ** 2 / count**3
    ticks = np.round(cost / _RESOLUTION_M2)
    _, place = cheapest_pairs(ticks + 0.5 * apart)
    return place


def cheapest_pairs(cost: Array) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.intp]]:
    """Pair rows and columns, as many as there are of the fewer, at the least total cost.

    Args:
        cost: finite, shape (N, M).

    Returns:
        Rows, growing, and their columns, two arrays of the length min(N, M).
    """
    # Imported here: nodes that fly a file do without.
    from scipy.optimize import linear_sum_assignment

    rows, columns = linear_sum_assignment(cost)
    return np.asarray(rows, dtype=np.intp), np.asarray(columns, dtype=np.intp)


def guaranteed_separation(start: Array, goal: Array) -> float:
    """Distance that an assigned transition keeps, flown straight and in step, whatever the points.

    With at least a between any two at the start and b at the goal: a b / sqrt(a^2 + b^2), the
    height of the right-angled triangle with these legs; for a = b the separation condition
    a > 2 sqrt(2) R of the source for vehicles of radius R.

    Args:
        start: p_world of the vehicles [m], shape (N, 3).
        goal: of the same vehicles, as assigned [m], shape (N, 3).

    Returns:
        The distance [m]; infinite for one vehicle.
    """
    a, b = min_separation(start[None]), min_separation(goal[None])
    if np.isinf(a):
        return a
    return float(a * b / np.hypot(a, b)) if a > 0.0 and b > 0.0 else 0.0
