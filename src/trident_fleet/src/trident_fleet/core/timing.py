# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""When to be at each row: a C2 motion through all rows, at speeds the vehicles can fly."""

from __future__ import annotations

import numpy as np

from trident_fleet.core.config import FlightLimits
from trident_fleet.core.quintic import Array, QuinticPath

# Rows that repeat (a vehicle waits) still take this long [s].
MIN_STEP_S = 0.02
_SWEEPS = 600
_REFINEMENTS = 24
_GAIN = 0.12
_MIN_RATIO = 0.05
_WIDEST = 8.0
_REFINED_WIDTH = 1.5
_SAMPLES_PER_STEP = 5
_MIN_SCALE = 1e-3
_FINAL_SAMPLES = 17
_MARGIN = 1.0 + 1e-3


def fly_through(rows: Array, limits: FlightLimits) -> QuinticPath:
    """Motion from rest at the first row to rest at the last one, exactly through every row.

    All vehicles pass row i at the same knot time t_i. The steps between knots are relaxed until
    speed, acceleration and jerk of the busiest vehicle come close to the limits everywhere; a cubic
    spline with quintic ends (zero acceleration at rest) goes through the knots, and a last uniform
    scaling of time makes the limits hold.

    Args:
        rows: p_world of each row and vehicle [m], shape (T, N, 3), T >= 2.
        limits: that no vehicle exceeds.

    Returns:
        Knots 0..T-1, one per row, from time 0.
    """
    path = _refine(rows, _relax(rows, limits), limits)
    return path.stretched(max(excess(path, limits), _MIN_SCALE) * _MARGIN)


def excess(path: QuinticPath, limits: FlightLimits) -> float:
    """Factor by which `path` has to be stretched in time to keep the limits; 1 at the limit."""
    return float(_excess_of_path(path, limits, _FINAL_SAMPLES).max())


def _relax(rows: Array, limits: FlightLimits) -> Array:
    """Steps [s], shape (T-1,), at which finite differences come close to the limits.

    Each sweep multiplies a step by a power of its excess (> 1: longer, < 1: shorter), smoothed over
    its neighbours, first over many, then over few: a narrow window from the start would make the
    steps swing. The best steps seen, after uniform scaling, are kept.
    """
    chord = np.diff(rows, axis=0)
    steps = _first_guess(chord, limits)
    best, best_total = steps, np.inf
    for sweep in range(_SWEEPS):
        ratio = _excess_of_differences(chord, steps, limits)
        total = float(ratio.max() * steps.sum())
        if total < best_total:
            best, best_total = steps, total
        width = min(_WIDEST * _WIDEST ** (-sweep / _SWEEPS), max(1.0, len(steps) / 4.0))
        steps = _corrected(steps, ratio, width)
    return best


def _refine(rows: Array, steps: Array, limits: FlightLimits) -> QuinticPath:
    """The same with the excess of the true motion instead of finite differences."""
    best, best_total = _spline(rows, steps), np.inf
    for _ in range(_REFINEMENTS):
        path = _spline(rows, steps)
        ratio = _excess_of_path(path, limits, _SAMPLES_PER_STEP)
        total = float(ratio.max() * path.duration)
        if total < best_total:
            best, best_total = path, total
        steps = _corrected(steps, ratio, _REFINED_WIDTH)
    return best


def _first_guess(chord: Array, limits: FlightLimits) -> Array:
    """Full speed, but no faster than jerk and acceleration allow from rest and to rest."""
    longest = _norms(chord)
    steps = np.maximum(longest / limits.v_max, MIN_STEP_S)
    distance = np.concatenate([[0.0], np.cumsum(longest)])
    steps = np.maximum(steps, np.diff(_time_from_rest(distance, limits)))
    from_end = np.diff(_time_from_rest((distance[-1] - distance)[::-1], limits))[::-1]
    return np.asarray(np.maximum(steps, from_end))


def _time_from_rest(distance: Array, limits: FlightLimits) -> Array:
    cubic = np.cbrt(6.0 * distance / limits.j_max)
    square = np.sqrt(2.0 * distance / limits.a_max) + 0.5 * limits.a_max / limits.j_max
    return np.where(distance > 0.0, np.maximum(cubic, square), 0.0)


def _corrected(steps: Array, ratio: Array, width: float) -> Array:
    """Steps times ratio^gain, the exponent smoothed by a Gaussian of `width` steps."""
    radius = int(np.ceil(3.0 * width))
    kernel = np.exp(-0.5 * (np.arange(-radius, radius + 1) / width) ** 2)
    change = _GAIN * np.log(np.maximum(ratio, _MIN_RATIO))
    smooth = np.convolve(np.pad(change, radius, mode="edge"), kernel / kernel.sum(), "valid")
    return np.asarray(np.maximum(steps * np.exp(smooth), MIN_STEP_S))


