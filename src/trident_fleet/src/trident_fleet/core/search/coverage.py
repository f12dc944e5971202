# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Which cells have been seen, and how well."""

from __future__ import annotations

import math

import numpy as np

from trident_fleet.core.search.area import Array, Lattice, Mask, SearchError
from trident_fleet.core.search.detection import Eye, View

ENOUGH = 0.9
"""A cell is covered when its cumulative probability of detection is at least this."""


class Coverage:
    """Cumulative probability of detection by cell, as the exponent of what was missed."""

    def __init__(self, lattice: Lattice) -> None:
        """Nothing has been seen."""
        self.lattice = lattice
        self._exponent: Array = np.zeros(lattice.shape)

    def see(self, eye: Eye, view: View, seconds: float) -> None:
        """Take in what was in view for a time.

        Raises:
            SearchError: the time is not legal.
        """
        if not 0.0 <= seconds < math.inf:
            raise SearchError(f"coverage: seconds is {seconds}, legal: finite, from 0")
        rate = eye.cover_rate[view.row, view.column]
        self._exponent[view.row, view.column] += rate * seconds

    def seen(self) -> Array:
        """Probability of detection so far, shape (rows, columns)."""
        return 1.0 - np.exp(-self._exponent)

    def covered(self) -> Mask:
        """Cells that have been seen well enough, shape (rows, columns)."""
        return self._exponent >= -math.log(1.0 - ENOUGH) - 1e-9

    def share(self) -> float:
        """Of all cells that are covered."""
        return float(self.covered().mean())

    def lacks_s(self, eye: Eye) -> Array:
        """How long each cell must still be in view of a robot [s]; infinite: it sees none of it."""
        missing = np.maximum(-math.log(1.0 - ENOUGH) - self._exponent, 0.0)
        rate = eye.cover_rate
        return np.where(missing > 0.0, missing / np.where(rate > 0.0, rate, 1e-300), 0.0)
