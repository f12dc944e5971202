# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Environments of Gymnasium keep its rules, repeat to the bit, and do what their options say."""

from __future__ import annotations

import subprocess
import sys
import warnings
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from hypothesis import given, settings
from hypothesis import strategies as st
from trident_sim.envs import Randomization, Rewards, Terms

import trident_sim

NAMES = ("Hover", "Waypoints", "DockBoat", "DriveRoom")
ROLL = """
import gymnasium, numpy as np, trident_sim.envs
env = gymnasium.make("trident/Hover-v0", randomization={"wind": 3.0, "mass": (0.8, 1.2)})
env.reset(seed=99)
env.reset(seed=5)
random = np.random.default_rng(1)
for _ in range(20):
    *_, info = env.step(0.1 * random.standard_normal(6).astype(np.float32))
print(info["state_hash"])
"""


def make(name: str, **options: Any) -> gymnasium.Env[Any, Any]:
    return gymnasium.make(f"trident/{name}-v0", **options)


@pytest.fixture(scope="module")
def hover() -> gymnasium.Env[Any, Any]:
    return make("Hover")


@pytest.mark.parametrize("name", NAMES)
def test_gymnasium_finds_nothing_to_warn_of(name: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        # rosclean, which roslaunch imports, asks Python 3.11's own distutils for one function.
        warnings.filterwarnings("ignore", "The distutils package", DeprecationWarning)
        check_env(make(name, render_mode="rgb_array").unwrapped)


def test_same_seed_and_actions_give_the_same_hashes_in_another_process() -> None:
    hashes = [
        subprocess.run(
            [sys.executable, "-c", ROLL], capture_output=True, text=True, check=True
        ).stdout.strip()
        for _ in range(2)
    ]
    env = make("Hover", randomization=Randomization(wind=3.0, mass=(0.8, 1.2)))
    env.reset(seed=5)
    random = np.random.default_rng(1)
    for _ in range(20):
        *_, info = env.step(0.1 * random.standard_normal(6).astype(np.float32))
    assert hashes == [info["state_hash"]] * 2


def roll(env: gymnasium.Env[Any, Any], seed: int, steps: int = 8) -> tuple[str, float]:
    env.reset(seed=seed)
    random, total = np.random.default_rng(seed), 0.0
    size = env.action_space.shape[0]  # type: ignore[index]
    for _ in range(steps):
        _, reward, ended, _, info = env.step(random.uniform(-0.2, 0.2, size).astype(np.float32))
        total += float(reward)
        assert not ended
    return info["state_hash"], total


@given(seeds=st.lists(st.integers(0, 50), min_size=1, max_size=4))
@settings(max_examples=25, deadline=None)
def test_an_episode_does_not_depend_on_those_before_it(
    hover: gymnasium.Env[Any, Any], seeds: list[int]
) -> None:
    first = roll(hover, 7)
    for seed in seeds:
        roll(hover, seed)
    assert roll(hover, 7) == first
    assert roll(hover, 8)[0] != first[0]


@pytest.mark.parametrize("name", NAMES)
def test_pictures_change_nothing(name: str) -> None:
    env = make(name, render_mode="rgb_array")
    plain = make(name)
    env.reset(seed=3), plain.reset(seed=3)
    for _ in range(3):
        seen = env.render()
        assert isinstance(seen, np.ndarray)
        assert seen.shape == (240, 320, 3)
        assert seen.std() > 3.0
        action = np.full(env.action_space.shape, 0.1, np.float32)  # type: ignore[arg-type]
        assert env.step(action)[4] == plain.step(action)[4]


@pytest.mark.parametrize("actions", ["rotors", "rates", "velocity"])
def test_an_action_of_zeros_hovers(actions: str) -> None:
    env = make("Hover", actions=actions, randomization=Randomization(start=0.0))
    env.reset(seed=1)
    zeros = np.zeros(env.action_space.shape, np.float32)  # type: ignore[arg-type]
    for _ in range(100):
        observation, _, ended, _, _ = env.step(zeros)
    assert not ended
    assert np.abs(observation[:3]).max() < 0.35


def test_velocity_actions_are_velocities_in_the_world() -> None:
    env = make("Hover", actions="velocity", observations=("velocity", "rates"))
    env.reset(seed=4)
    for _ in range(400):
        observation, *_ = env.step(np.array([0.25, -0.125, 0.1, 0.4], np.float32))
    assert observation[:3] == pytest.approx([0.5, -0.25, 0.15], abs=0.05)
    assert observation[5] == pytest.approx(0.6, abs=0.1)


def test_rates_actions_are_body_rates() -> None:
    env = make("Hover", actions="rates", observations=["rates"])
    env.reset(seed=4)
    for _ in range(25):
        observation, *_ = env.step(np.array([0.05, -0.05, 0.2, 0.0], np.float32))
    assert observation[:2] == pytest.approx([0.2, -0.2], abs=0.03)
    assert 0.1 < observation[2] < 0.4  # the gain of yaw is a twentieth of the others'


def test_the_mass_and_the_wind_are_drawn() -> None:
    env = make("Hover", randomization=Randomization(mass=(0.7, 1.3), wind=6.0))
    nominal = make("Hover").unwrapped.world.model("uav").mass  # type: ignore[attr-defined]
    masses, speeds = [], []
    zeros = np.zeros(6, np.float32)
    for seed in range(30):
        env.reset(seed=seed)
        world = env.unwrapped.world  # type: ignore[attr-defined]
        masses.append(world.model("uav").mass / nominal)
        before = world.model("uav").linear_velocity
        for _ in range(20):
            env.step(zeros)
        speeds.append(np.linalg.norm(world.model("uav").linear_velocity[:2] - before[:2]))
    assert 0.7 <= min(masses) < 0.85
    assert 1.15 < max(masses) <= 1.3
    assert np.std(speeds) > 0.0


def test_rewards_are_weights_of_terms_or_a_function_of_them() -> None:
    seen: list[Terms] = []

    def judge(terms: Terms) -> float:
        seen.append(terms)
        return -float(terms.distance)

    own = make("Hover", rewards=judge)
    weighted = make("Hover", rewards=Rewards(distance=-1.0))
    by_name = make("Hover", rewards={"alive": 0.0, "speed": 0.0, "turn_rate": 0.0, "change": 0.0})
    for env in (own, weighted, by_name):
        env.reset(seed=2)
    action = np.full(6, 0.2, np.float32)
    reward = own.step(action)[1]
    assert weighted.step(action)[1] == pytest.approx(reward)
    assert by_name.step(action)[1] == pytest.approx(0.5 * float(reward))
    assert seen[0].effort == pytest.approx(0.04)
    assert seen[0].contact == 0.0
    assert seen[0].nearest == np.inf


def test_terms_and_observations_agree() -> None:
    seen: list[Terms] = []
    env = make(
        "Hover",
        rewards=lambda terms: seen.append(terms) or 0.0,
        observations=["goal_offset", "velocity", "rates", "rotation", "quaternion", "up", "action"],
    )
    env.reset(seed=6)
    observation, *_ = env.step(np.full(6, 2.0, np.float32))  # cut to 1
    (terms,) = seen
    assert np.linalg.norm(observation[:3]) == pytest.approx(terms.distance, rel=1e-5)
    assert np.linalg.norm(observation[3:6]) == pytest.approx(terms.speed, rel=1e-4)
    assert np.linalg.norm(observation[6:9]) == pytest.approx(terms.turn_rate, rel=1e-4)
    rotation = observation[9:18].reshape(3, 3)
    assert rotation @ rotation.T == pytest.approx(np.eye(3), abs=1e-5)
    assert rotation[2, 2] == pytest.approx(terms.up, rel=1e-5)
    x, y, z, w = observation[18:22]
    assert rotation[0] == pytest.approx(
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], abs=1e-5
    )
    assert observation[22:25] == pytest.approx(rotation[2])
    assert observation[25:].tolist() == [1.0] * 6


