# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`trident_formation_v0`: multirotors keep the places of a pattern that moves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box
from pettingzoo import AECEnv
from trident_fleet.core.patterns import Pattern, places

from trident_sim._core import Error, Rollout
from trident_sim.envs.camera import View, add_camera, picture
from trident_sim.envs.hover import Hover
from trident_sim.envs.multirotor import (
    WORLD,
    add_multirotor,
    multirotor_agent,
    randomize,
    spin_up,
)
from trident_sim.envs.options import Rewards, Terms
from trident_sim.envs.team import Floats, TeamEnv, as_aec
from trident_sim.world import World

_HEIGHT_M, _SPEED_M_S = 3.0, 0.5
_OFFSET_M = 0.3  # from its place at the start, along each axis
_NEAR_M, _FAR_M, _UPRIGHT = 0.6, 4.0, 0.2
_VIEW = View((-9.0, -7.0, 8.0), (0.0, 0.0, 2.5))


class _Flight(Hover):
    """The options of one vehicle; the goals are the formation's."""

    default_rewards = Rewards(
        alive=1.0, distance=-1.0, speed=-0.0, turn_rate=-0.01, change=-0.01, failure=-50.0
    )
    default_actions = "velocity"
    default_observations = ("goal_offset", "velocity", "rotation", "rates", "others")


class FormationEnv(TeamEnv):
    """Each vehicle has a place in a pattern, whose center moves straight ahead from the origin.

    The episode fails for all when one is more than 4 m from its place, upset, on the ground, or
    closer than 0.6 m to another.

    Attributes:
        world: to look at.
    """

    def __init__(
        self,
        *,
        vehicles: int = 4,
        pattern: Pattern | None = None,
        share: float = 0.5,
        limit: int = 1000,
        render_mode: str | None = None,
        **options: Any,
    ) -> None:
        """Make the world.

        Args:
            vehicles: how many, 2 to 100.
            pattern: of their places; None: a wedge, neighbors 1.5 m apart.
            share: of the team's mean in the reward of each, 0 to 1.
            limit: actions in an episode.
            render_mode: `rgb_array`, or None.
            options: of each vehicle, see `Task` and `Hover`.

        Raises:
            trident_sim.Error: an option has an illegal value.
        """
        if not 2 <= vehicles <= 100:
            raise Error(f"vehicles is {vehicles}, legal: 2 to 100")
        if not 0.0 <= share <= 1.0:
            raise Error(f"share is {share}, legal: 0 to 1")
        names = [f"uav_{index}" for index in range(vehicles)]
        self._task, self._share = _Flight(**options), share
        self._places = places(pattern or Pattern("wedge"), vehicles)
        self._places[:, 2] += _HEIGHT_M
        self.world = self._make_world(names)
        self._snapshot = self.world.save_snapshot()
        flight = self._task
        agents = [
            multirotor_agent(self.world, name, flight.vehicle, flight.actions, flight.blocks)
            for name in names
        ]
        self._rollout = Rollout([self.world._session], agents, flight.steps, 1)
        _, _, action_size, size = self._rollout.sizes
        low, high = flight.bounds(action_size, 0, vehicles)
        self._observations = np.zeros((vehicles, size), np.float32)
        self._terms = np.zeros((vehicles, len(Terms._fields)))
        self._heading, self._awake = 0.0, np.zeros(1, np.bool_)
        self.render_mode = render_mode
        self.metadata = {
            "name": "trident_formation_v0",
            "render_modes": ["rgb_array"],
            "render_fps": round(1.0 / self.world.dt),
            "is_parallelizable": True,
        }
        observation = Box(low.astype(np.float32), high.astype(np.float32), dtype=np.float32)
        super().__init__(names, observation, Box(-1.0, 1.0, (action_size,), np.float32), limit)

    def _make_world(self, names: list[str]) -> World:
        flight = self._task
        world = World(WORLD, seed=flight.world_seed, timing="direct")
        for name, (x, y, _) in zip(names, self._places.tolist(), strict=True):
            add_multirotor(world, name, flight.vehicle, flight.actions, (x, y, 0.1))
        spin_up(world, names, flight.vehicle, flight.actions)
        add_camera(world, _VIEW)
        return world

    def _goals(self) -> npt.NDArray[np.float64]:
        """Where each should be now: x, y, z, yaw, shape (vehicles, 4)."""
        along = _SPEED_M_S * self._count * self._task.steps * self.world.dt
        cos, sin = math.cos(self._heading), math.sin(self._heading)
        x, y, z = self._places.T
        return np.column_stack(
            [
                cos * (x + along) - sin * y,
                sin * (x + along) + cos * y,
                z,
                np.full(len(x), self._heading),
            ]
        )

    def _begin(self, random: np.random.Generator) -> Floats:
        self.world.restore_snapshot(self._snapshot)
        choice = self._task.randomization
        self._heading = min(choice.start, 1.0) * random.uniform(-math.pi, math.pi)
        goals = self._goals()
        for name, goal in zip(self.possible_agents, goals, strict=True):
            offset = choice.start * _OFFSET_M * random.uniform(-1.0, 1.0, 3)
            model = self.world.model(name)
            model.set_pose((*(goal[:3] + offset), 0.0, 0.0, goal[3]))
            model.set_velocity((0.0, 0.0, 0.0))
            randomize(self.world, name, choice, random)
        self._rollout.begin(0, goals)
        return self._rollout.observe(0)

    def _act(self, actions: Floats) -> tuple[Floats, npt.NDArray[np.float64], bool]:
        self._rollout.step(actions, self._awake, self._observations, self._terms)
        columns: Sequence[npt.NDArray[np.float64]] = self._terms.T
        own = np.broadcast_to(self._task.reward(columns), len(actions))
        failed = self._failed(columns)
        rewards = (1.0 - self._share) * own + self._share * own.mean()
        rewards = rewards + self._task.rewards.failure * failed
        self._rollout.set_goals(0, self._goals())
        return self._observations.copy(), rewards, failed

    def _failed(self, columns: Sequence[npt.NDArray[np.float64]]) -> bool:
        distance, up, contact, nearest = (columns[index] for index in (0, 4, 8, 9))
        failed = (distance > _FAR_M) | (up < _UPRIGHT) | (contact > 0.0) | (nearest < _NEAR_M)
        return bool(failed.any())

    def _state_hash(self) -> str:
        return self.world.state_hash()

    def render(self) -> npt.NDArray[np.uint8] | None:
        """A picture of the world, shape (height, width, 3); None without a `render_mode`."""
        return picture(self.world) if self.render_mode == "rgb_array" else None


def parallel_env(**options: Any) -> FormationEnv:
    """All act at once; see `FormationEnv` for the options."""
    return FormationEnv(**options)


def env(**options: Any) -> AECEnv:
    """One acts after the other; see `FormationEnv` for the options."""
    return as_aec(FormationEnv(**options))
