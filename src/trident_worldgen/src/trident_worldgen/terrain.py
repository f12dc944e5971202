# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Hills that a seed decides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PIL import Image

from trident_worldgen.noise import Field, grain, png

SAMPLES = 129
"""Along each side; one of Gazebo's sizes, 2^n + 1."""

_WHITE = 65535
_OCTAVES = ((3, 1.0), (7, 0.35), (19, 0.08))  # hills along a side, and their share of the height


@dataclass(frozen=True)
class Terrain:
    """Heights on a grid, about (0, 0).

    Attributes:
        pixels: of the picture, 0 to 65535, row 0 at the largest y, shape (n, n).
        length: along x [m].
        width: along y [m].
        lowest: height of black [m].
        relief: height of the brightest pixel over that [m].
    """

    pixels: Field
    length: float
    width: float
    lowest: float
    relief: float

    def height(self, x: float, y: float) -> float:
        """Of the surface at a place within [m]: of the very triangle of the heightmap."""
        return float(self.heights(np.array(x), np.array(y)))

    def heights(self, x: Field, y: Field) -> Field:
        """Of the surface at places within [m], of shapes that go together."""
        last = len(self.pixels) - 1
        right = np.clip((x / self.length + 0.5) * last, 0.0, last)
        down = np.clip((0.5 - y / self.width) * last, 0.0, last)
        column, row = (np.minimum(place.astype(int), last - 1) for place in (right, down))
        u, v = right - column, down - row
        # Cells are cut from the upper right to the lower left corner.
        a, b = self.pixels[row, column], self.pixels[row, column + 1]
        c, d = self.pixels[row + 1, column], self.pixels[row + 1, column + 1]
        upper = a + u * (b - a) + v * (c - a)
        lower = d + (1.0 - u) * (c - d) + (1.0 - v) * (b - d)
        level = np.where(u + v <= 1.0, upper, lower)
        return np.asarray(self.lowest + self.relief * level / _WHITE)

    def picture(self) -> bytes:
        """As a PNG file of 16 bit."""
        return png(Image.fromarray(self.pixels.astype(np.uint16)))


def hills(
    random: np.random.Generator, length: float, width: float, relief: float, clearing: float
) -> Terrain:
    """Smooth hills about a level clearing at height 0.

    Args:
        random: decides them.
        length: along x [m].
        width: along y [m].
        relief: between the lowest and the highest place, about [m].
        clearing: radius of what is level [m]; at twice that the hills have their height.
    """
    field = sum(share * (grain(random, SAMPLES, cells) - 0.5) for cells, share in _OCTAVES)
    assert isinstance(field, np.ndarray)
    field *= relief / float(np.ptp(field))
    x = np.linspace(-length / 2, length / 2, SAMPLES)
    y = np.linspace(width / 2, -width / 2, SAMPLES)
    away = np.clip(np.hypot(x, y[:, None]) / clearing - 1.0, 0.0, 1.0)
    field *= away * away * (3.0 - 2.0 * away)
    return terrain_of(field, length, width)


def terrain_of(heights: Field, length: float, width: float) -> Terrain:
    """The terrain of a field of heights [m], row 0 at the largest y, shape (n, n).

    Args:
        heights: of the surface.
        length: along x [m].
        width: along y [m].
    """
    lowest = round(float(heights.min()), 4)
    relief = max(round(float(heights.max()) - lowest, 4), 1e-3)
    pixels = np.round((heights - lowest) / relief * _WHITE).clip(0, _WHITE)
    # A heightmap's size is that of its brightest pixel.
    pixels[np.unravel_index(np.argmax(pixels), pixels.shape)] = _WHITE
    return Terrain(pixels, length, width, lowest, relief)
