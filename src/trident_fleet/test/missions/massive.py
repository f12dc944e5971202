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
from trident_fleet.core.missions.guided import GuidedVehicle, Motion, guided
from trident_fleet.core.missions.kinds import Kind
from trident_fleet.core.missions.scene import Place
from trident_fleet.core.missions.vehicle import SteppedVehicle

_PERIOD_S = 0.1


class _Moved(GuidedVehicle):
    """A guided vehicle that a model moves, a period at a time."""

    def __init__(self, kind: Kind, place: Place) -> None:
        made = guided(kind, place)
        super().__init__(place, made._reach, made._looks_from_m)
        self._reference = AirReference(
            np.array([*place, 0.0]), AirLimits(speed_m_s=kind.speed_m_s)
        )
        self._kind, self._limits = kind, GroundLimits(speed_m_s=kind.speed_m_s)

    def step(self, seconds: float) -> None:
        for _ in range(round(seconds / _PERIOD_S)):
            self.measured(self._flown() if self._kind.domain == "air" else self._driven())

    def _flown(self) -> Motion:
        position, velocity, _ = self._reference.advance(self.line, 25.0, False, 5)
        x, y, z = (float(value) for value in position[-1])
        return Motion((x, y), z, 0.0, float(np.hypot(*velocity[-1, :2])))

    def _driven(self) -> Motion:
        """On wheels; a vessel that turns as they do, but slowly."""
        speed, turn = wheels_velocity(self.motion, self.line, self._limits)
        if self._kind.domain == "water":
            speed, turn = 0.9 * speed, min(max(turn, -0.3), 0.3)
        yaw = self.motion.yaw_rad + _PERIOD_S * turn
        x, y = self.place
        there = x + _PERIOD_S * speed * math.cos(yaw), y + _PERIOD_S * speed * math.sin(yaw)
        return Motion(there, 0.0, yaw, speed)


def massive(_name: str, kind: Kind, place: Place) -> SteppedVehicle:
    """A vehicle of a kind, at a place [m]: a `VehicleMaker`."""
    return _Moved(kind, place)
