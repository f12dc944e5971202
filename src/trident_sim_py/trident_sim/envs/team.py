# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What environments of PettingZoo have in common: agents that begin and end together."""

from __future__ import annotations

import abc
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box

from trident_sim._core import Error
from trident_sim.envs.packages import require

require("pettingzoo")

from pettingzoo import AECEnv, ParallelEnv  # noqa: E402
from pettingzoo.utils.conversions import parallel_to_aec  # noqa: E402

Floats = npt.NDArray[np.float32]
ByAgent = dict[str, Any]
Result = tuple[ByAgent, dict[str, float], dict[str, bool], dict[str, bool], dict[str, ByAgent]]


class TeamEnv(ParallelEnv, abc.ABC):  # type: ignore[misc]
    """A team whose episode ends for all at once.

    Attributes:
        possible_agents: names.
        agents: those that act; none once the episode has ended.
        limit: actions in an episode.
    """

    render_mode: str | None = None

    def __init__(self, names: list[str], observation: Box, action: Box, limit: int) -> None:
        """Of agents whose spaces are alike."""
        if limit < 1:
            raise Error(f"limit is {limit}, legal: 1 or more")
        self.possible_agents, self.agents, self.limit = names, [], limit
        self._action = action
        self.observation_spaces = {name: _copy(observation) for name in names}
        self.action_spaces = {name: _copy(action) for name in names}
        self._random = np.random.default_rng()
        self._count = 0

    def observation_space(self, agent: str) -> Box:
        """Of an agent, always the same object."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> Box:
        """Of an agent, always the same object."""
        return self.action_spaces[agent]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[ByAgent, dict[str, ByAgent]]:
        """Begin an episode; `options` are not looked at."""
        del options
        if seed is not None:
            self._random = np.random.default_rng(seed)
        self.agents, self._count = self.possible_agents[:], 0
        observations = self._begin(self._random)
        return self._by_agent(observations), self._infos()

    def step(self, actions: ByAgent) -> Result:
        """All act at once; actions of others than `agents` are not looked at.

        Raises:
            trident_sim.Error: an agent has no action, or one that is not finite.
        """
        observations, rewards, ended = self._act(self._checked(actions))
        self._count += 1
        cut = self._count >= self.limit and not ended
        result: Result = (
            self._by_agent(observations),
            {name: float(reward) for name, reward in zip(self.agents, rewards, strict=True)},
            dict.fromkeys(self.agents, ended),
            dict.fromkeys(self.agents, cut),
            self._infos(),
        )
        if ended or cut:
            self.agents = []
        return result

    def _checked(self, actions: ByAgent) -> Floats:
        """The actions of all agents, shape (agents, n)."""
        missing = [name for name in self.agents if name not in actions]
        if missing or not self.agents:
            raise Error(f"step: no action of {missing}, legal: after reset(), one of each agent")
        rows = np.array([actions[name] for name in self.agents], dtype=np.float32)
        shape = (len(self.agents), *self._action.shape)
        if rows.shape != shape or not np.isfinite(rows).all():
            raise Error(f"step: actions are {rows.tolist()}, legal: {self._action.shape}, finite")
        return rows

    def _by_agent(self, rows: Floats) -> ByAgent:
        return dict(zip(self.possible_agents, rows, strict=True))

    def _infos(self) -> dict[str, ByAgent]:
        state = self._state_hash()
        return {name: {"state_hash": state} for name in self.possible_agents}

    @abc.abstractmethod
    def _begin(self, random: np.random.Generator) -> Floats:
        """Observations at the beginning of an episode, shape (agents, n)."""

    @abc.abstractmethod
    def _act(self, actions: Floats) -> tuple[Floats, npt.NDArray[np.float64], bool]:
        """Observations, rewards, and whether the episode has ended."""

    @abc.abstractmethod
    def _state_hash(self) -> str:
        """Of the whole state."""


def as_aec(env: TeamEnv) -> AECEnv:
    """The same environment, its agents one after the other."""
    return parallel_to_aec(env)


def _copy(box: Box) -> Box:
    return Box(box.low, box.high, dtype=np.float32)
