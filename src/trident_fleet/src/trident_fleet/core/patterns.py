# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Shapes of a formation: where each place is, in the formation's frame."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trident_fleet.core.errors import FormationError
from trident_fleet.core.quintic import Array

KINDS = ("line", "wedge", "circle", "grid")
FARTHEST_M = 1000.0


@dataclass(frozen=True)
class Pattern:
    """A shape for any number of vehicles.

    Attributes:
        kind: one of `KINDS`.
        spacing_m: distance of neighbours [m].
        radius_m: of a circle [m]; 0: what `spacing_m` makes it.
        opening_deg: angle between the two arms of a wedge [deg].
        columns: of a grid, side by side; 0: as many as make it nearly square.
    """

    kind: str
    spacing_m: float = 1.5
    radius_m: float = 0.0
    opening_deg: float = 90.0
    columns: int = 0

    def validate(self) -> None:
        """Raise FormationError on the first field with an illegal value."""
        if self.kind not in KINDS:
            raise FormationError(f"pattern: '{self.kind}'; legal: {', '.join(KINDS)}")
        if not 0.0 < self.spacing_m <= FARTHEST_M:
            raise FormationError(f"spacing_m: {self.spacing_m}; legal: over 0, to {FARTHEST_M:g}")
        if not 0.0 <= self.radius_m <= FARTHEST_M:
            raise FormationError(f"radius_m: {self.radius_m}; legal: 0 to {FARTHEST_M:g}")
        if not 10.0 <= self.opening_deg <= 180.0:
            raise FormationError(f"opening_deg: {self.opening_deg}; legal: 10 to 180")
        if self.columns < 0:
            raise FormationError(f"columns: {self.columns}; legal: 0 or more")


def places(pattern: Pattern, count: int) -> Array:
    """Places of a pattern in the formation's frame (x ahead, y to the left), around its centroid.

    A line goes from left to right, a wedge from its tip outwards, left before right, a circle
    counter-clockwise from straight ahead, a grid row by row from its front left corner.

    Args:
        pattern: which, and how large.
        count: of the places, 1 or more.

    Returns:
        p_formation [m], shape (count, 3), z = 0.

    Raises:
        FormationError: a field of `pattern` with an illegal value.
    """
    pattern.validate()
    make = {"line": _line, "wedge": _wedge, "circle": _circle, "grid": _grid}[pattern.kind]
    flat = make(pattern, count)
    points = np.zeros((count, 3))
    points[:, :2] = flat - flat.mean(axis=0)
    return points


def _line(pattern: Pattern, count: int) -> Array:
    return np.stack([np.zeros(count), -pattern.spacing_m * np.arange(count)], axis=1)


def _wedge(pattern: Pattern, count: int) -> Array:
    number = np.arange(count)
    along = pattern.spacing_m * ((number + 1) // 2)
    half = math.radians(pattern.opening_deg) / 2.0
    side = np.where(number % 2 == 1, 1.0, -1.0)
    return np.stack([-along * math.cos(half), side * along * math.sin(half)], axis=1)


def _circle(pattern: Pattern, count: int) -> Array:
    step = 2.0 * math.pi / count
    # Neighbours are a chord apart.
    chord = 2.0 * math.sin(step / 2.0) if count > 1 else math.inf
    radius = pattern.radius_m or pattern.spacing_m / chord
    angle = step * np.arange(count)
    return radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def _grid(pattern: Pattern, count: int) -> Array:
    columns = min(pattern.columns or math.ceil(math.sqrt(count)), count)
    row, column = np.divmod(np.arange(count), columns)
    return -pattern.spacing_m * np.stack([row, column], axis=1).astype(np.float64)
