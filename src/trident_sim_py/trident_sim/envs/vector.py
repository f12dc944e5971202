# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The same environments as vectors: worlds that threads step side by side."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from trident_sim._core import Error, Rollout
from trident_sim.envs.dock_boat import DockBoat
from trident_sim.envs.drive_room import DriveRoom
from trident_sim.envs.hover import Hover
from trident_sim.envs.options import Terms
from trident_sim.envs.single import Floats, spaces_of
from trident_sim.envs.stage import Stage
from trident_sim.envs.task import Task
from trident_sim.envs.waypoints import Waypoints

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]
Step = tuple[Floats, Array, Mask, Mask, dict[str, Any]]


class WorldVectorEnv(VectorEnv[Floats, Floats, npt.NDArray[Any]]):
    """Worlds of one task side by side. Which thread steps which world does not change results.

    An environment that has ended begins again with its next step, whose action is not looked at.

    Attributes:
        task: with its options.
        worlds: one for each environment.
    """

    task_class: ClassVar[type[Task]]

    def __init__(
        self,
        num_envs: int = 1,
        *,
        threads: int | None = None,
        hashes: bool = True,
        max_episode_steps: int | None = None,
        **options: Any,
    ) -> None:
        """Make the worlds.

        Args:
            num_envs: how many, 1 or more.
            threads: that step them; None: one for each core.
            hashes: whether steps give `state_hash`es.
            max_episode_steps: after which an episode is cut off; None: the task's.
            options: of the task, see `Task`.

        Raises:
            trident_sim.Error: an option has an illegal value.
        """
        count = len(os.sched_getaffinity(0)) if threads is None else threads
        for name, value in (("num_envs", num_envs), ("threads", count)):
            if value < 1:
                raise Error(f"{name} is {value}, legal: 1 or more")
        self.num_envs, self.task, self._hashes = num_envs, self.task_class(**options), hashes
        self._limit = self.task.limit if max_episode_steps is None else max_episode_steps
        self._stages = [Stage(self.task) for _ in range(num_envs)]
        self.worlds = [stage.world for stage in self._stages]
        sessions = [stage.session for stage in self._stages]
        agents = self.task.agents(self.worlds[0])
        self._rollout = Rollout(sessions, agents, self.task.steps, min(count, num_envs))
        spaces = spaces_of(self.task, self._rollout, self.task.beams)
        self.single_observation_space, self.single_action_space = spaces
        self.observation_space, self.action_space = (batch_space(one, num_envs) for one in spaces)
        self.metadata = {"autoreset_mode": AutoresetMode.NEXT_STEP, "render_modes": []}
        self._randoms = [np.random.default_rng() for _ in range(num_envs)]
        self._observations = np.zeros((num_envs, self._rollout.sizes[3]), np.float32)
        self._terms = np.zeros((num_envs, len(Terms._fields)))
        self._counts = np.zeros(num_envs, np.int64)
        self._ended = np.zeros(num_envs, np.bool_)

    def reset(
        self,
        *,
        seed: int | Sequence[int] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Floats, dict[str, Any]]:
        """Begin all episodes; of one seed, environment i gets seed + i."""
        del options
        if seed is not None:
            self._seed(seed)
        for index in range(self.num_envs):
            self._begin(index)
        self._ended[:] = False
        return self._observations.copy(), self._info()

    def step(self, actions: Floats) -> Step:
        """Act in all worlds, and let them step, without the interpreter's lock.

        Raises:
            trident_sim.Error: an action is not finite, or there are more or fewer of them.
        """
        resting = self._ended
        self._rollout.step(actions, resting, self._observations, self._terms)
        self._counts += 1
        columns = self._terms.T
        rewards = np.broadcast_to(self.task.reward(columns), self.num_envs).astype(np.float64)
        failed = self.task.failed(columns) & ~resting
        arrived = self.task.arrived(columns) & ~failed & ~resting
        rewards += self.task.rewards.failure * failed + self.task.rewards.arrival * arrived
        rewards[resting] = 0.0
        terminated = np.array(failed)
        for index in np.flatnonzero(arrived):
            terminated[index] = self._stages[index].next_goal(self._rollout, int(index))
            self._observations[index] = self._rollout.observe(int(index))[0]
        for index in np.flatnonzero(resting):
            self._begin(int(index))
        truncated = (self._counts >= self._limit) & ~terminated
        self._ended = terminated | truncated
        return self._observations.copy(), rewards, terminated, truncated, self._info()

    def _seed(self, seed: int | Sequence[int]) -> None:
        seeds = [seed + i for i in range(self.num_envs)] if isinstance(seed, int) else [*seed]
        if len(seeds) != self.num_envs:
            raise Error(f"seed has {len(seeds)} numbers, legal: one, or {self.num_envs}")
        self._randoms = [np.random.default_rng(one) for one in seeds]

    def _begin(self, index: int) -> None:
        self._stages[index].begin(self._rollout, index, self._randoms[index])
        self._observations[index] = self._rollout.observe(index)[0]
        self._counts[index] = 0

    def _info(self) -> dict[str, Any]:
        if not self._hashes:
            return {}
        hashes = [self._rollout.state_hash(index) for index in range(self.num_envs)]
        present = np.ones(self.num_envs, np.bool_)
        return {"state_hash": np.array(hashes, dtype=object), "_state_hash": present}


class HoverVectorEnv(WorldVectorEnv):
    """`trident/Hover-v0`, vectorized."""

    task_class = Hover


class WaypointsVectorEnv(WorldVectorEnv):
    """`trident/Waypoints-v0`, vectorized."""

    task_class = Waypoints


class DockBoatVectorEnv(WorldVectorEnv):
    """`trident/DockBoat-v0`, vectorized."""

    task_class = DockBoat


class DriveRoomVectorEnv(WorldVectorEnv):
    """`trident/DriveRoom-v0`, vectorized."""

    task_class = DriveRoom
