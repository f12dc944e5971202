# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from trident_nav.core.errors import NavError
from trident_nav.core.wander import Wander, WanderConfig

CONFIG = WanderConfig(speed=0.3, turn_rate=0.8)
ANGLES = np.linspace(-math.pi, math.pi, 360, endpoint=False)
FREE = np.full(ANGLES.size, np.inf)


def wall(x: float) -> np.ndarray:
    """Ranges to a wall across the robot's path at x, shape (n,)."""
    with np.errstate(divide="ignore"):
        ranges = x / np.cos(ANGLES)
    ranges[(ranges <= 0.0) | (ranges > 12.0)] = np.inf
    return ranges


def test_on_free_ground_it_drives_at_its_speed_in_shallow_curves() -> None:
    wander = Wander(CONFIG)
    commands = [wander.command(0.1 * i, ANGLES, FREE) for i in range(1000)]
    assert {command.linear for command in commands} == {CONFIG.speed}
    rates = np.array([command.angular for command in commands])
    assert np.abs(rates).max() <= 0.25 * CONFIG.turn_rate
    assert np.unique(rates).size > 10


def test_it_slows_down_before_a_wall_and_turns_on_the_spot() -> None:
    wander = Wander(CONFIG)
    speeds = [wander.command(0.0, ANGLES, wall(x)).linear for x in (3.0, 1.0, 0.7, 0.51)]
    assert speeds == sorted(speeds, reverse=True)
    assert speeds[0] == CONFIG.speed
    assert speeds[-1] > 0.0
    stop = wander.command(0.1, ANGLES, wall(0.5))
    assert stop.linear == 0.0
    assert abs(stop.angular) == CONFIG.turn_rate


@pytest.mark.parametrize("side", [1, -1])
def test_it_turns_to_the_freer_side(side: int) -> None:
    ranges = wall(0.4)
    ranges[np.sin(ANGLES) * side < -0.2] = 0.6
    command = Wander(CONFIG).command(0.0, ANGLES, ranges)
    assert command.angular == side * CONFIG.turn_rate


def test_a_turn_ends_when_it_is_free_ahead_and_not_before() -> None:
    wander = Wander(CONFIG)
    wander.command(0.0, ANGLES, wall(0.4))
    assert wander.command(60.0, ANGLES, wall(0.8)).linear == 0.0
    assert wander.command(61.0, ANGLES, FREE).linear == CONFIG.speed


def test_what_is_next_to_its_path_does_not_stop_it() -> None:
    ranges = FREE.copy()
    ranges[np.abs(ANGLES - math.pi / 2) < 0.05] = CONFIG.half_width + 0.02
    assert Wander(CONFIG).command(0.0, ANGLES, ranges).linear == CONFIG.speed


def test_what_a_lidar_does_not_know_is_no_obstacle() -> None:
    ranges = np.full(ANGLES.size, np.nan)
    ranges[::2] = 0.0
    assert Wander(CONFIG).command(0.0, ANGLES, ranges).linear == CONFIG.speed


def test_a_seed_decides() -> None:
    def run(seed: int) -> list[tuple[float, float]]:
        wander = Wander(replace(CONFIG, seed=seed))
        return [tuple(wander.command(0.5 * i, ANGLES, FREE)) for i in range(50)]

    assert run(3) == run(3)
    assert run(3) != run(4)


@given(
    st.lists(st.floats(width=32), min_size=0, max_size=40),
    st.floats(0, 1e6),
)
def test_any_scan_gives_a_bounded_command(ranges: list[float], time_s: float) -> None:
    angles = np.linspace(-3.0, 3.0, len(ranges))
    command = Wander(CONFIG).command(time_s, angles, np.array(ranges, dtype=float))
    assert 0.0 <= command.linear <= CONFIG.speed
    assert abs(command.angular) <= CONFIG.turn_rate


@pytest.mark.parametrize(
    ("change", "what"),
    [
        ({"speed": 0.0}, "speed: 0 m/s, legal: 0.01 to 5 m/s"),
        ({"turn_rate": math.nan}, "turn_rate: nan rad/s"),
        ({"stop_distance": 2.0}, "slow_distance: 1.2 m, legal: 2 to 50 m"),
        ({"half_width": -1.0}, "half_width: -1 m"),
        ({"seed": -1}, "seed: -1"),
    ],
)
def test_bad_configurations_are_refused(change: dict[str, float], what: str) -> None:
    with pytest.raises(NavError, match=what):
        Wander(replace(CONFIG, **change))  # type: ignore[arg-type]
