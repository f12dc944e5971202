# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Drift of people in the water, by current and leeway.

The leeway model is that of A. Allen and J. V. Plourde, "Review of leeway: field experiments and
implementation", U.S. Coast Guard report CG-D-08-99, 1999, as Ø. Breivik and A. Allen write it in
"An operational search and rescue model for the Norwegian Sea and the North Sea", J. Marine Systems
69, 2008: an object drifts downwind and across the wind, to its right or left, each a linear
function of the wind speed with a normal spread of its own. Coefficients are those of the list that
the authors' model ships (OBJECTPROP.DAT, 2011).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trident_fleet.core.search.area import Array, Mask, SearchArea, SearchError

_SHORE_M = 1.0
"""Depth from which the current has its full speed, as in the simulator's environment."""


@dataclass(frozen=True)
class Line:
    """Leeway along one axis: slope times wind speed plus offset.

    Attributes:
        slope: share of the wind speed.
        offset_m_s: [m/s].
        deviation_m_s: of the fit's residuals [m/s].
    """

    slope: float
    offset_m_s: float
    deviation_m_s: float

    def speed(self, wind_m_s: float, normal: Array) -> Array:
        """Of objects whose residuals are `normal` standard deviations [m/s].

        The residual acts half on the offset, and half, at 10 m/s, on the slope (Breivik and Allen
        2008, equation 10).
        """
        spread = self.deviation_m_s * (0.5 + 0.05 * wind_m_s)
        return np.asarray(self.slope * wind_m_s + self.offset_m_s + spread * normal)


@dataclass(frozen=True)
class Leeway:
    """How an object drifts before the wind.

    Attributes:
        downwind: along the wind.
        right: across it, of objects that drift to the right of it.
        left: of those that drift to the left, positive to the left; as many do.
    """

    downwind: Line
    right: Line
    left: Line


LEEWAYS: dict[str, Leeway] = {
    "person": Leeway(
        Line(0.0096, 0.0, 0.12), Line(0.0054, 0.0, 0.094), Line(0.0054, 0.0, 0.094)
    ),  # PIW-1, state unknown
    "person_upright": Leeway(
        Line(0.0048, 0.0, 0.083), Line(0.0015, 0.0, 0.067), Line(0.0015, 0.0, 0.067)
    ),  # PIW-2, vertical, in a life jacket of type III
    "person_sitting": Leeway(
        Line(0.0160, -0.0398, 0.0242), Line(0.0013, 0.0033, 0.0211), Line(0.0013, 0.0033, 0.0211)
    ),  # PIW-3, sitting, in a life jacket of type I or II
}
"""By kind of object."""


def leeway_named(name: str) -> Leeway:
    """The leeway of a kind of object.

    Raises:
        SearchError: the kind is unknown.
    """
    if name not in LEEWAYS:
        raise SearchError(f"leeway is {name!r}, legal: {', '.join(LEEWAYS)}")
    return LEEWAYS[name]


@dataclass(frozen=True)
class Sea:
    """What moves those in the water.

    Attributes:
        current: of the surface in deep water, along x and y [m/s].
        wind: that blows to, along x and y [m/s].
        leeway: of the people.
    """

    current: tuple[float, float] = (0.0, 0.0)
    wind: tuple[float, float] = (0.0, 0.0)
    leeway: Leeway = LEEWAYS["person_sitting"]

    def __post_init__(self) -> None:
        """Refuse speeds that are not finite.

        Raises:
            SearchError: names field, value and legal range.
        """
        for name in ("current", "wind"):
            if not all(map(math.isfinite, getattr(self, name))):
                raise SearchError(f"sea: {name} is {getattr(self, name)}, legal: finite, m/s")

    def leeways(self, normals: Array, to_right: Mask) -> Array:
        """Velocities by the wind of objects.

        Args:
            normals: of residuals downwind and across, standard normal, shape (N, 2).
            to_right: whether each drifts to the right of the wind, shape (N,).

        Returns:
            Along x and y [m/s], shape (N, 2).
        """
        speed = math.hypot(*self.wind)
        down = self.leeway.downwind.speed(speed, normals[:, 0])
        right = self.leeway.right.speed(speed, normals[:, 1])
        left = self.leeway.left.speed(speed, normals[:, 1])
        aside = np.where(to_right, right, -left)
        ahead = np.array(self.wind) / speed if speed > 0.0 else np.array((1.0, 0.0))
        across = np.array((ahead[1], -ahead[0]))  # to the right of where the wind blows to
        return np.asarray(down[:, None] * ahead + aside[:, None] * across)


def random_leeways(sea: Sea, count: int, random: np.random.Generator) -> Array:
    """Velocities by the wind of `count` people [m/s], shape (count, 2)."""
    normals = random.standard_normal((count, 2))
    return sea.leeways(normals, random.random(count) < 0.5)


class Flow:
    """Moves people in the water of an area; who comes ashore or to the border stays there."""

    def __init__(self, area: SearchArea, sea: Sea) -> None:
        """Of an area and what moves those in it."""
        self.sea = sea
        self._lattice = area.lattice
        self._wet = ~area.land
        depth = np.clip(-area.heights / _SHORE_M, 0.0, 1.0)
        # Smoothstep, as the simulator's current fades over the beach.
        self._fade: npt.NDArray[np.float64] = depth * depth * (3.0 - 2.0 * depth)

    def moved(self, places: Array, leeways: Array, step_s: float) -> Array:
        """Where people are after a step.

        Args:
            places: x and y, p_common [m], shape (N, 2).
            leeways: their velocities by the wind [m/s], shape (N, 2).
            step_s: [s]; the fade of the current is taken at the beginning.
        """
        lattice = self._lattice
        row, column = lattice.cell(places[:, 0], places[:, 1])
        velocity = leeways + self._fade[row, column, None] * np.array(self.sea.current)
        goal = places + step_s * velocity
        row, column = lattice.cell(goal[:, 0], goal[:, 1])
        swims = lattice.has(goal[:, 0], goal[:, 1]) & self._wet[row, column]
        return np.where(swims[:, None], goal, places)