def test_a_waypoint_that_is_reached_is_followed_by_the_next() -> None:
    env = make("Waypoints", actions="velocity", observations=["goal_offset"])
    observation, _ = env.reset(seed=3)
    rewards: list[float] = []
    ended = cut = False
    while not (ended or cut):
        offset = observation / max(float(np.linalg.norm(observation)), 1e-9)
        action = np.append(offset * np.array([1.0, 1.0, 1.0]), 0.0).astype(np.float32)
        observation, reward, ended, cut, _ = env.step(action)
        rewards.append(float(reward))
    assert ended
    assert sum(reward > 9.0 for reward in rewards) == 5


def test_a_boat_that_is_steered_docks() -> None:
    env = make("DockBoat", observations=["goal_offset", "goal_heading", "rates"])
    observation, _ = env.reset(seed=2)
    ended = cut = False
    while not (ended or cut):
        x, y = observation[:2]
        # Steer for a line that leads into the berth, and slow down.
        wanted = np.arctan2(1.2 * y, max(0.7 * x, 0.8))
        heading = -np.arctan2(observation[4], observation[3])
        turn = np.clip(1.6 * (wanted - heading) - 0.8 * observation[7], -0.6, 0.6)
        ahead = np.clip(0.12 * x + 0.1, -0.3, 0.5)
        action = np.array([ahead - turn, ahead + turn], np.float32)
        observation, reward, ended, cut, _ = env.step(action)
    assert ended
    assert reward > 10.0


