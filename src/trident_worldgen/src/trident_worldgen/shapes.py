# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Meshes of nature, as OBJ files."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import combinations

import numpy as np
import numpy.typing as npt

Vertices = npt.NDArray[np.float64]
Triangle = tuple[int, int, int]

_LICENCE = (
    "# SPDX-FileCopyrightText: 2026 The Trident authors\n# SPDX-License-Identifier: Apache-2.0\n"
)


def cone(sides: int = 12) -> str:
    """A closed cone: base of radius 1 about the origin, tip at z = 1."""
    turn = 2.0 * math.pi * np.arange(sides) / sides
    rim = np.stack([np.cos(turn), np.sin(turn), np.zeros(sides)], axis=1)
    vertices = np.concatenate([rim, [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0]]])
    triangles: list[Triangle] = []
    for side in range(sides):
        after = (side + 1) % sides
        triangles += [(side, after, sides), (after, side, sides + 1)]
    return _obj(vertices, triangles)


def rock(random: np.random.Generator) -> str:
    """A closed, rough ball of about radius 1 about the origin."""
    vertices, triangles = _ball()
    radii = random.uniform(0.75, 1.1, len(vertices))
    return _obj(vertices * radii[:, None], triangles)


def _icosahedron_points() -> list[Vertices]:
    """Its 12 vertices at radius 1, each of shape (3,)."""
    golden = (1.0 + math.sqrt(5.0)) / 2.0
    corners = [(s, t * golden, 0.0) for s in (-1.0, 1.0) for t in (-1.0, 1.0)]
    points = [np.roll(corner, shift) for shift in range(3) for corner in corners]
    return [point / np.linalg.norm(point) for point in points]


def _are_neighbors(points: list[Vertices], side: Triangle) -> bool:
    """Whether each two of three vertices of an icosahedron share an edge, 1.05 long."""
    return all(math.dist(points[i], points[j]) < 1.1 for i, j in combinations(side, 2))


def _ball() -> tuple[Vertices, list[Triangle]]:
    """An icosahedron whose 20 sides are divided into 4 each: 42 vertices at radius 1."""
    points = _icosahedron_points()
    sides = [side for side in combinations(range(12), 3) if _are_neighbors(points, side)]
    middles: dict[tuple[int, int], int] = {}

    def middle(i: int, j: int) -> int:
        key = (min(i, j), max(i, j))
        if key not in middles:
            middles[key] = len(points)
            between = points[i] + points[j]
            points.append(between / np.linalg.norm(between))
        return middles[key]

    triangles = []
    for a, b, c in (_outward(points, side) for side in sides):
        ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
        triangles += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
    return np.array(points), triangles


def _outward(points: Sequence[Vertices], side: Triangle) -> Triangle:
    """The triangle in the order that is counter-clockwise from outside."""
    a, b, c = (points[index] for index in side)
    return side if np.dot(np.cross(b - a, c - a), a) > 0.0 else (side[0], side[2], side[1])


def _obj(vertices: Vertices, triangles: Sequence[Triangle]) -> str:
    lines = [f"v {x:.5f} {y:.5f} {z:.5f}" for x, y, z in vertices + 0.0]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in triangles]
    return _LICENCE + "\n".join(lines) + "\n"
