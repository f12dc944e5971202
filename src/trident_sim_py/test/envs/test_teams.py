# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Environments of PettingZoo keep its rules, repeat, and reward what they say."""

from __future__ import annotations

import subprocess
import sys
import warnings
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from pettingzoo.test import api_test, parallel_api_test, parallel_seed_test, seed_test
from trident_sim.envs import trident_formation_v0, trident_search_v0

import trident_sim

MODULES = [trident_formation_v0, trident_search_v0]


@pytest.mark.parametrize("module", MODULES)
def test_pettingzoo_finds_nothing_to_warn_of(module: ModuleType) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        # rosclean, which roslaunch imports, asks Python 3.11's own distutils for one function.
        warnings.filterwarnings("ignore", "The distutils package", DeprecationWarning)
        parallel_api_test(module.parallel_env(), num_cycles=60)
        parallel_seed_test(lambda: module.parallel_env(), num_cycles=30)
        api_test(module.env(), num_cycles=30)
        seed_test(lambda: module.env(), num_cycles=30)


def final_hash(env: Any, seed: int) -> str:
    env.reset(seed=seed)
    random = np.random.default_rng(seed)
    for _ in range(15):
        actions = {
            name: random.uniform(-0.3, 0.3, env.action_space(name).shape).astype(np.float32)
            for name in env.agents
        }
        *_, infos = env.step(actions)
    hashes = {info["state_hash"] for info in infos.values()}
    assert len(hashes) == 1
    return str(hashes.pop())


@pytest.mark.parametrize("module", MODULES)
def test_same_seed_and_actions_give_the_same_hashes(module: ModuleType) -> None:
    env = module.parallel_env()
    first = final_hash(env, 3)
    assert final_hash(env, 4) != first
    assert final_hash(env, 3) == first
    name = module.__name__.rpartition(".")[2]
    code = (
        f"import sys; sys.path.insert(0, {str(__file__).rpartition('/')[0]!r})\n"
        f"import test_teams\nprint(test_teams.final_hash(test_teams.{name}.parallel_env(), 3))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == first


def test_a_formation_that_flies_to_its_places_keeps_them() -> None:
    env = trident_formation_v0.parallel_env(observations=["goal_offset"], limit=400)
    observations, _ = env.reset(seed=1)
    total = 0.0
    while env.agents:
        actions = {
            name: np.append(np.clip(0.9 * offset, -1.0, 1.0), 0.0).astype(np.float32)
            for name, offset in observations.items()
        }
        observations, rewards, ended, cut, _ = env.step(actions)
        total += sum(rewards.values()) / len(rewards)
    assert not any(ended.values())
    assert all(cut.values())
    assert max(np.linalg.norm(offset) for offset in observations.values()) < 0.6
    assert total > 200.0


def test_two_that_come_too_close_end_the_episode() -> None:
    env = trident_formation_v0.parallel_env(observations=["others"], vehicles=2)
    observations, _ = env.reset(seed=1)
    assert np.allclose(observations["uav_0"], -observations["uav_1"])
    ended: dict[str, bool] = {}
    while env.agents:
        actions = {
            name: np.append(offset / np.linalg.norm(offset), 0.0).astype(np.float32)
            for name, offset in observations.items()
        }
        observations, rewards, ended, _, _ = env.step(actions)
    assert ended == {"uav_0": True, "uav_1": True}
    assert max(rewards.values()) < -40.0


def sweep(env: Any, seed: int, steps: int) -> dict[str, float]:
    """Fly north and back along lanes; the others stand."""
    env.reset(seed=seed)
    totals = dict.fromkeys(env.agents, 0.0)
    for step in range(steps):
        actions = {name: np.zeros(2, np.float32) for name in env.agents}
        phase = step % 60
        side = [0.0, 1.0] if phase < 25 else [1.0, 0.0] if phase < 30 else [0.0, -1.0]
        actions["uav_0"] = np.array(side if phase < 55 else [1.0, 0.0], np.float32)
        _, rewards, *_ = env.step(actions)
        for name, reward in rewards.items():
            totals[name] += reward
    return totals


def test_a_search_is_rewarded_for_what_it_covers_and_finds() -> None:
    env = trident_search_v0.parallel_env(people=40)
    totals = sweep(env, 1, 240)
    assert len(set(totals.values())) == 1  # the team's
    found = sum(one.found_s is not None for one in env.truth.people)
    share = env.truth.coverage.share()
    assert found > 0
    assert share > 0.02
    done = sum(
        2.0 * (one.confirmed_s is not None) + 4.0 * (one.served_s is not None)
        for one in env.truth.people
    )
    first = env.truth.coverage  # the value at the beginning was 0
    assert totals["uav_0"] == pytest.approx(100.0 * share + found + done, abs=1e-3)
    assert first.share() == share


def test_robots_do_not_leave_what_they_get_to() -> None:
    env = trident_search_v0.parallel_env()
    env.reset(seed=2)
    for step in range(200):
        side = 1.0 if step < 100 else -1.0
        env.step({name: np.array([0.3, side], np.float32) for name in env.agents})
    area = env.truth.scene.area
    for name, domain in (("ugv_0", "ground"), ("usv_0", "water")):
        place = env._vehicles[env.possible_agents.index(name)].place
        assert area.reach(domain)[area.lattice.cell(*place)]


@pytest.mark.parametrize(
    ("module", "options", "message"),
    [
        (trident_formation_v0, {"vehicles": 1}, "vehicles is 1, legal: 2 to 100"),
        (trident_formation_v0, {"share": 2.0}, r"share is 2.0, legal: 0 to 1"),
        (trident_search_v0, {"mode": "tank"}, "mode is 'tank', legal: joint"),
        (trident_search_v0, {"people": 0}, "people is 0"),
        (trident_search_v0, {"limit": 0}, "limit is 0, legal: 1 or more"),
    ],
)
def test_an_illegal_option_is_one_error(
    module: ModuleType, options: dict[str, Any], message: str
) -> None:
    with pytest.raises(trident_sim.Error, match=message):
        module.parallel_env(**options)


def test_an_action_that_cannot_be_is_refused() -> None:
    env = trident_search_v0.parallel_env()
    env.reset(seed=1)
    actions = {name: np.zeros(2, np.float32) for name in env.agents}
    with pytest.raises(trident_sim.Error, match=r"no action of \['usv_0'\]"):
        env.step({name: actions[name] for name in ("uav_0", "ugv_0")})
    with pytest.raises(trident_sim.Error, match=r"legal: .*finite"):
        env.step(actions | {"uav_0": np.array([np.nan, 0.0], np.float32)})
