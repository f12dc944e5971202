# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`trident/Hover-v0`: come to a place in the air, and stay there."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from trident_sim._core import AgentSpec
from trident_sim.envs.camera import View
from trident_sim.envs.multirotor import (
    ACTIONS,
    WORLD,
    add_multirotor,
    multirotor_agent,
    randomize,
    spin_up,
)
from trident_sim.envs.options import Rewards
from trident_sim.envs.task import Task
from trident_sim.world import World

NAME = "uav"
_HEIGHT_M = 2.0
_OFFSET_M, _TILT_RAD, _SPEED_M_S = 0.8, 0.2, 0.4  # largest at the start, along or about each axis
_FAR_M, _UPRIGHT = 4.0, 0.2


class Hover(Task):
    """An episode begins near the place, tilted and moving, with rotors at the speed of a hover.

    It fails more than 4 m away, tilted by more than 78 degrees, or on the ground.
    """

    view = View((-4.0, -3.0, 3.5), (0.0, 0.0, _HEIGHT_M))
    default_rewards = Rewards(
        alive=1.0, distance=-0.5, speed=-0.05, turn_rate=-0.02, change=-0.02, failure=-50.0
    )
    default_actions, legal_actions = "rotors", ACTIONS
    default_observations = ("goal_offset_body", "velocity_body", "up", "rates")

    def __init__(self, *, vehicle: str = "firefly", **options: Any) -> None:
        """Choose a vehicle of RotorS, and what `Task` has."""
        super().__init__(**options)
        self.vehicle = vehicle

    def make_world(self) -> World:
        """RotorS' basic world with the vehicle in it."""
        world = World(WORLD, seed=self.world_seed, timing="direct")
        add_multirotor(world, NAME, self.vehicle, self.actions, (0.0, 0.0, 0.1))
        spin_up(world, [NAME], self.vehicle, self.actions)
        return world

    def agents(self, world: World) -> list[AgentSpec]:
        """The vehicle."""
        return [multirotor_agent(world, NAME, self.vehicle, self.actions, self.blocks)]

    def place(self, world: World, random: np.random.Generator) -> None:
        """Near the place."""
        model, spread = world.model(NAME), self.randomization.start
        draws = random.uniform(-1.0, 1.0, 9)
        x, y, z = spread * _OFFSET_M * draws[:3]
        roll, pitch = spread * _TILT_RAD * draws[3:5]
        yaw = min(spread, 1.0) * math.pi * draws[5]
        model.set_pose((x, y, max(_HEIGHT_M + z, 0.5), roll, pitch, yaw))
        model.set_velocity(spread * _SPEED_M_S * draws[6:])
        randomize(world, NAME, self.randomization, random)

    def goal(self, number: int, random: np.random.Generator) -> tuple[float, float, float, float]:
        """Always the same one."""
        del number, random
        return 0.0, 0.0, _HEIGHT_M, 0.0

    def failed(self, terms: Sequence[Any]) -> Any:
        """Too far, upset, or on the ground."""
        return (terms[0] > _FAR_M) | (terms[4] < _UPRIGHT) | (terms[8] > 0.0)
