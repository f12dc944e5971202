# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Driving about without touching anything, by a planar lidar alone."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trident_nav.core.errors import require
from trident_nav.core.velocity import Velocity

_Floats = npt.NDArray[np.float64]

_MIN_TURN_RAD = 0.5
_MAX_TURN_RAD = 1.8
_DRIFT = 0.25  # of the turning rate, while driving


@dataclass(frozen=True)
class WanderConfig:
    """How to wander.

    Attributes:
        speed: on free ground [m/s].
        turn_rate: of turns on the spot [rad/s].
        half_width: of the robot about the lidar, with what is kept clear at its sides [m].
        stop_distance: from the lidar to what ends a drive [m].
        slow_distance: from where on it drives slower [m].
        seed: of what is left to chance.
    """

    speed: float = 0.3
    turn_rate: float = 0.8
    half_width: float = 0.22
    stop_distance: float = 0.5
    slow_distance: float = 1.2
    seed: int = 0

    def validate(self) -> None:
        """Raises NavError."""
        require("speed", self.speed, 0.01, 5.0, "m/s")
        require("turn_rate", self.turn_rate, 0.05, 10.0, "rad/s")
        require("half_width", self.half_width, 0.01, 5.0, "m")
        require("stop_distance", self.stop_distance, 0.02, 20.0, "m")
        require("slow_distance", self.slow_distance, self.stop_distance, 50.0, "m")
        require("seed", self.seed, 0, 2**32 - 1, "")


class Wander:
    """Drives in shallow curves; before an obstacle it turns on the spot to the freer side."""

    def __init__(self, config: WanderConfig) -> None:
        """Begin by driving.

        Raises:
            NavError: an illegal configuration.
        """
        config.validate()
        self._config = config
        self._random = np.random.default_rng(config.seed)
        self._turn = 0.0  # rate of the turn in progress [rad/s]; 0: driving
        self._turn_until_s = 0.0
        self._drift = 0.0
        self._drift_until_s = 0.0

    def command(self, time_s: float, angles: _Floats, ranges: _Floats) -> Velocity:
        """The velocity to drive with until the next scan.

        Args:
            time_s: of the scan [s].
            angles: of the beams in the robot's frame [rad], shape (n,).
            ranges: [m], shape (n,); inf: nothing in range; NaN and what is not above 0: no news.
        """
        ahead = self._free_ahead(angles, ranges)
        if self._turn and (time_s < self._turn_until_s or ahead <= self._config.slow_distance):
            return Velocity(0.0, self._turn)
        self._turn = 0.0
        if ahead <= self._config.stop_distance:
            self._begin_turn(time_s, angles, ranges)
            return Velocity(0.0, self._turn)
        return Velocity(self._speed(ahead), self._curve(time_s))

    def _free_ahead(self, angles: _Floats, ranges: _Floats) -> float:
        """How far the robot could go straight on [m]."""
        hit = (ranges > 0.0) & np.isfinite(ranges)
        x, y = ranges[hit] * np.cos(angles[hit]), ranges[hit] * np.sin(angles[hit])
        is_ahead = (x > 0.0) & (np.abs(y) < self._config.half_width)
        return float(x[is_ahead].min(initial=math.inf))

    def _begin_turn(self, time_s: float, angles: _Floats, ranges: _Floats) -> None:
        reach = 4.0 * self._config.slow_distance
        known = np.clip(ranges, 0.0, reach)[ranges > 0.0]
        side = np.sin(angles)[ranges > 0.0]
        balance = float(np.sum(known * np.sign(side)))
        sign = math.copysign(1.0, balance) if balance else 1.0
        angle = self._random.uniform(_MIN_TURN_RAD, _MAX_TURN_RAD)
        self._turn = sign * self._config.turn_rate
        self._turn_until_s = time_s + float(angle) / self._config.turn_rate

    def _speed(self, ahead: float) -> float:
        config = self._config
        span = config.slow_distance - config.stop_distance
        share = (ahead - config.stop_distance) / span if span > 0.0 else 1.0
        return config.speed * min(1.0, 0.2 + 0.8 * share)

    def _curve(self, time_s: float) -> float:
        if time_s >= self._drift_until_s:
            self._drift = float(self._random.uniform(-1.0, 1.0)) * _DRIFT * self._config.turn_rate
            self._drift_until_s = time_s + float(self._random.uniform(2.0, 6.0))
        return self._drift
