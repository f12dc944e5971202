# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of noise."""

from __future__ import annotations

import io

import numpy as np
import numpy.typing as npt
from PIL import Image

Field = npt.NDArray[np.float64]


def grain(random: np.random.Generator, size: int, cells: int) -> Field:
    """Smooth noise in [0, 1] that repeats at its edges, shape (size, size)."""
    coarse = random.uniform(size=(cells, cells))
    at = np.arange(size) * cells / size
    low = at.astype(int)
    part = at - low
    part = part * part * (3.0 - 2.0 * part)
    high = (low + 1) % cells
    rows = coarse[low] * (1 - part)[:, None] + coarse[high] * part[:, None]
    result: Field = rows[:, low] * (1 - part) + rows[:, high] * part
    return result


def png(image: Image.Image) -> bytes:
    """As a PNG file."""
    out = io.BytesIO()
    image.save(out, "PNG", optimize=True)
    return out.getvalue()