def test_a_robot_that_drives_into_a_wall_fails() -> None:
    env = make("DriveRoom", observations=["scan"])
    observation, _ = env.reset(seed=2)
    assert observation.shape == (24,)
    ended = cut = False
    while not (ended or cut):
        observation, reward, ended, cut, _ = env.step(np.array([1.0, 0.0], np.float32))
    assert ended
    assert reward < -5.0 or reward > 5.0
    assert observation.min() < 0.1


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"actions": "wings"}, "actions is 'wings', legal: rotors, rates, velocity"),
        ({"observations": ["smell"]}, "a block is 'smell', legal: goal_offset"),
        ({"observations": []}, "observations is empty"),
        ({"rewards": {"joy": 1.0}}, "legal: alive, distance"),
        ({"rewards": {"alive": float("nan")}}, "alive is nan, legal: finite numbers"),
        ({"randomization": {"mass": (0.0, 1.0)}}, "mass is .*, legal: two factors, 0.1 to 10"),
        ({"randomization": {"wind": -1.0}}, "wind is -1.0 m/s, legal: 0 to 50"),
        ({"randomization": {"start": 11.0}}, "start is 11.0, legal: 0 to 10"),
    ],
)
def test_an_illegal_option_is_one_error(options: dict[str, Any], message: str) -> None:
    with pytest.raises(trident_sim.Error, match=message):
        make("Hover", **options)


def test_what_a_task_does_not_randomize_is_refused() -> None:
    with pytest.raises(trident_sim.Error, match=r"wind is 2.0, legal for this task: 0.0"):
        make("DriveRoom", randomization={"wind": 2.0})


@pytest.mark.parametrize(
    ("action", "message"),
    [
        ([np.nan, 0, 0, 0, 0, 0], r"action\[0\] is .*nan, legal: finite"),
        ([0.0, 0.0], "actions has 2 numbers, legal: 6"),
    ],
)
def test_an_action_that_cannot_be_is_refused(
    hover: gymnasium.Env[Any, Any], action: list[float], message: str
) -> None:
    hover.reset(seed=1)
    with pytest.raises(trident_sim.Error, match=message):
        hover.unwrapped.step(np.array(action, np.float32))


def test_without_gymnasium_the_line_that_installs_it_is_the_message() -> None:
    code = "import sys; sys.modules['gymnasium'] = None; import trident_sim.envs"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    last = result.stderr.strip().splitlines()[-1]
    assert last == (
        "ImportError: trident_sim.envs needs gymnasium: "
        f"{sys.executable} -m pip install gymnasium==1.4.0"
    )
