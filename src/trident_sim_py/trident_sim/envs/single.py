# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Environments of Gymnasium: one world, one agent."""

from __future__ import annotations

from typing import Any, ClassVar

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box

from trident_sim._core import Error, Rollout
from trident_sim.envs.camera import picture
from trident_sim.envs.dock_boat import DockBoat
from trident_sim.envs.drive_room import DriveRoom
from trident_sim.envs.hover import Hover
from trident_sim.envs.stage import Stage
from trident_sim.envs.task import Task
from trident_sim.envs.waypoints import Waypoints

Floats = npt.NDArray[np.float32]


def spaces_of(task: Task, rollout: Rollout, beams: int) -> tuple[Box, Box]:
    """Of the observations and of the actions of one agent."""
    _, agents, action_size, _ = rollout.sizes
    low, high = task.bounds(action_size, beams, agents)
    return (
        Box(low.astype(np.float32), high.astype(np.float32), dtype=np.float32),
        Box(-1.0, 1.0, (action_size,), np.float32),
    )


class WorldEnv(gymnasium.Env[Floats, Floats]):
    """A world with one vehicle that learns a task.

    Attributes:
        task: with its options.
        world: to look at; what changes it by hand changes what is learned.
    """

    task_class: ClassVar[type[Task]]
    metadata: ClassVar[dict[str, Any]] = {"render_modes": ["rgb_array"], "render_fps": 30}  # type: ignore[misc]

    def __init__(self, *, render_mode: str | None = None, **options: Any) -> None:
        """Make the world.

        Args:
            render_mode: `rgb_array`, or None.
            options: of the task, see `Task`.

        Raises:
            trident_sim.Error: an option has an illegal value.
        """
        if render_mode not in (None, "rgb_array"):
            raise Error(f"render_mode is {render_mode!r}, legal: rgb_array")
        self.task = self.task_class(**options)
        self._stage = Stage(self.task)
        self.world = self._stage.world
        self.render_mode = render_mode
        period_s = self.task.steps * self.world.dt
        self.metadata = self.metadata | {"render_fps": round(1.0 / period_s)}  # type: ignore[misc]
        agents = self.task.agents(self.world)
        self._rollout = Rollout([self._stage.session], agents, self.task.steps, 1)
        self.observation_space, self.action_space = spaces_of(
            self.task, self._rollout, self._stage.beams
        )
        self._act, self._hash = self._rollout.step_one, self._rollout.state_hash

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Floats, dict[str, Any]]:
        """Begin an episode; `options` are not looked at."""
        super().reset(seed=seed)
        self._stage.begin(self._rollout, 0, self.np_random)
        return self._rollout.observe(0)[0], {"state_hash": self._hash(0)}

    def step(self, action: Floats) -> tuple[Floats, float, bool, bool, dict[str, Any]]:
        """Act, and let the world step.

        Raises:
            trident_sim.Error: the action is not finite, or has another size.
        """
        observation, terms = self._act(action)
        task = self.task
        reward = task.reward(terms)
        ended = task.failed(terms)
        if ended:
            reward += task.rewards.failure
        elif task.arrived(terms):
            reward += task.rewards.arrival
            ended = self._stage.next_goal(self._rollout, 0)
            observation = self._rollout.observe(0)[0]
        return observation, reward, ended, False, {"state_hash": self._hash(0)}

    def render(self) -> npt.NDArray[np.uint8] | None:  # type: ignore[override]
        """A picture of the world, shape (height, width, 3); None without a `render_mode`."""
        return picture(self.world) if self.render_mode == "rgb_array" else None


class HoverEnv(WorldEnv):
    """`trident/Hover-v0`."""

    task_class = Hover


class WaypointsEnv(WorldEnv):
    """`trident/Waypoints-v0`."""

    task_class = Waypoints


class DockBoatEnv(WorldEnv):
    """`trident/DockBoat-v0`."""

    task_class = DockBoat


class DriveRoomEnv(WorldEnv):
    """`trident/DriveRoom-v0`."""

    task_class = DriveRoom
