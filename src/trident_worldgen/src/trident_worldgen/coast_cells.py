# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A coast in cells: what stands where, where it is steep, and what is next to what."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from trident_worldgen.coast_parts import Rectangle
from trident_worldgen.noise import Field
from trident_worldgen.terrain import Terrain

CELL_M = 2.0

Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class Post:
    """Something round that stands or floats: a trunk, a rock, a buoy; sizes in m."""

    x: float
    y: float
    radius: float


@dataclass(frozen=True)
class Area:
    """The coast that is searched.

    Attributes:
        ground: with its size.
        front_y: of the quay [m].
        level: of the quay above the still water [m].
        posts: that are there whatever grows.
    """

    ground: Terrain
    front_y: float
    level: float
    posts: Sequence[Post] = ()


def slopes(ground: Terrain, x: Field, y: Field) -> Field:
    """The steepest rise within each cell, m per m."""
    half = CELL_M / 2
    along = ground.heights(x + half, y) - ground.heights(x - half, y)
    across = ground.heights(x, y + half) - ground.heights(x, y - half)
    return np.asarray(np.hypot(along, across) / CELL_M)


def within(rectangles: dict[str, Rectangle], x: Field, y: Field, more: float) -> Mask:
    """Cells whose middle lies in one of them, or within `more` of one [m]."""
    inside = np.zeros((y.shape[0], x.shape[1]), dtype=bool)
    for one in rectangles.values():
        along = np.abs(x - one.x) <= one.length / 2 + more
        inside |= along & (np.abs(y - one.y) <= one.width / 2 + more)
    return inside


def touched(posts: Sequence[Post], x: Field, y: Field, more: float) -> Mask:
    """Cells in which something stands, or which it comes nearer than `more` [m]."""
    touched = np.zeros((y.shape[0], x.shape[1]), dtype=bool)
    for post in posts:
        columns = np.flatnonzero(np.abs(x[0] - post.x) <= CELL_M / 2 + post.radius + more)
        rows = np.flatnonzero(np.abs(y[:, 0] - post.y) <= CELL_M / 2 + post.radius + more)
        touched[np.ix_(rows, columns)] = True
    return touched


def eroded(allowed: Mask) -> Mask:
    """The cells whose neighbors are allowed, too."""
    return np.asarray(ndimage.binary_erosion(allowed, np.ones((3, 3)), border_value=0))
