# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Which place to fly to next: where the worst of several links may gain most over what is known."""

from __future__ import annotations

import math

import numpy as np
from scipy.special import ndtr

from trident_fleet.core.quintic import Array
from trident_fleet.core.station.fence import Fence
from trident_fleet.core.station.link_field import LinkField

_DENSEST_M = 2.0
_GROWTH = 1.12
_MARGIN_DB = 6.0  # places whose distances cost more than that over the best ones are left out


def worst_of(fields: list[LinkField]) -> tuple[Array, Array]:
    """Mean [dB] and variance [dB^2] of the least of the links' SNRs at their places, shape (M,).

    Each pair of normal variables is replaced by a normal one with the moments of its minimum
    (Clark 1961), one link after the other.
    """
    mean, variance = fields[0].mean_db, fields[0].variance_db2
    for field in fields[1:]:
        mean, variance = _least_of_two(mean, variance, field.mean_db, field.variance_db2)
    return mean, variance


def _least_of_two(
    mean: Array, variance: Array, mean2: Array, variance2: Array
) -> tuple[Array, Array]:
    spread = np.sqrt(variance + variance2)
    apart = (mean2 - mean) / spread
    share, density = ndtr(apart), np.exp(-0.5 * apart * apart) / math.sqrt(2.0 * math.pi)
    least = mean * share + mean2 * (1.0 - share) - spread * density
    square = (mean**2 + variance) * share + (mean2**2 + variance2) * (1.0 - share)
    square = square - (mean + mean2) * spread * density
    return least, np.maximum(square - least * least, 1e-4)


def expected_gain(mean: Array, variance: Array, best_db: float) -> Array:
    """Expected improvement over the best that is known [dB] (Jones, Schonlau and Welch 1998)."""
    sigma = np.sqrt(variance)
    u = (mean - best_db) / sigma
    return np.asarray(sigma * (u * ndtr(u) + np.exp(-0.5 * u * u) / math.sqrt(2.0 * math.pi)))


def survey_places(
    fence: Fence, margin_m: float, others: list[Array], count: int, random: np.random.Generator
) -> Array:
    """Places all over a fence that are not too far from all robots at once.

    A grid whose points are moved by up to half of its spacing, as dense as the number allows.

    Args:
        fence: in which they lie.
        margin_m: that they keep to its faces.
        others: where the robots of the links are, p_world [m].
        count: of the places, at most.
        random: moves them.

    Returns:
        p_world [m], shape (M, 3), M >= 1.
    """
    spacing = _DENSEST_M
    while True:
        places = _near(_jittered(fence, margin_m, spacing, random), others)
        if 1 <= len(places) <= count or spacing > 1e4:
            return places
        spacing *= _GROWTH if len(places) else 1.0 / _GROWTH


def _jittered(fence: Fence, margin_m: float, spacing: float, random: np.random.Generator) -> Array:
    low = np.array([*fence.corners.min(axis=0), fence.lowest_m]) + margin_m
    high = np.array([*fence.corners.max(axis=0), fence.highest_m]) - margin_m
    counts = [max(2, round((b - a) / spacing) + 1) for a, b in zip(low, high, strict=True)]
    axes = [np.linspace(a, b, n) for a, b, n in zip(low, high, counts, strict=True)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    grid = np.clip(grid + random.uniform(-0.5, 0.5, grid.shape) * spacing, low, high)
    return np.asarray(grid[fence.clearance(grid) >= margin_m])


def _near(places: Array, others: list[Array]) -> Array:
    """Those that the distances alone do not rule out."""
    if not others or not len(places):
        return places
    farthest = np.max([np.linalg.norm(places - other, axis=1) for other in others], axis=0)
    loss_db = 20.0 * np.log10(np.maximum(farthest, 1.0))
    return np.asarray(places[loss_db <= loss_db.min() + _MARGIN_DB])


def places_about(
    centers: list[Array], fence: Fence, margin_m: float, random: np.random.Generator
) -> Array:
    """Places close about others, those included: 2 m around, half a meter apart in the mean.

    Args:
        centers: p_world [m], within the margin.
        fence: in which they lie.
        margin_m: that they keep to its faces.
        random: scatters them.
    """
    around = random.normal(size=(160, 3))
    around *= (2.5 * random.uniform(size=160) ** (1 / 3) / np.linalg.norm(around, axis=1))[:, None]
    near = np.concatenate([center + around for center in centers])
    kept = near[fence.clearance(near) >= margin_m]
    return np.concatenate([np.array(centers), kept])