def _excess_of_differences(chord: Array, steps: Array, limits: FlightLimits) -> Array:
    """Excess of each step by finite differences, shape (T-1,); at rest before and after."""
    speed = chord / steps[:, None, None]
    rest = np.zeros((1, *speed.shape[1:]))
    padded = np.concatenate([steps[:1], steps, steps[-1:]])
    gap = 0.5 * (padded[1:] + padded[:-1])
    bend = np.diff(np.concatenate([rest, speed, rest]), axis=0) / gap[:, None, None]
    acceleration = _norms(bend)
    jerk = _norms(np.diff(bend, axis=0)) / steps
    # From rest, acceleration has to build up from nothing within the first step.
    jerk[0] = max(jerk[0], 2.0 * acceleration[0] / steps[0])
    jerk[-1] = max(jerk[-1], 2.0 * acceleration[-1] / steps[-1])
    return _combined(_norms(speed), np.maximum(acceleration[1:], acceleration[:-1]), jerk, limits)


def _excess_of_path(path: QuinticPath, limits: FlightLimits, samples: int) -> Array:
    """Excess of each step of a motion, shape (K-1,), from samples within it."""
    count = len(path.time) - 1

    def largest(fractions: Array, order: int) -> Array:
        values = path.at_fractions(fractions, order)
        return _norms(values.reshape(-1, *values.shape[2:])).reshape(count, -1).max(axis=1)

    # The jerk of a cubic is constant within a step; only the end steps are quintic.
    few = np.array([0.0, 0.5, 1.0])
    inside = np.linspace(0.0, 1.0, samples)
    return _combined(largest(inside, 1), largest(inside, 2), largest(few, 3), limits)


def _combined(speed: Array, acceleration: Array, jerk: Array, limits: FlightLimits) -> Array:
    """Scaling of time that brings speed [m/s], acceleration [m/s^2] and jerk [m/s^3] in limits."""
    ratios = [
        speed / limits.v_max,
        np.sqrt(acceleration / limits.a_max),
        np.cbrt(jerk / limits.j_max),
    ]
    return np.asarray(np.max(ratios, axis=0))


def _norms(vectors: Array) -> Array:
    """Largest length over the vehicles, shape (M,), of vectors of shape (M, N, 3)."""
    return np.asarray(np.sqrt((vectors**2).sum(axis=-1)).max(axis=-1))


def _spline(rows: Array, steps: Array) -> QuinticPath:
    """C2 motion through the rows: a clamped cubic spline inside, quintic first and last steps."""
    velocity = _clamped_velocities(rows, steps)
    acceleration = np.zeros_like(rows)
    h = steps[:, None, None]
    chord = np.diff(rows, axis=0)
    # Second derivative of the cubic Hermite piece at its beginning.
    acceleration[1:-1] = ((6 * chord / h - 4 * velocity[:-1] - 2 * velocity[1:]) / h)[1:]
    time = np.concatenate([[0.0], np.cumsum(steps)])
    return QuinticPath(time, rows, velocity, acceleration)


def _clamped_velocities(rows: Array, steps: Array) -> Array:
    """Knot velocities of the cubic spline that is at rest at both ends, shape of `rows`.

    Row i of the tridiagonal system: v[i-1]/h[i-1] + 2 (1/h[i-1] + 1/h[i]) v[i] + v[i+1]/h[i]
    = 3 (chord[i-1]/h[i-1]^2 + chord[i]/h[i]^2).
    """
    velocity = np.zeros_like(rows)
    if len(rows) < 3:
        return velocity
    inverse = 1.0 / steps
    slope = 3.0 * np.diff(rows, axis=0) * (inverse**2)[:, None, None]
    right = slope[:-1] + slope[1:]
    diagonal = 2.0 * (inverse[:-1] + inverse[1:])
    pivot = np.empty(len(diagonal))
    pivot[0] = diagonal[0]
    for i in range(1, len(diagonal)):
        factor = inverse[i] / pivot[i - 1]
        pivot[i] = diagonal[i] - factor * inverse[i]
        right[i] -= factor * right[i - 1]
    velocity[-2] = right[-1] / pivot[-1]
    for i in range(len(diagonal) - 2, -1, -1):
        velocity[i + 1] = (right[i] - inverse[i + 1] * velocity[i + 2]) / pivot[i]
    return velocity
