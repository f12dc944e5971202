# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Velocity of a ground robot."""

from __future__ import annotations

from typing import NamedTuple


class Velocity(NamedTuple):
    """In the robot's frame.

    Attributes:
        linear: along x [m/s].
        angular: about z [rad/s].
    """

    linear: float
    angular: float


STOP = Velocity(0.0, 0.0)
