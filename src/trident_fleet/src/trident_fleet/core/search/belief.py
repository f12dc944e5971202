# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Where a person who has not been found may be: one distribution over the area.

People on land stay where they are: a probability per cell. People in the water drift, each with a
leeway of its own (`drift`), so what matters of them is not only where they may be, but where those
who are there come from and go to: weighted particles, spread evenly over water and leeways, which
the grid sums up. Negative information multiplies both by the chance of a miss (Bayes' rule, as in
L. D. Stone, Theory of Optimal Search, 1975, chapter 1).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import ndtri
from scipy.stats import qmc

from trident_fleet.core.search.area import Array, Index, Mask, SearchArea, SearchError
from trident_fleet.core.search.detection import Eye, View
from trident_fleet.core.search.drift import Flow, Sea

_SMALLEST = 1e-12  # of all that is left, below which the observations contradict the prior


@dataclass(frozen=True)
class Prior:
    """Shares of the people by kind of terrain; uniform within each.

    Attributes:
        open_land: in the open on land.
        covered: below roofs and trees.
        water: in the water.
    """

    open_land: float = 5.0 / 12.0
    covered: float = 2.0 / 12.0
    water: float = 5.0 / 12.0

    def __post_init__(self) -> None:
        """Refuse what is no distribution.

        Raises:
            SearchError: names field, value and legal range.
        """
        for name in ("open_land", "covered", "water"):
            if not 0.0 <= getattr(self, name) < math.inf:
                raise SearchError(f"prior: {name} is {getattr(self, name)}, legal: from 0")
        if not self.open_land + self.covered + self.water > 0.0:
            raise SearchError("prior: all shares are 0, legal: one above 0")

    def grid(self, area: SearchArea) -> Array:
        """By cell, shape (rows, columns); shares of terrain that is not there go to the others."""
        parts = (
            (self.open_land, area.land & ~area.covered),
            (self.covered, area.land & area.covered),
            (self.water, ~area.land),
        )
        grid = np.zeros(area.lattice.shape)
        for share, cells in parts:
            if cells.any():
                grid[cells] = share / int(cells.sum())
        if not grid.sum() > 0.0:
            raise SearchError("prior: the area has none of its terrain, legal: some")
        return np.asarray(grid / grid.sum())


class Belief:
    """The distribution of one of those who have not been found."""

    def __init__(
        self, area: SearchArea, prior: Array, sea: Sea | None = None, particles: int = 1 << 16
    ) -> None:
        """As before the search, at time 0.

        Args:
            area: that is searched.
            prior: probability by cell, shape (rows, columns); it is scaled to sum to 1.
            sea: what moves those in the water; None: nothing.
            particles: that stand for those in the water.

        Raises:
            SearchError: the prior is not legal, or of another grid.
        """
        area.lattice.check(prior, "belief: prior")
        if not (np.isfinite(prior).all() and (prior >= 0.0).all() and prior.sum() > 0.0):
            raise SearchError("belief: prior has cells that are negative, NaN, or all 0")
        self.area, self.now_s = area, 0.0
        self._still: Array = np.where(area.land, prior, 0.0) / prior.sum()
        self._flow = Flow(area, sea or Sea())
        wet = np.where(area.land, 0.0, prior) / prior.sum()
        self._places, self._leeways = _even_drifters(area, wet, self._flow.sea, particles)
        self._weights = np.full(len(self._places), wet.sum() / max(len(self._places), 1))
        self._cells = self._cells_of(self._places)

    def drift(self, to_s: float) -> None:
        """Let those in the water drift.

        Raises:
            SearchError: time would run back.
        """
        if not to_s >= self.now_s:
            raise SearchError(f"belief: time {to_s} s, legal: from {self.now_s} s, its clock")
        self._places = self._flow.moved(self._places, self._leeways, to_s - self.now_s)
        self._cells = self._cells_of(self._places)
        self.now_s = to_s

    def miss(self, eye: Eye, view: View, seconds: float) -> float:
        """Nobody was detected: take that in.

        Args:
            eye: that looked.
            view: what it saw.
            seconds: for how long [s].

        Returns:
            The probability with which it would have been otherwise.
        """
        missed = np.ones(self.area.lattice.shape)
        rate = eye.detect_rate[view.row, view.column]
        missed[view.row, view.column] = np.exp(-rate * seconds)
        return self.multiply(missed)

    def multiply(self, likelihood: Array) -> float:
        """Take in an observation by its likelihood in each cell, shape (rows, columns).

        Returns:
            The probability with which it would have been otherwise.

        Raises:
            SearchError: it is of another grid, or contradicts all that was believed.
        """
        self.area.lattice.check(likelihood, "belief: likelihood")
        still = self._still * likelihood
        weights = self._weights * likelihood.ravel()[self._cells]
        left = float(still.sum() + weights.sum())
        if not left > _SMALLEST:
            raise SearchError(f"belief: {left:g} is left of it, legal: above {_SMALLEST:g}")
        self._still, self._weights = still / left, weights / left
        return 1.0 - left

    def grid(self) -> Array:
        """Probability by cell, which sums to 1, shape (rows, columns)."""
        count = self.area.lattice.rows * self.area.lattice.columns
        moving = np.bincount(self._cells, weights=self._weights, minlength=count)
        return np.asarray(self._still + moving.reshape(self.area.lattice.shape))

    def _cells_of(self, places: Array) -> Index:
        row, column = self.area.lattice.cell(places[:, 0], places[:, 1])
        return np.asarray(row * self.area.lattice.columns + column)


