# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Places on the earth in the frame of a world that has an origin there: x east, y north, z up."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from trident_base.params import require

from trident_fleet.core.errors import FormationError
from trident_fleet.core.quintic import Array

# WGS 84 (NIMA TR8350.2).
_SEMI_MAJOR_M = 6378137.0
_FLATTENING = 1.0 / 298.257223563
_ECCENTRICITY2 = _FLATTENING * (2.0 - _FLATTENING)


@dataclass(frozen=True)
class Datum:
    """The origin of a world.

    Attributes:
        latitude_deg: geodetic, -90 to 90 [deg].
        longitude_deg: east of Greenwich, -180 to 180 [deg].
        height_m: above the ellipsoid [m].
    """

    latitude_deg: float
    longitude_deg: float
    height_m: float = 0.0

    def validate(self) -> None:
        """Raise FormationError on the first number that is not legal."""
        require("datum latitude", self.latitude_deg, -90.0, 90.0, "deg", FormationError)
        require("datum longitude", self.longitude_deg, -180.0, 180.0, "deg", FormationError)
        require("datum height", self.height_m, -1e4, 1e5, "m", FormationError)

    def position(self, latitude_deg: float, longitude_deg: float, height_m: float) -> Array:
        """A geodetic place in the world's frame [m], shape (3,)."""
        away = _earth_fixed(latitude_deg, longitude_deg, height_m) - _earth_fixed(
            self.latitude_deg, self.longitude_deg, self.height_m
        )
        phi, lam = math.radians(self.latitude_deg), math.radians(self.longitude_deg)
        east = np.array([-math.sin(lam), math.cos(lam), 0.0])
        up = np.array([math.cos(phi) * math.cos(lam), math.cos(phi) * math.sin(lam), math.sin(phi)])
        return np.array([away @ east, away @ np.cross(up, east), away @ up])


def _earth_fixed(latitude_deg: float, longitude_deg: float, height_m: float) -> Array:
    """In the earth's frame (ECEF) [m], shape (3,)."""
    phi, lam = math.radians(latitude_deg), math.radians(longitude_deg)
    radius = _SEMI_MAJOR_M / math.sqrt(1.0 - _ECCENTRICITY2 * math.sin(phi) ** 2)
    flat = (radius + height_m) * math.cos(phi)
    up = (radius * (1.0 - _ECCENTRICITY2) + height_m) * math.sin(phi)
    return np.array([flat * math.cos(lam), flat * math.sin(lam), up])
