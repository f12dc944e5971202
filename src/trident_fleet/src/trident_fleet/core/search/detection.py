# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a robot sees: footprint, range, occlusion, and the chance to detect what is in view."""

from __future__ import annotations

import hashlib
import math
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import maximum_filter

from trident_fleet.core.search.area import Array, Index, Mask, SearchArea, SearchError

_SAMPLES_PER_CELL = 1
_FREE_M = 0.3  # that a sight line may touch of what grows and lies there
_TARGET_M = 0.3  # height of a person who lies there

# Weather correction of sweep widths for persons in the water, by significant wave height [m]
# (IAMSAR Manual, volume II, appendix N, table N-7: 1.0 up to 1 m, 0.5 up to 1.5 m, 0.25 above).
_WEATHER = ((1.0, 1.0), (1.5, 0.5), (math.inf, 0.25))


@dataclass(frozen=True)
class Sensor:
    """What one kind of robot sees of people and of the ground.

    Probabilities are per second in view. Detection in time is exponential (Koopman's random
    search): 1 - (1 - p)^t after t seconds.

    Attributes:
        range_m: horizontal distance that it sees to [m].
        height_m: of the eye above what the robot moves on, or above the still water in the air [m].
        detect: probability to detect a person.
        cover_land: probability that counts for the coverage of a cell on land.
        cover_water: the same on the water.
        from_above: it looks down: what is covered is hidden, and nothing else.
    """

    range_m: float
    height_m: float
    detect: float
    cover_land: float
    cover_water: float
    from_above: bool = False

    def __post_init__(self) -> None:
        """Refuse what cannot be.

        Raises:
            SearchError: names field, value and legal range.
        """
        for name in ("range_m", "height_m"):
            if not 0.0 < getattr(self, name) < math.inf:
                raise SearchError(f"sensor: {name} is {getattr(self, name)}, legal: above 0")
        for name in ("detect", "cover_land", "cover_water"):
            if not 0.0 <= getattr(self, name) < 1.0:
                raise SearchError(f"sensor: {name} is {getattr(self, name)}, legal: 0 to below 1")


def weather_factor(wave_height_m: float) -> float:
    """By which sea shortens the search for people in the water, 0 ... 1."""
    return next(factor for height, factor in _WEATHER if wave_height_m <= height)


@dataclass(frozen=True)
class View:
    """The cells that are in view from a place: rows and columns, shape (N,)."""

    row: Index
    column: Index

    def mask(self, shape: tuple[int, int]) -> Mask:
        """As a mask of the grid."""
        seen = np.zeros(shape, dtype=bool)
        seen[self.row, self.column] = True
        return seen


NOTHING = View(np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64))
"""What is in view of a robot that does not look."""


class Eye:
    """A sensor in an area: which cells it sees from where, and how well."""

    def __init__(self, area: SearchArea, sensor: Sensor, wave_height_m: float = 0.0) -> None:
        """Of a sensor on any robot of a kind.

        Args:
            area: that is searched.
            sensor: of the robot.
            wave_height_m: significant height of the waves [m].
        """
        self.area, self.sensor = area, sensor
        lattice = area.lattice
        self._reach = reach = math.ceil(sensor.range_m / lattice.cell_m)
        factor = weather_factor(wave_height_m)
        # Rates -ln(1 - p) [1/s]; only these are added up.
        wet = factor * _rate(sensor.cover_water)
        self.cover_rate: Array = np.where(area.land, _rate(sensor.cover_land), wet)
        self.detect_rate: Array = _rate(sensor.detect) * np.where(area.land, 1.0, factor)
        if sensor.from_above:
            self.cover_rate[area.covered] = 0.0
            self.detect_rate[area.covered] = 0.0
        self._open_sky: Mask = self.detect_rate > 0.0
        surface = np.maximum(area.heights, 0.0)
        self._surface = surface
        self._rugged = _largest_nearby(surface, reach) - _smallest_nearby(surface, reach)

    def view(self, x: float, y: float) -> View:
        """The cells in view from x, y, p_common [m]: middle within range, and not hidden.

        Raises:
            SearchError: the place is not finite.
        """
        if not (math.isfinite(x) and math.isfinite(y)):
            raise SearchError(f"view: place is {x}, {y}, legal: finite")
        lattice = self.area.lattice
        row0, column0 = (int(value) for value in lattice.cell(x, y))
        low, left = max(row0 - self._reach, 0), max(column0 - self._reach, 0)
        rows = np.arange(low, min(row0 + self._reach + 1, lattice.rows))
        columns = np.arange(left, min(column0 + self._reach + 1, lattice.columns))
        at_x, at_y = lattice.middle(rows, columns)
        chosen = (at_x - x) ** 2 + (at_y[:, None] - y) ** 2 <= self.sensor.range_m**2
        if self.sensor.from_above:
            open_sky = self._open_sky[low : low + len(rows), left : left + len(columns)]
            chosen &= open_sky
        row, column = np.nonzero(chosen)
        row, column = row + low, column + left
        if self.sensor.from_above:
            return View(row, column)
        eye_m = self._surface[row0, column0] + self.sensor.height_m
        if self._rugged[row0, column0] + _FREE_M <= self.sensor.height_m:
            return View(row, column)  # nothing nearby is as high as the eye
        free = self._is_free(x, y, eye_m, row, column)
        return View(row[free], column[free])

    def _is_free(self, x: float, y: float, eye_m: float, row: Index, column: Index) -> Mask:
        """Whether the sight line to each cell passes above everything between."""
        lattice = self.area.lattice
        count = max(round(self.sensor.range_m / lattice.cell_m) * _SAMPLES_PER_CELL, 2)
        share = (np.arange(1, count) / count)[:, None]
        goal_x, goal_y = lattice.middle(row, column)
        at_row, at_column = lattice.cell(x + share * (goal_x - x), y + share * (goal_y - y))
        line_m = eye_m + share * (self._surface[row, column] + _TARGET_M - eye_m)
        same = (at_row == row) & (at_column == column)
        above = self._surface[at_row, at_column] <= line_m + _FREE_M
        return np.asarray((above | same).all(axis=0))


def _rate(probability: float) -> float:
    return -math.log1p(-probability)


def _largest_nearby(values: Array, reach: int) -> Array:
    return np.asarray(maximum_filter(values, size=2 * reach + 1, mode="nearest"))


def _smallest_nearby(values: Array, reach: int) -> Array:
    return -_largest_nearby(-values, reach)


def chance(seed: int, robot: str, subject: str, tick: int) -> float:
    """A number in [0, 1) that seed, robot, subject (a cell or a person) and time alone decide.

    So what one robot detects does not depend on what others do, and a run can be repeated.
    """
    key = f"{seed}/{robot}/{subject}/{tick}".encode()
    return int.from_bytes(hashlib.blake2b(key, digest_size=8).digest(), "big") / 2.0**64
