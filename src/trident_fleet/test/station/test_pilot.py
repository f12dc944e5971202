# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from polygons import U_SHAPE, fences
from trident_fleet.core.quintic import Array
from trident_fleet.core.station.config import PilotConfig
from trident_fleet.core.station.fence import Fence
from trident_fleet.core.station.pilot import Other, Pilot, sampled

DT = 0.1
TIMES = np.arange(10) * 0.01
CONFIG = PilotConfig(v_max=6.0, a_max=3.0, margin_m=1.0, separation_m=4.0, others_v_max=0.0)


def flown(pilot: Pilot, goals: list[Array], others: list[Other], periods: int = 25) -> Array:
    """The set-points towards one goal after the other, shape (N, 3, 3): p, v, a."""
    points = []
    for goal in goals:
        for _ in range(periods):
            position, velocity = pilot.position, pilot.velocity
            motion = sampled(position, velocity, pilot.step(goal, DT, others), TIMES)
            points.append([motion.position, motion.velocity, motion.acceleration])
    return np.concatenate([np.stack(three, axis=1)[:, :, 0] for three in points])


# Nobody says what the goals are: they lie anywhere, and come at any moment.
@given(
    fences(),
    st.integers(0, 10**6),
    st.floats(0.5, 15.0),
    st.floats(0.5, 8.0),
    st.floats(0.0, 2.5),
    st.integers(1, 40),
)
@settings(max_examples=120)
def test_no_goals_lead_out_of_the_fence_or_beyond_the_limits(
    fence: Fence, seed: int, v_max: float, a_max: float, margin: float, periods: int
) -> None:
    config = replace(CONFIG, v_max=v_max, a_max=a_max, margin_m=margin)
    start = np.array([0.0, 0.0, 25.0])
    if fence.clearance(start[None])[0] < margin:
        return
    random = np.random.default_rng(seed)
    goals = list(random.normal(0.0, 60.0, (8, 3)) + start)
    points = flown(Pilot(fence, config, start), goals, [], periods)
    assert fence.clearance(points[:, 0]).min() >= margin - 1e-5
    assert np.linalg.norm(points[:, 1], axis=1).max() <= v_max + 1e-5
    assert np.linalg.norm(points[:, 2], axis=1).max() <= a_max + 1e-9


def test_a_goal_in_the_fence_is_reached_at_rest() -> None:
    pilot = Pilot(Fence(U_SHAPE, 10.0, 30.0), CONFIG, np.array([20.0, 20.0, 12.0]))
    goal = np.array([85.0, 30.0, 25.0])
    points = flown(pilot, [goal], [], periods=300)
    np.testing.assert_allclose(pilot.position, goal, atol=1e-3)
    assert np.linalg.norm(points[:, 1], axis=1).max() == pytest.approx(6.0, abs=0.3)


def test_set_points_are_continuous() -> None:
    pilot = Pilot(Fence(U_SHAPE, 10.0, 30.0), CONFIG, np.array([20.0, 20.0, 12.0]))
    points = flown(pilot, [np.array([85.0, 30.0, 25.0]), np.array([10.0, 90.0, 12.0])], [])
    steps = np.diff(points[:, 0], axis=0)
    middle = 0.5 * (points[1:, 1] + points[:-1, 1])
    np.testing.assert_allclose(steps, 0.01 * middle, atol=1e-9)


@given(st.integers(0, 10**6))
@settings(max_examples=60)
def test_others_are_kept_away_from(seed: int) -> None:
    random = np.random.default_rng(seed)
    fence = Fence(50.0 * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1.0]]), 0.0, 60.0)
    others = [Other(random.uniform([-40, -40, 10], [40, 40, 50]), 0.0) for _ in range(4)]
    start = np.array([0.0, 0.0, 30.0])
    if min(np.linalg.norm(start - other.position) for other in others) < 8.0:
        return
    goals = [other.position + random.normal(0.0, 2.0, 3) for other in others]
    points = flown(Pilot(fence, CONFIG, start), goals, others, periods=60)
    for other in others:
        assert np.linalg.norm(points[:, 0] - other.position, axis=1).min() >= 4.0


def test_one_in_between_is_flown_around() -> None:
    fence = Fence(50.0 * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1.0]]), 0.0, 60.0)
    pilot = Pilot(fence, CONFIG, np.array([-30.0, 0.0, 30.0]))
    other = Other(np.array([0.0, 0.0, 30.0]), 100.0)
    goal = np.array([30.0, 0.0, 30.0])
    points = flown(pilot, [goal], [other], periods=300)
    assert np.linalg.norm(points[:, 0] - other.position, axis=1).min() >= 4.0
    np.testing.assert_allclose(pilot.position, goal, atol=1e-2)


def test_one_that_stands_too_near_is_left() -> None:
    fence = Fence(50.0 * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1.0]]), 0.0, 60.0)
    pilot = Pilot(fence, CONFIG, np.array([0.0, 0.0, 30.0]))
    other = Other(np.array([1.0, 0.0, 30.0]), 0.0)
    points = flown(pilot, [np.array([-20.0, 0.0, 30.0])], [other], periods=200)
    assert np.linalg.norm(points[:, 0] - other.position, axis=1).min() >= 1.0 - 1e-9
    np.testing.assert_allclose(pilot.position, [-20.0, 0.0, 30.0], atol=1e-2)


def test_an_old_position_of_a_fast_one_keeps_farther_away() -> None:
    fence = Fence(50.0 * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1.0]]), 0.0, 60.0)
    config = replace(CONFIG, others_v_max=2.0)

    def nearest(age_s: float) -> float:
        pilot = Pilot(fence, config, np.array([-30.0, 0.0, 30.0]))
        other = Other(np.array([20.0, 0.0, 30.0]), age_s)
        points = flown(pilot, [other.position], [other], periods=300)
        return float(np.linalg.norm(points[:, 0] - other.position, axis=1).min())

    assert nearest(2.0) > nearest(0.0) + 3.0
    assert nearest(50.0) == pytest.approx(nearest(2.0))
