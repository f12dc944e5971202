# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A server with two fireflies in lockstep with their controllers, for the tests of the lockstep."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from harness import Gazebo, Pilot, Process, pose

VEHICLES = ("UAV1", "UAV2")
# Stamp [s] and target [m] of each set-point, y relative to where the vehicle stands.
ROUTE = ((0.01, 0.0, 0.0, 1.0), (2.5, 1.0, 0.3, 1.5), (4.0, 0.5, -0.3, 1.2))
Y_OF = {"UAV1": 2.0, "UAV2": 0.0}
StartGazebo = Callable[..., Gazebo]


def start_pair(start_gazebo: StartGazebo, **params: Any) -> tuple[Gazebo, dict[str, Process]]:
    """A paused server with two fireflies and their controllers."""
    gazebo = start_gazebo(wait_for=len(VEHICLES), **params)
    for name in VEHICLES:
        gazebo.spawn(name, at=pose(0.0, Y_OF[name], 0.1))
    return gazebo, {name: gazebo.controller(name) for name in VEHICLES}


def send_route(pilot: Pilot) -> None:
    """Sends both vehicles all set-points of the route ahead of time."""
    for stamp, x, y, z in ROUTE:
        for name in VEHICLES:
            pilot.send(name, x, Y_OF[name] + y, z, stamp)


def hover(gazebo: Gazebo, pilot: Pilot, z: float = 1.0) -> None:
    """Has both at ``z`` above where they started; the world runs afterwards."""
    for name in VEHICLES:
        pilot.send(name, 0.0, Y_OF[name], z, 0.01)
    gazebo.ask("unpause_physics")
    gazebo.until(4.0)
    for name in VEHICLES:
        assert gazebo.position(name) == pytest.approx((0.0, Y_OF[name], z + 0.04), abs=0.05)


def hovers(gazebo: Gazebo, name: str, z: float = 1.0) -> bool:
    return gazebo.position(name) == pytest.approx((0.0, Y_OF[name], z + 0.04), abs=0.05)
