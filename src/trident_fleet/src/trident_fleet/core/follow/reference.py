# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A smooth motion that keeps up with a leader: what its followers are attached to."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trident_fleet.core.config import check_positive
from trident_fleet.core.encoding import NS_PER_S
from trident_fleet.core.follow.leader import LeaderState, wrapped
from trident_fleet.core.quintic import Array

# A state is extrapolated with its acceleration no longer than this [s].
_ACCELERATES_S = 0.25
_YAW_GROWTH = 4.0  # yaw acceleration by the fastest turn [1/s]


@dataclass(frozen=True)
class ReferenceConfig:
    """How a leader is kept up with.

    Attributes:
        bandwidth: of the smoothing [rad/s]: higher follows closer and passes on more noise.
        v_max: fastest leader that is kept up with [m/s].
        a_max: acceleration [m/s^2].
        closing_speed: at which a distance that has opened is closed [m/s].
        yaw_rate_max: fastest turn that is followed [rad/s].
    """

    bandwidth: float = 12.0
    v_max: float = 3.0
    a_max: float = 3.0
    closing_speed: float = 0.8
    yaw_rate_max: float = 1.5

    def validate(self) -> None:
        """Raise FormationError on the first field with an illegal value."""
        check_positive(self)


@dataclass(frozen=True)
class Drift:
    """Position and yaw with their first and second derivatives, M samples; x, y, z, yaw.

    Attributes:
        place: [m, world] and [rad], shape (M, 4).
        rate: [m/s, world] and [rad/s], shape (M, 4).
        growth: [m/s^2, world] and [rad/s^2], shape (M, 4).
    """

    place: Array
    rate: Array
    growth: Array


class Reference:
    """Third-order filter on the extrapolated state of a leader.

    With the extrapolated motion q and the bandwidth w, the jerk is
    w^3 (q - x) + 3 w^2 (q' - v) + 3 w (q'' - a): three equal poles at -w, no lag behind a leader of
    constant acceleration, and no steps up to the acceleration. The distance q - x is limited to
    what the closing speed answers.
    """

    def __init__(self, config: ReferenceConfig) -> None:
        """Follow nobody yet."""
        self._config = config
        self._state: _Triple | None = None

    def advance(self, leader: LeaderState, start_ns: int, point_ns: int, count: int) -> Drift:
        """The motion at `start_ns` and `count - 1` times `point_ns` later; the next call continues.

        Args:
            leader: its newest state.
            start_ns: where the last call ended [ns]; the first one begins with the leader itself.
            point_ns: step [ns].
            count: of the samples.
        """
        samples = []
        for index in range(count):
            age_s = (start_ns + index * point_ns - leader.stamp_ns) / NS_PER_S
            target = _extrapolated(leader, age_s, self._config)
            state = target if self._state is None else self._state
            samples.append(state)
            self._state = _stepped(state, target, point_ns / NS_PER_S, self._config)
        return Drift(*(np.array([sample[order] for sample in samples]) for order in range(3)))


# Lists of four: numpy takes a hundred times as long for so few numbers, point by point.
_Four = list[float]
_Triple = tuple[_Four, _Four, _Four]


def _stepped(state: _Triple, target: _Triple, dt: float, config: ReferenceConfig) -> _Triple:
    """The state `dt` later, with a constant jerk."""
    x, v, a = state
    pairs = zip(target, state, strict=True)
    apart, faster, growing = ([goal[i] - own[i] for i in range(4)] for goal, own in pairs)
    apart[3] = wrapped(apart[3])
    k1, k2, k3 = 3.0 * config.bandwidth, 3.0 * config.bandwidth**2, config.bandwidth**3
    reach = 3.0 / config.bandwidth
    _limit(apart, reach * config.closing_speed, reach * config.yaw_rate_max)
    grown = [a[i] + (k3 * apart[i] + k2 * faster[i] + k1 * growing[i]) * dt for i in range(4)]
    _limit(grown, config.a_max, _YAW_GROWTH * config.yaw_rate_max)
    bent = dt * dt / 6.0
    return (
        [x[i] + v[i] * dt + (2.0 * a[i] + grown[i]) * bent for i in range(4)],
        [v[i] + 0.5 * (a[i] + grown[i]) * dt for i in range(4)],
        grown,
    )


def _extrapolated(leader: LeaderState, age_s: float, config: ReferenceConfig) -> _Triple:
    """Place, rate and growth of a leader `age_s` after its state."""
    bent_s = min(max(age_s, 0.0), _ACCELERATES_S)
    arc = bent_s * (age_s - 0.5 * bent_s)
    place = [*leader.position.tolist(), leader.yaw_rad]
    rate = [*leader.velocity.tolist(), leader.yaw_rate]
    growth = [*leader.acceleration.tolist(), 0.0]
    _limit(rate, config.v_max, config.yaw_rate_max)
    _limit(growth, config.a_max, math.inf)
    return (
        [place[i] + rate[i] * age_s + growth[i] * arc for i in range(4)],
        [rate[i] + growth[i] * bent_s for i in range(4)],
        growth,
    )


def _limit(four: _Four, most: float, most_yaw: float) -> None:
    """Limit the length of (x, y, z) and the size of yaw, in place."""
    length = math.sqrt(four[0] * four[0] + four[1] * four[1] + four[2] * four[2])
    if length > most:
        four[:3] = [part * (most / length) for part in four[:3]]
    four[3] = min(max(four[3], -most_yaw), most_yaw)
