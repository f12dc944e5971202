# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Covers on a coast: roofs and groves of 18 m x 18 m, below which only the ground sees."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trident_worldgen.coast_cells import Area, Post
from trident_worldgen.noise import Field
from trident_worldgen.sdf import Color, StaticModel

COVER_M = 18.0
"""Side of a cover."""

Mask = npt.NDArray[np.bool_]

_ROOF_M, _ROOF_POST_M = 3.0, 0.12
_TREE_GAP_M, _CROWN_M, _BARE_M = 4.5, 3.3, 2.2
_STEEL, _SHEET = Color((0.35, 0.36, 0.38)), Color((0.48, 0.52, 0.5))
_BARK, _LEAVES = Color((0.36, 0.25, 0.16)), Color((0.28, 0.45, 0.14))


@dataclass(frozen=True)
class Cover:
    """A square of 18 m: a `roof` on posts, or a `grove` whose crowns close.

    Attributes:
        x: of its middle [m].
        y: of its middle [m].
        kind: of it.
    """

    x: float
    y: float
    kind: str

    def has(self, x: Field | float, y: Field | float, more: float = 0.0) -> Mask:
        """Whether places lie below it, or within `more` of it [m]."""
        reach = COVER_M / 2 + more
        along, across = x - self.x, y - self.y
        # Half open, so that each cover takes as many cells.
        inside = (along >= -reach) & (along < reach) & (across >= -reach) & (across < reach)
        return np.asarray(inside)

    def posts(self) -> list[Post]:
        """What holds it up."""
        if self.kind == "roof":
            at = (-COVER_M / 2 + _ROOF_POST_M, 0.0, COVER_M / 2 - _ROOF_POST_M)
            places = [(dx, dy) for dx in at for dy in at if (dx, dy) != (0.0, 0.0)]
            return [Post(self.x + dx, self.y + dy, _ROOF_POST_M) for dx, dy in places]
        at4 = [_TREE_GAP_M * (index - 1.5) for index in range(4)]
        return [Post(self.x + dx, self.y + dy, 0.2) for dx in at4 for dy in at4]


def build(built: StaticModel, name: str, cover: Cover, area: Area) -> None:
    """Add a cover on the ground of an area to a model, with parts of this name."""
    (_roof if cover.kind == "roof" else _grove)(built, name, cover, area)


def _roof(built: StaticModel, name: str, cover: Cover, area: Area) -> None:
    """A level sheet on eight posts, 3 m above the highest ground below it."""
    at = np.linspace(-COVER_M / 2, COVER_M / 2, 7)
    highest = max(area.ground.height(cover.x + dx, cover.y + dy) for dx in at for dy in at)
    top = highest + _ROOF_M
    built.box(f"{name}_roof", (COVER_M, COVER_M, 0.2), (cover.x, cover.y, top + 0.1), _SHEET)
    for index, post in enumerate(cover.posts()):
        foot = area.ground.height(post.x, post.y) - 0.3
        center = (post.x, post.y, (foot + top) / 2)
        built.cylinder(f"{name}_post{index}", post.radius, top - foot, center, _STEEL)


def _grove(built: StaticModel, name: str, cover: Cover, area: Area) -> None:
    """Sixteen broad-leaved trees; the circles of their crowns cover the square."""
    for index, post in enumerate(cover.posts()):
        foot = area.ground.height(post.x, post.y)
        trunk = _BARE_M + 0.6 * _CROWN_M
        center = (post.x, post.y, foot - 0.3 + trunk / 2)
        built.cylinder(f"{name}_trunk{index}", post.radius, trunk, center, _BARK)
        crown = (post.x, post.y, foot + _BARE_M + _CROWN_M)
        built.sphere(f"{name}_crown{index}", _CROWN_M, crown, _LEAVES)
