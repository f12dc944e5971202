# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Places that are counted from where a vehicle starts, and where the world is on the earth."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from trident_nav.core.errors import NavError, require

_Floats = npt.NDArray[np.float64]

_WGS84_A_M = 6378137.0
_WGS84_F = 1.0 / 298.257223563


def numbers(name: str, given: Any, count: int) -> list[float]:
    """A list of `count` finite numbers.

    Raises:
        NavError: it is not.
    """
    try:
        values = [float(value) for value in given]
    except (TypeError, ValueError) as error:
        raise NavError(f"{name}: {given!r}; legal: {count} numbers") from error
    if len(values) != count or not all(math.isfinite(value) for value in values):
        raise NavError(f"{name}: {given!r}; legal: {count} finite numbers")
    return values


def from_start(start: Sequence[float], places: Sequence[Sequence[float]]) -> _Floats:
    """Places ahead and left of a start as places of the frame that the start is given in.

    Args:
        start: x, y [m] and yaw [rad].
        places: x ahead, y left [m]; what comes after them is left out, shape (n, >= 2).

    Returns:
        x, y [m], shape (n, 2).

    Raises:
        NavError: not such numbers, or no place.
    """
    x, y, yaw = numbers("start", start, 3)
    if not isinstance(places, (list, tuple)) or not places:
        raise NavError(f"waypoints: {places!r}; legal: a list of one or more [x, y]")
    ahead = np.array([numbers("waypoints", place[:2], 2) for place in places])
    c, s = math.cos(yaw), math.sin(yaw)
    return np.asarray(np.array([x, y]) + ahead @ np.array([[c, s], [-s, c]]))


def earth_from_world(
    latitude_deg: float, longitude_deg: float, height_m: float
) -> tuple[_Floats, _Floats]:
    """Where an east-north-up frame is in the earth-centred one (ECEF, WGS 84).

    Returns:
        Its origin [m], shape (3,), and its rotation, shape (3, 3).

    Raises:
        NavError: an angle that is out of range.
    """
    require("latitude", latitude_deg, -90.0, 90.0, "deg")
    require("longitude", longitude_deg, -180.0, 180.0, "deg")
    phi, lam = math.radians(latitude_deg), math.radians(longitude_deg)
    e2 = _WGS84_F * (2.0 - _WGS84_F)
    n = _WGS84_A_M / math.sqrt(1.0 - e2 * math.sin(phi) ** 2)
    origin = np.array(
        [
            (n + height_m) * math.cos(phi) * math.cos(lam),
            (n + height_m) * math.cos(phi) * math.sin(lam),
            (n * (1.0 - e2) + height_m) * math.sin(phi),
        ]
    )
    east = [-math.sin(lam), math.cos(lam), 0.0]
    north = [-math.sin(phi) * math.cos(lam), -math.sin(phi) * math.sin(lam), math.cos(phi)]
    up = [math.cos(phi) * math.cos(lam), math.cos(phi) * math.sin(lam), math.sin(phi)]
    return origin, np.array([east, north, up]).T


def quaternion(rotation: _Floats) -> tuple[float, float, float, float]:
    """x, y, z, w of a rotation, shape (3, 3).

    Shepperd, J. Guidance and Control 1, 223 (1978): by the largest component.
    """
    trace = float(np.trace(rotation))
    squares = [*(1.0 + 2.0 * float(rotation[i, i]) - trace for i in range(3)), 1.0 + trace]
    largest = int(np.argmax(squares))
    root = math.sqrt(squares[largest])
    difference = [
        float(rotation[(i + 2) % 3, (i + 1) % 3] - rotation[(i + 1) % 3, (i + 2) % 3])
        for i in range(3)
    ]
    if largest == 3:
        x, y, z = (value / (2.0 * root) for value in difference)
        return (x, y, z, root / 2.0)
    values = [
        root / 2.0
        if i == largest
        else float(rotation[i, largest] + rotation[largest, i]) / root / 2
        for i in range(3)
    ]
    return (values[0], values[1], values[2], difference[largest] / (2.0 * root))
