# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""From when on map -> odom reflects a scan."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
_SAME = 1e-6  # [m], [rad]: the same correction, computed twice


def correction_of(T_map_base: Array, T_odom_base: Array) -> Array:
    """T_map_base * T_odom_base^-1."""
    yaw = T_map_base[2] - T_odom_base[2]
    c, s = math.cos(yaw), math.sin(yaw)
    x, y = T_odom_base[:2]
    return np.array([T_map_base[0] - c * x + s * y, T_map_base[1] - s * x - c * y, yaw])


def waits(
    sent: list[tuple[int, float, Array]],
    poses: dict[int, Array],
    corrections: list[tuple[float, Array]],
) -> list[float]:
    """How long each scan waited [s]; a scan that was replaced waits for the one that came instead.

    Args:
        sent: stamp [ns], time of publication [s] and odometry of each scan, in order.
        poses: T_map_base that the node published, by stamp.
        corrections: map -> odom as it was heard, and when [s].

    Returns:
        One wait per scan; infinite where no correction reflects it or a later one.
    """
    result = []
    reflected = math.inf
    for stamp, published, odometry in reversed(sent):
        if stamp in poses:
            expected = correction_of(poses[stamp], odometry)
            for heard, correction in corrections:
                off = correction - expected
                off[2] = math.remainder(off[2], 2.0 * math.pi)
                if heard >= published and np.abs(off).max() < _SAME:
                    reflected = heard
                    break
        result.append(reflected - published)
    return result[::-1]
