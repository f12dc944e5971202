# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What is learned: a world, an agent in it, goals, and what is rewarded."""

from __future__ import annotations

import abc
from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from trident_sim._core import AgentSpec, Error, block_names
from trident_sim.envs.camera import View
from trident_sim.envs.options import Judge, Randomization, Rewards, Terms, chosen, one_of
from trident_sim.world import World

Array = npt.NDArray[np.float64]

_FAR, _FAST = 1e8, 1e6  # beyond what a world lets bodies do
_BOUNDS: dict[str, tuple[float, float]] = {
    "goal_offset": (-_FAR, _FAR),
    "goal_offset_body": (-_FAR, _FAR),
    "goal_heading": (-1.0, 1.0),
    "rotation": (-1.0, 1.0),
    "quaternion": (-1.0, 1.0),
    "up": (-1.0, 1.0),
    "velocity": (-_FAST, _FAST),
    "velocity_body": (-_FAST, _FAST),
    "rates": (-_FAST, _FAST),
    "action": (-1.0, 1.0),
    "scan": (0.0, 1.0),
    "others": (-_FAR, _FAR),
}
_SIZES = {"goal_heading": 2, "rotation": 9, "quaternion": 4}  # others have 3, or are counted


class Task(abc.ABC):
    """One object serves any number of worlds: it keeps nothing of an episode.

    Attributes:
        steps: of a world that follow an action.
        goals: that are to be reached one after the other in an episode.
        limit: actions in an episode, unless `gymnasium.make` says otherwise.
        beams: that a scan of the agent's lidar is reduced to; 0: it has none.
        randomizes: fields of `Randomization` that have an effect; others are refused.
        view: of the camera that `render` looks through.
    """

    steps: ClassVar[int] = 1
    goals: ClassVar[int] = 1
    limit: ClassVar[int] = 500
    beams: ClassVar[int] = 0
    randomizes: ClassVar[tuple[str, ...]] = ("start", "mass", "wind")
    view: ClassVar[View]
    default_rewards: ClassVar[Rewards]
    default_actions: ClassVar[str]
    legal_actions: ClassVar[tuple[str, ...]]
    default_observations: ClassVar[tuple[str, ...]]

    def __init__(
        self,
        *,
        observations: Sequence[str] | None = None,
        actions: str | None = None,
        rewards: Rewards | dict[str, float] | Judge | None = None,
        randomization: Randomization | dict[str, Any] | None = None,
        world_seed: int = 0,
    ) -> None:
        """Choose.

        Args:
            observations: blocks of which an observation is made, in order.
            actions: what an action drives.
            rewards: weights, all or some, or a function of `Terms`.
            randomization: what differs from episode to episode.
            world_seed: of the noise of sensors.

        Raises:
            Error: an option has an illegal value.
        """
        self.blocks = tuple(self.default_observations if observations is None else observations)
        for block in self.blocks:
            one_of(block, block_names(), "observations: a block")
        if not self.blocks:
            raise Error(f"observations is empty, legal: {', '.join(block_names())}")
        chosen_actions = self.default_actions if actions is None else actions
        self.actions = one_of(chosen_actions, self.legal_actions, "actions")
        self._judge = rewards if callable(rewards) else None
        weights = None if callable(rewards) else rewards
        self.rewards = chosen(Rewards, weights, self.default_rewards)
        self._weights = self.rewards.weights()
        self.randomization = chosen(Randomization, randomization, Randomization())
        self._check_randomization()
        self.world_seed = world_seed

    def _check_randomization(self) -> None:
        default = Randomization()
        for name in ("mass", "wind"):
            value = getattr(self.randomization, name)
            if name not in self.randomizes and value != getattr(default, name):
                legal = getattr(default, name)
                raise Error(f"randomization: {name} is {value}, legal for this task: {legal}")

    @abc.abstractmethod
    def make_world(self) -> World:
        """A world with all that is in it, as an episode finds it before it is randomized."""

    @abc.abstractmethod
    def agents(self, world: World) -> list[AgentSpec]:
        """Who acts in it."""

    @abc.abstractmethod
    def place(self, world: World, random: np.random.Generator) -> None:
        """Put the vehicle where an episode begins."""

    @abc.abstractmethod
    def goal(self, number: int, random: np.random.Generator) -> tuple[float, float, float, float]:
        """The goal of that number: x, y, z, yaw in the world [m, rad]."""

    @abc.abstractmethod
    def failed(self, terms: Sequence[Any]) -> Any:
        """Whether the episode has failed, by terms in the order of `Terms`."""

    def arrived(self, terms: Sequence[Any]) -> Any:
        """Whether the goal is reached; by default it is to be held."""
        del terms
        return False

    def reward(self, terms: Sequence[Any]) -> Any:
        """Of one action, without what is for arrivals and failures."""
        if self._judge is not None:
            return self._judge(Terms(*terms))
        total = self.rewards.alive
        for index, weight in self._weights:
            total = total + weight * terms[index]
        return total

    def bounds(self, action_size: int, beams: int, agents: int) -> tuple[Array, Array]:
        """Least and largest values of an observation, shape (n,) each."""
        counted = {"action": action_size, "scan": beams, "others": 3 * (agents - 1)}
        sizes = [counted.get(block, _SIZES.get(block, 3)) for block in self.blocks]
        low, high = zip(*(_BOUNDS[block] for block in self.blocks), strict=True)
        return np.repeat(low, sizes), np.repeat(high, sizes)
