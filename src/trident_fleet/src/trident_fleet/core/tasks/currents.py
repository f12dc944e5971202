# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Lengths of paths of vessels where the water moves, as a cost of tasks."""

from __future__ import annotations

import math
from collections.abc import Callable

from trident_fleet.core.tasks.fields import TaskError
from trident_fleet.core.tasks.messages import Point

# Where -> velocity of the water, v_common [m/s].
Current = Callable[[Point], tuple[float, float]]

_PIECES = 8  # of a path, in each of which the water moves alike


class InCurrent:
    """The path through the water of a vessel that keeps to the straight line over ground.

    It points into the current so that it does not leave the line: over ground it makes what is left
    of its speed, and what the water adds along the line. So the path back may be longer.
    """

    def __init__(self, current: Current, speed_m_s: float) -> None:
        """Of a vessel of this speed through the water.

        Raises:
            TaskError: the speed is not legal.
        """
        if not 0.0 < speed_m_s < math.inf:
            raise TaskError(f"current: speed_m_s is {speed_m_s}, legal: finite, above 0")
        self._current, self._speed_m_s = current, speed_m_s

    def __call__(self, start: Point, goal: Point) -> float:
        """Length of the path through the water [m]; infinite if the current is too strong."""
        distance_m = math.dist(start, goal)
        if distance_m == 0.0:
            return 0.0
        ahead = [(b - a) / distance_m for a, b in zip(start, goal, strict=True)]
        length_m = 0.0
        for piece in range(_PIECES):
            along_m = (piece + 0.5) / _PIECES * distance_m
            x, y, z = (a + u * along_m for a, u in zip(start, ahead, strict=True))
            over_ground_m_s = self._made_good(ahead, self._current((x, y, z)))
            if over_ground_m_s <= 0.0:
                return math.inf
            length_m += distance_m / _PIECES * self._speed_m_s / over_ground_m_s
        return length_m

    def _made_good(self, ahead: list[float], water: tuple[float, float]) -> float:
        """Speed over ground along the line [m/s]; 0: the water takes the vessel off it."""
        with_it = ahead[0] * water[0] + ahead[1] * water[1]
        across = math.hypot(*water) ** 2 - with_it**2
        left = self._speed_m_s**2 - across
        return with_it + math.sqrt(left) if left > 0.0 else 0.0
