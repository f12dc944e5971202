# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What is known of a leader: its measured states, and which one counts at which instant."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from trident_fleet.core.encoding import NS_PER_S
from trident_fleet.core.quintic import Array

Quaternion = tuple[float, float, float, float]


_LARGEST = 1e8  # [m], [m/s], [rad], [rad/s]


@dataclass(frozen=True)
class Measurement:
    """What a message reports of a leader.

    Attributes:
        stamp_ns: when [ns].
        position: p_world [m], shape (3,).
        yaw_rad: heading of its x axis [rad, world].
        velocity: v_world [m/s], shape (3,); None where the message does not contain it.
        yaw_rate: [rad/s]; None where the message does not contain it.
    """

    stamp_ns: int
    position: Array
    yaw_rad: float
    velocity: Array | None = None
    yaw_rate: float | None = None

    @property
    def is_finite(self) -> bool:
        """Whether all values are plausible numbers of a vehicle: none beyond 1e8."""
        velocity = np.zeros(3) if self.velocity is None else self.velocity
        numbers = np.array([*self.position, *velocity, self.yaw_rad, self.yaw_rate or 0.0])
        return bool((np.abs(numbers) <= _LARGEST).all())


Decoder = Callable[[], Measurement | None]
"""What a message reports of the leader; None: nothing."""


@dataclass(frozen=True)
class LeaderState:
    """Motion of a leader at an instant.

    Attributes:
        stamp_ns: when [ns].
        position: p_world [m], shape (3,).
        velocity: v_world [m/s], shape (3,).
        acceleration: a_world [m/s^2], shape (3,).
        yaw_rad: heading of its x axis [rad, world].
        yaw_rate: [rad/s].
    """

    stamp_ns: int
    position: Array
    velocity: Array
    acceleration: Array
    yaw_rad: float
    yaw_rate: float


class LeaderTrack:
    """Measurements in the order of their stamps, and the state at one instant after the other.

    The newest measurement that is not younger than the instant counts. It is known for certain when
    one of that instant or later has come, so the result does not depend on when messages arrive.
    """

    def __init__(self) -> None:
        """Know nothing."""
        self._ahead: deque[tuple[int, Decoder]] = deque()
        self._reached_ns = -1
        self._counted: Measurement | None = None
        self._state: LeaderState | None = None

    def add(self, stamp_ns: int, decode: Decoder) -> None:
        """Take a message that is not older than those before; it is only decoded if it counts."""
        if stamp_ns > self._reached_ns:
            self._ahead.append((stamp_ns, decode))
            self._reached_ns = stamp_ns

    def is_known_at(self, time_ns: int) -> bool:
        """Whether the message that counts at `time_ns` has come, if there is one at all."""
        return self._reached_ns >= time_ns

    def at(self, time_ns: int) -> LeaderState | None:
        """The state by the measurement that counts; None before the first one.

        Instants are asked for in order. A message without finite numbers counts for nothing. What a
        measurement does not contain is its difference from the one that counted before.
        """
        past = []
        while self._ahead and self._ahead[0][0] <= time_ns:
            past.append(self._ahead.popleft())
        for stamp_ns, decode in reversed(past):
            measurement = decode()
            if measurement is not None and measurement.is_finite:
                measurement = replace(measurement, stamp_ns=stamp_ns)
                self._state = _complete(measurement, self._counted)
                self._counted = measurement
                break
        return self._state


def _complete(now: Measurement, before: Measurement | None) -> LeaderState:
    velocity, rate, acceleration = now.velocity, now.yaw_rate, np.zeros(3)
    if before is not None:
        elapsed_s = (now.stamp_ns - before.stamp_ns) / NS_PER_S
        if velocity is None:
            velocity = (now.position - before.position) / elapsed_s
        elif before.velocity is not None:
            acceleration = (velocity - before.velocity) / elapsed_s
        if rate is None:
            rate = wrapped(now.yaw_rad - before.yaw_rad) / elapsed_s
    return LeaderState(
        stamp_ns=now.stamp_ns,
        position=now.position,
        velocity=np.zeros(3) if velocity is None else velocity,
        acceleration=acceleration,
        yaw_rad=now.yaw_rad,
        yaw_rate=rate or 0.0,
    )


def yaw_of(quaternion: Quaternion) -> float:
    """Heading of the x axis of a body whose attitude is (x, y, z, w) [rad]."""
    x, y, z, w = quaternion
    return math.atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z)


def rotate(quaternion: Quaternion, vector: Array) -> Array:
    """Components in the world of a vector given in a body's axes, shape (3,).

    A quaternion of zero length, which senders leave where they know no attitude, turns nothing.
    """
    x, y, z, w = quaternion
    length2 = x * x + y * y + z * z + w * w
    if length2 <= 0.0:
        return vector
    axis = np.array([x, y, z])
    twice = 2.0 * np.cross(axis, vector) / length2
    return np.asarray(vector + w * twice + np.cross(axis, twice))


def wrapped(angle_rad: float) -> float:
    """The same angle between -pi and pi."""
    return math.remainder(angle_rad, 2.0 * math.pi)
