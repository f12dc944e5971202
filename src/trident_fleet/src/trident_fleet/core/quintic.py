# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Piecewise quintic motion of a fleet: C2, through given states at common knots."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

# Quintic Hermite basis in powers of u = (t - t_i) / h, as columns of (1, u, ..., u^5); rows:
# p0, h v0, h^2 a0, p1, h v1, h^2 a1. (De Boor, A Practical Guide to Splines, chapter IV.)
_BASIS = np.array(
    [
        [1.0, 0.0, 0.0, -10.0, 15.0, -6.0],
        [0.0, 1.0, 0.0, -6.0, 8.0, -3.0],
        [0.0, 0.0, 0.5, -1.5, 1.5, -0.5],
        [0.0, 0.0, 0.0, 10.0, -15.0, 6.0],
        [0.0, 0.0, 0.0, -4.0, 7.0, -3.0],
        [0.0, 0.0, 0.0, 0.5, -1.0, 0.5],
    ]
)


@dataclass(frozen=True)
class Motion:
    """Samples of a fleet's motion, in the world frame; M instants, N vehicles.

    Attributes:
        position: [m], shape (M, N, 3).
        velocity: [m/s], shape (M, N, 3).
        acceleration: [m/s^2], shape (M, N, 3).
    """

    position: Array
    velocity: Array
    acceleration: Array


@dataclass(frozen=True)
class QuinticPath:
    """Motion of N vehicles through K knots that they share; at rest outside of them.

    Attributes:
        time: knot times [s], strictly increasing, shape (K,).
        position: at the knots [m, world], shape (K, N, 3).
        velocity: at the knots [m/s, world], shape (K, N, 3).
        acceleration: at the knots [m/s^2, world], shape (K, N, 3).
    """

    time: Array
    position: Array
    velocity: Array
    acceleration: Array

    @property
    def duration(self) -> float:
        """Time between the first and the last knot [s]."""
        return float(self.time[-1] - self.time[0])

    def sample(self, time: Array) -> Motion:
        """Evaluate at times [s], shape (M,). Outside of the knots: at rest at the nearest end."""
        return Motion(
            position=self.derivative(time, 0),
            velocity=self.derivative(time, 1),
            acceleration=self.derivative(time, 2),
        )

    def derivative(self, time: Array, order: int) -> Array:
        """The `order`-th time derivative of position [m/s^order] at times [s], shape (M, N, 3)."""
        if len(self.time) == 1:
            held = np.repeat(self.position, len(time), axis=0)
            return held if order == 0 else np.zeros_like(held)
        clamped = np.clip(time, self.time[0], self.time[-1])
        segment = np.clip(
            np.searchsorted(self.time, clamped, side="right") - 1, 0, len(self.time) - 2
        )
        step = np.diff(self.time)[segment]
        weights = _weights((clamped - self.time[segment]) / step, order)
        h = step[:, None, None]
        total = np.zeros((len(time), *self.position.shape[1:]))
        for side in (0, 1):
            at = segment + side
            columns = weights[:, 3 * side : 3 * side + 3, None, None]
            total += columns[:, 0] * self.position[at]
            total += columns[:, 1] * (h * self.velocity[at])
            total += columns[:, 2] * (h * h * self.acceleration[at])
        return total / h**order

    def at_fractions(self, fractions: Array, order: int) -> Array:
        """The `order`-th derivative at the same fractions (0..1) of every step, (K-1, S, N, 3)."""
        h = np.diff(self.time)[:, None, None]
        columns = []
        for side in (slice(None, -1), slice(1, None)):
            columns += [
                self.position[side],
                h * self.velocity[side],
                h * h * self.acceleration[side],
            ]
        weights = _weights(fractions, order)
        total = weights[:, 0, None, None] * columns[0][:, None]
        for index in range(1, 6):
            total += weights[:, index, None, None] * columns[index][:, None]
        return np.asarray(total / h[:, None] ** order)

    def stretched(self, factor: float) -> QuinticPath:
        """The same path flown `factor` times slower, from the same first knot time."""
        return QuinticPath(
            time=self.time[0] + factor * (self.time - self.time[0]),
            position=self.position,
            velocity=self.velocity / factor,
            acceleration=self.acceleration / factor**2,
        )

    def shifted(self, delay: float) -> QuinticPath:
        """The same motion `delay` seconds later."""
        return QuinticPath(self.time + delay, self.position, self.velocity, self.acceleration)

    def then(self, other: QuinticPath) -> QuinticPath:
        """This motion, then `other`, whose first knot is this one's last one."""
        late = other.shifted(float(self.time[-1] - other.time[0]))
        return QuinticPath(
            time=np.concatenate([self.time, late.time[1:]]),
            position=np.concatenate([self.position, late.position[1:]]),
            velocity=np.concatenate([self.velocity, late.velocity[1:]]),
            acceleration=np.concatenate([self.acceleration, late.acceleration[1:]]),
        )


def rest_to_rest(start: Array, goal: Array, duration: float) -> QuinticPath:
    """Minimum-jerk motion between two rests (Flash and Hogan 1985), both of shape (N, 3) [m]."""
    still = np.zeros((2, *start.shape))
    return QuinticPath(np.array([0.0, duration]), np.stack([start, goal]), still, still)


def hold(position: Array, duration: float) -> QuinticPath:
    """Stay at `position` [m], shape (N, 3), for `duration` [s] > 0."""
    return rest_to_rest(position, position, duration)


def _weights(u: Array, order: int) -> Array:
    """Basis values, differentiated `order` times by u, shape (M, 6)."""
    basis = _BASIS
    for _ in range(order):
        basis = basis[:, 1:] * np.arange(1, basis.shape[1])
    powers = u[:, None] ** np.arange(basis.shape[1])
    # No BLAS: its threads would spin in each vehicle's process.
    return np.asarray(np.einsum("mp,bp->mb", powers, basis))
