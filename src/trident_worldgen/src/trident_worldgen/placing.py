# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Places that a seed picks, away from each other."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

Range = tuple[float, float]


def free_place(
    random: np.random.Generator,
    x_range: Range,
    y_range: Range,
    is_free: Callable[[float, float], bool],
    tries: int,
) -> tuple[float, float] | None:
    """The first of some places in a rectangle that is free; None: none of them is.

    Called again and again, with what it gave as taken, it samples Poisson discs by throwing darts.

    Args:
        random: gives the places.
        x_range: least and greatest x [m].
        y_range: least and greatest y [m].
        is_free: whether a place x, y [m] will do.
        tries: how many.
    """
    for _ in range(tries):
        x, y = float(random.uniform(*x_range)), float(random.uniform(*y_range))
        if is_free(x, y):
            return x, y
    return None
