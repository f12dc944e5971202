# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`trident/DriveRoom-v0`: drive to a place in a room without touching anything."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.ndimage import distance_transform_edt

from trident_sim._core import AgentSpec
from trident_sim.description import expand_xacro, find_resource
from trident_sim.envs.camera import View
from trident_sim.envs.options import Rewards
from trident_sim.envs.task import Task
from trident_sim.occupancy import FREE, MapConfig, occupancy_map
from trident_sim.world import World

NAME = "robot"
_WORLD = "package://trident_bringup/worlds/room.world"
_ROBOT = "package://trident_description/urdf/turtlebot3_burger.urdf.xacro"
_STEP_S, _FILE_STEP_S = "0.004", "0.001"  # the room's own steps are for heavier robots
_SPEED_M_S, _TURN_RAD_S = 0.22, 2.0
_CLEAR_M, _WITHIN_M, _TOUCH_M = 0.45, 0.3, 0.13
_SETTLE_STEPS = 250


@functools.lru_cache
def _robot() -> str:
    return expand_xacro(_ROBOT)


@functools.lru_cache
def _room() -> str:
    text = Path(find_resource(_WORLD)).read_text(encoding="utf-8")
    step = "<max_step_size>{}</max_step_size>"
    return text.replace(step.format(_FILE_STEP_S), step.format(_STEP_S))


@functools.lru_cache
def free_places() -> npt.NDArray[np.float64]:
    """Middles of cells that are far enough from everything, x and y [m], shape (n, 2)."""
    found = occupancy_map(World(_room()), MapConfig(resolution=0.1, start=(0.0, 0.0), reach=7.0))
    clear = distance_transform_edt(found.cells == FREE) * found.resolution > _CLEAR_M
    row, column = np.nonzero(clear)
    return np.column_stack([column + 0.5, row + 0.5]) * found.resolution + found.origin


class DriveRoom(Task):
    """A TurtleBot3 Burger begins anywhere in a room of 10 x 10 m; so is its goal.

    It sees 24 sectors of its lidar. It has arrived within 0.3 m, and fails at a touch.
    """

    steps = 50
    limit = 400
    beams = 24
    randomizes = ("start",)
    view = View((-6.5, -6.5, 9.0), (0.0, 0.0, 0.0))
    default_rewards = Rewards(progress=1.0, change=-0.005, arrival=10.0, failure=-10.0)
    default_actions, legal_actions = "twist", ("twist",)
    default_observations = ("scan", "goal_offset_body", "velocity_body", "rates")

    def make_world(self) -> World:
        """The room with the robot in its middle."""
        world = World(_room(), seed=self.world_seed, timing="direct")
        world.spawn(NAME, urdf=_robot(), pose=(0.0, 0.0, 0.0))
        world.ports[f"{NAME}/scan"].subscribe()
        world.step(_SETTLE_STEPS)
        return world

    def agents(self, world: World) -> list[AgentSpec]:
        """The robot: speed ahead to 0.22 m/s, yaw rate to 2 rad/s."""
        del world
        command, reach = [f"{NAME}/cmd_vel"], [_SPEED_M_S, _TURN_RAD_S]
        scan = f"{NAME}/scan"
        return [
            AgentSpec(
                NAME, self.actions, command, [0.0, 0.0], reach, [*self.blocks], scan, self.beams
            )
        ]

    def place(self, world: World, random: np.random.Generator) -> None:
        """Somewhere, at rest."""
        model, places = world.model(NAME), free_places()
        if self.randomization.start > 0.0:
            x, y = places[random.integers(len(places))]
            model.set_pose((x, y, model.position[2], 0.0, 0.0, random.uniform(-np.pi, np.pi)))
        model.set_velocity((0.0, 0.0, 0.0))

    def goal(self, number: int, random: np.random.Generator) -> tuple[float, float, float, float]:
        """Somewhere else."""
        places = free_places()
        x, y = places[random.integers(len(places))]
        return float(x), float(y), 0.0, 0.0

    def arrived(self, terms: Sequence[Any]) -> Any:
        """Near enough."""
        return terms[0] < _WITHIN_M

    def failed(self, terms: Sequence[Any]) -> Any:
        """Something is as near as the robot's edge, or it lies on its side."""
        return (terms[9] < _TOUCH_M) | (terms[4] < 0.5)