def _even_drifters(area: SearchArea, wet: Array, sea: Sea, count: int) -> tuple[Array, Array]:
    """Equally likely people that fill a density and the spread of leeways evenly.

    The points are those of Sobol's sequence in five dimensions (place, two residuals, side), which
    represent the distribution as well as many times more random ones.

    Args:
        area: that is searched.
        wet: the density, shape (rows, columns).
        sea: what moves them.
        count: how many; rounded up to a power of 2.

    Returns:
        Places p_common [m] and velocities by the wind [m/s], shapes (N, 2).
    """
    if not wet.sum() > 0.0 or count < 1:
        return np.zeros((0, 2)), np.zeros((0, 2))
    sequence = qmc.Sobol(5, scramble=False)
    shares = sequence.random_base2(math.ceil(math.log2(count)))
    shares = (shares + 0.5 / len(shares)).clip(1e-9, 1.0 - 1e-9)
    lattice = area.lattice
    along_y = np.cumsum(wet.sum(axis=1)) / wet.sum()
    y = _inverse(along_y, shares[:, 0])
    row = np.floor(y).astype(np.intp)
    along_x = np.cumsum(wet, axis=1)
    # Rows one after the other in one ascending table: row r goes from r to r + 1.
    ends = np.arange(lattice.rows)[:, None] + along_x / np.maximum(along_x[:, -1:], 1e-300)
    x = _inverse(ends.ravel(), row + shares[:, 1]) - row * lattice.columns
    places = np.column_stack([x, y]) * lattice.cell_m + lattice.origin
    return places, sea.leeways(ndtri(shares[:, 2:4]), np.asarray(shares[:, 4] < 0.5))


def _inverse(ends: Array, shares: Array) -> Array:
    """Where a cumulative table reaches its shares, in cells and parts of them."""
    cell = np.searchsorted(ends, shares, side="right").clip(0, len(ends) - 1)
    begin = np.where(cell > 0, ends[cell - 1], 0.0)
    width = np.maximum(ends[cell] - begin, 1e-300)
    return np.asarray(cell + ((shares - begin) / width).clip(0.0, 1.0 - 1e-9))


def is_water(area: SearchArea, place: tuple[float, float]) -> bool:
    """Whether a place is in the water."""
    row, column = area.lattice.cell(*place)
    wet: Mask = ~area.land
    return bool(wet[row, column])
