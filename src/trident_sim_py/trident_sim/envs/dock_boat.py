# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`trident/DockBoat-v0`: bring a boat with two propellers into its berth."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from trident_sim._core import AgentSpec, TextCommand
from trident_sim.description import expand_xacro
from trident_sim.envs.camera import View
from trident_sim.envs.options import Rewards
from trident_sim.envs.task import Task
from trident_sim.world import World

NAME = "boat"
_WORLD = "package://trident_bringup/worlds/ocean.world"
_BOAT = "package://trident_description/urdf/heron.urdf.xacro"
_START_M, _SPREAD = (-9.0, 0.0), (3.0, 4.0, 0.8)  # x, y [m], yaw [rad]
_WITHIN_M, _SLOW_M_S, _ALIGNED_RAD, _FAR_M = 0.4, 0.3, 0.25, 30.0
_SETTLE_STEPS = 500
_PARTS = {
    "left": (0.0, 1.15, 3.4, 0.3),
    "right": (0.0, -1.15, 3.4, 0.3),
    "end": (1.6, 0.0, 0.3, 2.6),
}
"""Of the berth: middle x and y, size along x and y [m]."""


@functools.lru_cache
def _boat() -> str:
    return expand_xacro(_BOAT, lidar=False)


def _dock() -> str:
    boxes = "".join(
        f'<{kind} name="{name}"><pose>{x} {y} 0.2 0 0 0</pose>'
        f"<geometry><box><size>{length} {width} 1.2</size></box></geometry></{kind}>"
        for name, (x, y, length, width) in _PARTS.items()
        for kind in ("collision", "visual")
    )
    model = f'<model name="dock"><static>true</static><link name="link">{boxes}</link></model>'
    return f'<sdf version="1.6">{model}</sdf>'


class DockBoat(Task):
    """A Heron in sea state 2 begins some 9 m before a berth that is 2 m wide.

    It has arrived within 0.4 m of the middle, slower than 0.3 m/s, turned by at most 0.25 rad.
    """

    steps = 10
    limit = 600
    randomizes = ("start", "wind")
    view = View((-7.0, -8.0, 8.0), (-3.0, 0.0, 0.0))
    default_rewards = Rewards(
        progress=1.0, heading=-0.005, change=-0.01, contact=-0.05, arrival=20.0, failure=-10.0
    )
    default_actions, legal_actions = "thrusters", ("thrusters",)
    default_observations = ("goal_offset_body", "goal_heading", "velocity_body", "rates")

    def make_world(self) -> World:
        """The open sea with a dock."""
        world = World(_WORLD, seed=self.world_seed, timing="direct")
        world.spawn("dock", sdf=_dock())
        world.spawn(NAME, urdf=_boat(), pose=(*_START_M, 0.0))
        world.step(_SETTLE_STEPS)
        return world

    def agents(self, world: World) -> list[AgentSpec]:
        """The boat: parts of full thrust, left and right."""
        del world
        ports = [f"{NAME}/thrusters/{side}_thrust_cmd" for side in ("left", "right")]
        return [AgentSpec(NAME, self.actions, ports, [0.0, 0.0], [1.0, 1.0], [*self.blocks])]

    def place(self, world: World, random: np.random.Generator) -> None:
        """Before the berth, at rest; the wind is the sea's, and pushes the boat."""
        spread = self.randomization.start
        x, y, yaw = spread * np.array(_SPREAD) * random.uniform(-1.0, 1.0, 3)
        model = world.model(NAME)
        model.set_pose((_START_M[0] + x, _START_M[1] + y, model.position[2], 0.0, 0.0, yaw))
        model.set_velocity((0.0, 0.0, 0.0))
        if self.randomization.wind > 0.0:
            speed = self.randomization.wind * math.sqrt(random.random())
            wind = f"{{speed: {speed:.6f}, direction: {random.uniform(-3.14, 3.14):.6f}}}"
            world.ports["environment/wind"].write(TextCommand(wind))

    def goal(self, number: int, random: np.random.Generator) -> tuple[float, float, float, float]:
        """The berth."""
        del number, random
        return 0.0, 0.0, 0.0, 0.0

    def arrived(self, terms: Sequence[Any]) -> Any:
        """In the berth, slow and straight."""
        near, slow = terms[0] < _WITHIN_M, terms[2] < _SLOW_M_S
        return near & slow & (terms[5] < _ALIGNED_RAD)

    def failed(self, terms: Sequence[Any]) -> Any:
        """Too far away, or capsized."""
        return (terms[0] > _FAR_M) | (terms[4] < 0.0)
