# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Names of models, written into a picture."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import matplotlib
import numpy as np
from PIL import Image as Picture
from PIL import ImageDraw, ImageFont
from trident_eval.core.tracks import Array

from trident_viewer.framing import Lens, Sphere, Stand, place_labels, project

_FONT = "fonts/ttf/DejaVuSans.ttf"
_SMALLEST_PX, _BY_WIDTH = 11, 70
_GAP_PX = 4
_PAPER = (255, 255, 255, 170)
_INK = {True: (20, 20, 20, 255), False: (95, 95, 95, 255)}


def _tops(stand: Stand, lens: Lens, spheres: Sequence[Sphere]) -> Array:
    """Where names belong [pixels], shape (N, 2); -1: not in the picture."""
    tops = np.array([s.center for s in spheres], dtype=float)
    tops[:, 2] += [s.radius_m if s.moves else 0.0 for s in spheres]
    pixels, ahead = project(stand, lens, tops)
    pixels[ahead <= 0.0] = -1.0
    return pixels


def write_names(
    picture: Picture.Image, stand: Stand, lens: Lens, spheres: Sequence[Sphere]
) -> list[str]:
    """Write the name of each model above it.

    Args:
        picture: what the camera saw; written on.
        stand: of the camera.
        lens: of the camera.
        spheres: models, by importance: where there is no room the last ones stay unnamed.

    Returns:
        The names that are in the picture.
    """
    if not spheres:
        return []
    pixels = _tops(stand, lens, spheres)
    size = max(_SMALLEST_PX, lens.width // _BY_WIDTH)
    font = ImageFont.truetype(str(Path(matplotlib.get_data_path()) / _FONT), size)
    boxes = [font.getbbox(s.name) for s in spheres]
    sizes = [(int(box[2]) + 2 * _GAP_PX, int(box[3]) + 2 * _GAP_PX) for box in boxes]
    draw = ImageDraw.Draw(picture, "RGBA")
    written = []
    for sphere, extent, place in zip(
        spheres, sizes, place_labels(pixels, sizes, lens), strict=True
    ):
        if place is not None:
            left, top = place
            draw.rectangle((left, top, left + extent[0], top + extent[1]), fill=_PAPER)
            draw.text((left + _GAP_PX, top + _GAP_PX), sphere.name, _INK[sphere.moves], font)
            written.append(sphere.name)
    return written
