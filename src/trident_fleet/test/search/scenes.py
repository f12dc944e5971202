# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A small coast."""

from __future__ import annotations

import numpy as np
from trident_fleet.core.search.area import Lattice, SearchArea

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
