# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Polygons for tests of fences."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import strategies as st
from trident_fleet.core.quintic import Array
from trident_fleet.core.station.fence import Fence

U_SHAPE = np.array(
    [[0, 0], [100, 0], [100, 100], [60, 100], [60, 40], [40, 40], [40, 100], [0, 100]], dtype=float
)


def star(radii: list[float]) -> Array:
    """Corners around the origin, one at each of equal angles [m], shape (K, 2)."""
    angles = np.arange(len(radii)) * (2.0 * math.pi / len(radii))
    return np.array(radii)[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])


def fences() -> st.SearchStrategy[Fence]:
    """Stars of 3 to 9 corners, from 20 m to 30 m high; the origin lies in all of them."""
    radii = st.lists(st.floats(6.0, 50.0), min_size=3, max_size=9)
    return radii.map(lambda found: Fence(star(found), 20.0, 30.0))
