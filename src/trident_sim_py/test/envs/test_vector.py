# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The vector form gives what single environments give, whatever the number of threads."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
import pytest
from trident_sim.envs.vector import HoverVectorEnv, WaypointsVectorEnv

import trident_sim

Results = list[tuple[list[float], float, bool, bool, str]]


def roll_vector(env: Any, seed: int, steps: int, actions: np.ndarray[Any, Any]) -> list[Results]:
    observations, infos = env.reset(seed=seed)
    rows: list[Results] = [[] for _ in range(env.num_envs)]
    for step in range(steps):
        observations, rewards, ended, cut, infos = env.step(actions[step])
        for i, row in enumerate(rows):
            row.append(
                (
                    observations[i].tolist(),
                    float(rewards[i]),
                    bool(ended[i]),
                    bool(cut[i]),
                    infos["state_hash"][i],
                )
            )
    return rows


def roll_single(name: str, seed: int, actions: np.ndarray[Any, Any], **options: Any) -> Results:
    """Begins again with the step after an end, as the vector form does."""
    env = gymnasium.make(f"trident/{name}-v0", **options)
    env.reset(seed=seed)
    rows: Results = []
    over = False
    for action in actions:
        if over:
            observation, info = env.reset()
            reward, ended, cut = 0.0, False, False
        else:
            observation, reward, ended, cut, info = env.step(action)
        over = ended or cut
        rows.append((observation.tolist(), float(reward), ended, cut, info["state_hash"]))
    return rows


@pytest.mark.parametrize("threads", [1, 3])
def test_a_vector_is_its_single_environments(threads: int) -> None:
    count, steps = 3, 60
    options = {"randomization": {"mass": (0.9, 1.1)}, "max_episode_steps": 25}
    actions = np.random.default_rng(3).uniform(-1.0, 1.0, (steps, count, 6)).astype(np.float32)
    env = HoverVectorEnv(count, threads=threads, **options)
    found = roll_vector(env, 40, steps, actions)
    for index in range(count):
        wanted = roll_single("Hover", 40 + index, actions[:, index], **options)
        assert any(row[2] or row[3] for row in wanted)
        for (a, b, *c), (x, y, *z) in zip(found[index], wanted, strict=True):
            assert (a, c) == (x, z)
            assert b == pytest.approx(y, rel=1e-12)


def test_goals_that_are_reached_are_followed_by_the_next() -> None:
    env = WaypointsVectorEnv(2, threads=2, actions="velocity", observations=["goal_offset"])
    observations, _ = env.reset(seed=3)
    reached, ended = np.zeros(2), np.zeros(2, bool)
    while not ended.any():
        lengths = np.linalg.norm(observations, axis=1, keepdims=True)
        actions = np.hstack([observations / lengths, np.zeros((2, 1))]).astype(np.float32)
        observations, rewards, ended, cut, _ = env.step(actions)
        reached += rewards > 9.0
        assert not cut.any()
    assert reached[ended].tolist() == [5.0] * int(ended.sum())


def test_gymnasium_makes_it() -> None:
    env = gymnasium.make_vec("trident/Hover-v0", num_envs=2, hashes=False, threads=1)
    observations, infos = env.reset(seed=[4, 4])
    assert (observations[0] == observations[1]).all()
    assert infos == {}
    assert env.action_space.shape == (2, 6)
    assert env.observation_space.contains(observations)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"num_envs": 0}, "num_envs is 0, legal: 1 or more"),
        ({"num_envs": 2, "threads": 0}, "threads is 0, legal: 1 or more"),
    ],
)
def test_a_senseless_number_is_refused(options: dict[str, int], message: str) -> None:
    with pytest.raises(trident_sim.Error, match=message):
        HoverVectorEnv(**options)


def test_seeds_must_be_as_many_as_environments() -> None:
    env = HoverVectorEnv(2, threads=1)
    with pytest.raises(trident_sim.Error, match="seed has 3 numbers, legal: one, or 2"):
        env.reset(seed=[1, 2, 3])
    actions = np.zeros((2, 6), np.float32)
    actions[1, 2] = np.inf
    env.reset(seed=1)
    with pytest.raises(trident_sim.Error, match=r"action\[8\] is inf, legal: finite"):
        env.step(actions)
