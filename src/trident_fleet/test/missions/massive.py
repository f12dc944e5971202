# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Models of vehicles that have mass, behind the same guidance as those of the simulator."""

from __future__ import annotations

import math

import numpy as np
from trident_fleet.core.missions.guidance import (
    AirLimits,
    AirReference,
    GroundLimits,
    wheels_velocity,
)
from trident_fleet.core.missions.guided import REACHES, GuidedVehicle, Motion
from trident_fleet.core.missions.kinds import Kind
from trident_fleet.core.missions.scene import Place
from trident_fleet.core.missions.vehicle import SteppedVehicle

_PERIOD_S = 0.1


class _Moved(GuidedVehicle):
    """A guided vehicle that a model moves, a period at a time."""

    def __init__(self, kind: Kind, place: Place) -> None:
        looks_from_m = 20.0 if kind.domain == "air" else -math.inf
        super().__init__(place, REACHES[kind.domain], looks_from_m)
        self._reference = AirReference(np.array([*place, 0.0]), AirLimits(speed_m_s=kind.speed_m_s))
        self._wheels = Wheels()
        share = 0.9 if kind.domain == "water" else 1.0
        self._kind, self._limits = kind, GroundLimits(speed_m_s=share * kind.speed_m_s)

    def step(self, seconds: float) -> None:
        for _ in range(round(seconds / _PERIOD_S)):
            self.measured(self._flown() if self._kind.domain == "air" else self._driven())

    def _flown(self) -> Motion:
        position, velocity, _ = self._reference.advance(self.line, 25.0, False, 5)
        x, y, z = (float(value) for value in position[-1])
        return Motion((x, y), z, 0.0, float(np.hypot(*velocity[-1, :2])))

    def _driven(self) -> Motion:
        """On wheels; a vessel that turns as they do, but slowly."""
        wanted = wheels_velocity(self.motion, self.line, self._limits)
        if self._kind.domain == "water":
            wanted = wanted[0], min(max(wanted[1], -0.3), 0.3)
        return self._wheels.driven(self.motion, wanted)


class Wheels:
    """Two driven wheels, 0.6 m apart: what is asked for acts a period later, and builds up.

    Each wheel speeds up by 1 m/s^2 at most, whatever the other does.
    """

    def __init__(self) -> None:
        """At rest."""
        self._asked = (0.0, 0.0)
        self._rims = [0.0, 0.0]

    def driven(self, motion: Motion, wanted: tuple[float, float]) -> Motion:
        """Where a robot is a period later."""
        (speed, turn), self._asked = self._asked, wanted
        for index, goal in enumerate((speed - 0.3 * turn, speed + 0.3 * turn)):
            self._rims[index] += _bounded(goal - self._rims[index], 1.0 * _PERIOD_S)
        left, right = self._rims
        yaw, (x, y) = motion.yaw_rad + _PERIOD_S * (right - left) / 0.6, motion.place
        speed = 0.5 * (left + right)
        there_x = x + _PERIOD_S * speed * math.cos(yaw)
        there_y = y + _PERIOD_S * speed * math.sin(yaw)
        return Motion((there_x, there_y), 0.0, yaw, abs(speed))


def _bounded(value: float, most: float) -> float:
    return min(max(value, -most), most)


def massive(_name: str, kind: Kind, place: Place) -> SteppedVehicle:
    """A vehicle of a kind, at a place [m]: a `VehicleMaker`."""
    return _Moved(kind, place)
