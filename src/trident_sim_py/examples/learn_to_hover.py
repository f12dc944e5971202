#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Learns to hover by the cross-entropy method: a linear policy gives body rates and thrust.

.venv/bin/python src/trident_sim_py/examples/learn_to_hover.py --seconds 120
"""

import argparse
import time
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
import trident_sim.envs  # noqa: F401 (registers the environments)

COUNT, ELITE, STEPS = 64, 8, 300
Array = npt.NDArray[np.float64]


def fly(envs: Any, policies: Array, seeds: list[int]) -> tuple[Array, Array]:
    """Returns of policies, shape (64,), and how far from the place each is at the end [m]."""
    observations, _ = envs.reset(seed=seeds)
    returns, alive = np.zeros(COUNT), np.ones(COUNT, bool)
    for _ in range(STEPS):
        inputs = np.hstack([observations, np.ones((COUNT, 1))])
        actions = np.einsum("eaw,ew->ea", policies, inputs)
        observations, rewards, ended, _, _ = envs.step(actions.astype(np.float32))
        returns += alive * rewards
        alive &= ~ended
    return returns, np.where(alive, np.linalg.norm(observations[:, :3], axis=1), np.inf)


def learn(seconds: float, generations: int) -> None:
    """Improve for a time, or so often; then fly from 64 starts that were not learned from."""
    envs = gymnasium.make_vec("trident/Hover-v0", num_envs=COUNT, actions="rates", hashes=False)
    random, end = np.random.default_rng(0), time.perf_counter() + seconds
    mean = np.zeros((4, 13))  # from 12 observed numbers and a 1
    spread = np.full_like(mean, 0.3)
    for generation in range(1, generations + 1):
        policies = mean + spread * random.standard_normal((COUNT, *mean.shape))
        # All begin alike, so that policies are compared and not starts.
        returns, _ = fly(envs, policies, [generation] * COUNT)
        elite = policies[np.argsort(returns)[-ELITE:]]
        mean, spread = elite.mean(axis=0), elite.std(axis=0) + 0.3 / generation
        print(f"{generation:4d}: mean return {returns.mean():8.1f}", flush=True)
        if time.perf_counter() > end:
            break
    returns, away_m = fly(envs, np.array([mean] * COUNT), list(range(10_000, 10_000 + COUNT)))
    print(f"mean return {returns.mean():.1f}, hovers from {(away_m < 0.5).mean():.0%} of starts")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Learns to hover.")
    parser.add_argument("--seconds", type=float, default=120.0, help="wall time")
    parser.add_argument("--generations", type=int, default=1000, help="at most")
    learn(**vars(parser.parse_args()))
