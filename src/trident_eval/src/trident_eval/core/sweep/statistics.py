# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Means with their intervals, and differences run by run."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import stats

LEVEL = 0.95
_RESAMPLES = 2_000
_SEED = 1  # of the bootstrap, so that a page comes out the same each time


@dataclass(frozen=True)
class Estimate:
    """A mean.

    Attributes:
        count: of the values.
        mean: of them.
        spread: their standard deviation (n - 1); NaN for one value.
        t_low, t_high: 95 % interval by Student's t; NaN for one value.
        bootstrap_low, bootstrap_high: percentile bootstrap (Efron 1979); NaN for one value.
    """

    count: int
    mean: float
    spread: float
    t_low: float
    t_high: float
    bootstrap_low: float
    bootstrap_high: float

    @property
    def half_width(self) -> float:
        """Of the t interval; infinite for one value."""
        return (self.t_high - self.t_low) / 2 if self.count > 1 else math.inf


def estimate(values: Sequence[float]) -> Estimate:
    """The mean of one value or more, with its intervals.

    Raises:
        ValueError: no values.
    """
    data = np.asarray(values, dtype=float)
    if data.size == 0:
        raise ValueError("no values; legal: one or more")
    mean = float(data.mean())
    if data.size == 1:
        nan = math.nan
        return Estimate(1, mean, nan, nan, nan, nan, nan)
    spread = float(data.std(ddof=1))
    half = float(stats.t.ppf((1 + LEVEL) / 2, data.size - 1)) * spread / math.sqrt(data.size)
    low, high = _bootstrap(data)
    return Estimate(int(data.size), mean, spread, mean - half, mean + half, low, high)


def half_width(values: Sequence[float]) -> float:
    """Of the 95 % interval of the mean by Student's t; infinite for fewer than two values."""
    count = len(values)
    if count < 2:
        return math.inf
    spread = float(np.std(np.asarray(values, dtype=float), ddof=1))
    return float(stats.t.ppf((1 + LEVEL) / 2, count - 1)) * spread / math.sqrt(count)


def _bootstrap(data: npt.NDArray[np.float64]) -> tuple[float, float]:
    # Rows of at most 2^22 numbers at a time: memory stays bounded whatever the number of runs is.
    random = np.random.default_rng(_SEED)
    means = np.empty(_RESAMPLES)
    block = max(1, 2**22 // data.size)
    for start in range(0, _RESAMPLES, block):
        count = min(block, _RESAMPLES - start)
        picks = random.integers(0, data.size, (count, data.size))
        means[start : start + count] = data[picks].mean(axis=1)
    low, high = np.quantile(means, [(1 - LEVEL) / 2, (1 + LEVEL) / 2])
    return float(low), float(high)


@dataclass(frozen=True)
class Difference:
    """Two sides, pair by pair.

    Attributes:
        estimate: of first - second.
        p_value: two-sided, of the paired t test; NaN where it says nothing.
        holm_p: the same, adjusted for all comparisons of the sweep (Holm 1979).
    """

    estimate: Estimate
    p_value: float
    holm_p: float = math.nan


def difference(first: Sequence[float], second: Sequence[float]) -> Difference:
    """The paired difference of two series of equal length.

    Raises:
        ValueError: no pairs.
    """
    gap = np.asarray(first, dtype=float) - np.asarray(second, dtype=float)
    found = estimate([float(value) for value in gap])
    if gap.size < 2:
        return Difference(found, math.nan)
    if found.spread == 0.0:
        return Difference(found, 1.0 if found.mean == 0.0 else 0.0)
    t = abs(found.mean) / (found.spread / math.sqrt(gap.size))
    return Difference(found, 2.0 * float(stats.t.sf(t, gap.size - 1)))


def holm(p_values: Sequence[float]) -> list[float]:
    """P values adjusted so that the chance of one false finding among all stays (Holm 1979).

    NaN stays NaN, and counts as no comparison.
    """
    known = sorted((p, i) for i, p in enumerate(p_values) if not math.isnan(p))
    adjusted = [math.nan] * len(p_values)
    highest = 0.0
    for rank, (p, index) in enumerate(known):
        highest = max(highest, min(1.0, p * (len(known) - rank)))
        adjusted[index] = highest
    return adjusted
