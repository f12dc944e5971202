# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`trident/Waypoints-v0`: fly through random places one after the other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from trident_sim.envs.camera import View
from trident_sim.envs.hover import Hover
from trident_sim.envs.options import Rewards

_LOW, _HIGH = (-4.0, -4.0, 1.0), (4.0, 4.0, 3.5)  # of waypoints [m]
_WITHIN_M = 0.4
_FAR_M, _UPRIGHT = 14.0, 0.2


class Waypoints(Hover):
    """Five places in a box of 8 x 8 x 2.5 m, each reached within 0.4 m."""

    goals = 5
    limit = 2000
    view = View((-8.0, -6.0, 6.0), (0.0, 0.0, 2.0))
    default_rewards = Rewards(
        progress=1.0, turn_rate=-0.002, change=-0.005, arrival=10.0, failure=-20.0
    )
    default_actions = "rates"

    def goal(self, number: int, random: np.random.Generator) -> tuple[float, float, float, float]:
        """Anywhere in the box."""
        x, y, z = random.uniform(_LOW, _HIGH)
        return float(x), float(y), float(z), 0.0

    def arrived(self, terms: Sequence[Any]) -> Any:
        """Near enough."""
        return terms[0] < _WITHIN_M

    def failed(self, terms: Sequence[Any]) -> Any:
        """Too far, upset, or on the ground."""
        return (terms[0] > _FAR_M) | (terms[4] < _UPRIGHT) | (terms[8] > 0.0)
