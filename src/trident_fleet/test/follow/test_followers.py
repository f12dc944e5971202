# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from trident_fleet.core.errors import FormationError
from trident_fleet.core.follow.follow_config import FollowConfig, attached, drift_of
from trident_fleet.core.follow.follow_record import FollowLog
from trident_fleet.core.follow.followers import Followers, Phase, Slots
from trident_fleet.core.follow.leader import LeaderState
from trident_fleet.core.follow.reference import Drift, Reference, ReferenceConfig
from trident_fleet.core.patterns import Pattern, places
from trident_fleet.core.quintic import Array
from trident_fleet.core.separation import min_separation

PERIOD_NS, POINT_NS, POINTS = 100_000_000, 10_000_000, 10
DT = POINT_NS / 1e9
WEDGE = np.array([[-1.5, 1.5, 0.0], [-1.5, -1.5, 0.0], [-3.0, 3.0, 0.0]])
SPAWN = np.array([[0.0, 1.6, 0.1], [0.0, -1.6, 0.1], [0.0, 3.2, 0.1]])

Path = Callable[[float], LeaderState]


def state(
    time_s: float,
    position: tuple[float, float, float] = (2.0, 0.0, 1.5),
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0),
    acceleration: tuple[float, float, float] = (0.0, 0.0, 0.0),
    yaw: tuple[float, float] = (0.0, 0.0),
) -> LeaderState:
    vectors = (np.array(v) for v in (position, velocity, acceleration))
    return LeaderState(round(time_s * 1e9), *vectors, *yaw)


def on_a_round(time_s: float, radius: float = 5.0, rate: float = 0.25) -> LeaderState:
    """Around a circle, looking ahead, and slowly up."""
    c, s = math.cos(rate * time_s), math.sin(rate * time_s)
    v = radius * rate
    return state(
        time_s,
        (2.0 + radius * s, radius * (1.0 - c), 1.5 + 0.05 * time_s),
        (v * c, v * s, 0.05),
        (-v * rate * s, v * rate * c, 0.0),
        (math.remainder(rate * time_s, 2.0 * math.pi), rate),
    )


def joined(parts: Iterable[Drift]) -> Drift:
    every = list(parts)
    return Drift(
        np.concatenate([part.place for part in every]),
        np.concatenate([part.rate for part in every]),
        np.concatenate([part.growth for part in every]),
    )


def standing(leader: LeaderState) -> Path:
    return lambda t: replace(leader, stamp_ns=round(t * 1e9))


def follow(reference: Reference, path: Path, periods: int) -> Drift:
    """The reference, each period of it commanded by the state one period earlier."""
    return joined(
        reference.advance(path((n - 1) * 0.1), n * PERIOD_NS, POINT_NS, POINTS)
        for n in range(1, periods + 1)
    )


def fly(followers: Followers, path: Path, periods: int) -> list[Slots]:
    """Commands from the first period on, which two are without a state."""
    slots = [followers.step(None, 0, n * PERIOD_NS) for n in range(2)]
    for n in range(2, periods):
        elapsed_ns = (n - 1) * PERIOD_NS
        slots.append(followers.step(path(elapsed_ns / 1e9), elapsed_ns, n * PERIOD_NS))
    return slots


def positions(slots: list[Slots]) -> Array:
    return np.concatenate([slot.motion.position for slot in slots])


def test_the_reference_does_not_lag_behind_constant_acceleration() -> None:
    def path(t: float) -> LeaderState:
        return state(
            t, (0.2 * t * t, 1.0, 1.5), (0.4 * t, 0.0, 0.0), (0.4, 0.0, 0.0), (0.1 * t, 0.1)
        )

    drift = follow(Reference(ReferenceConfig()), path, 50)
    time = 0.1 + DT * np.arange(len(drift.place))
    np.testing.assert_allclose(drift.place[:, 0], 0.2 * time**2, atol=1e-9)
    np.testing.assert_allclose(drift.rate[:, 0], 0.4 * time, atol=1e-9)
    np.testing.assert_allclose(drift.place[:, 3], 0.1 * time, atol=1e-9)


def test_a_leader_on_a_round_is_followed_within_centimetres() -> None:
    drift = follow(Reference(ReferenceConfig()), on_a_round, 400)
    true = np.array([on_a_round(0.1 + DT * k).position for k in range(len(drift.place))])
    assert np.abs(drift.place[:, :3] - true).max() < 0.02
    turned = np.array([0.25 * (0.1 + DT * k) for k in range(len(drift.place))])
    np.testing.assert_allclose(drift.place[:, 3], turned, atol=0.02)


@given(
    jump=st.tuples(st.floats(-8.0, 8.0), st.floats(-8.0, 8.0), st.floats(-2.0, 2.0)),
    yaw=st.floats(-3.1, 3.1),
)
@settings(max_examples=40)
def test_a_leader_that_jumps_is_caught_up_with_in_limits(
    jump: tuple[float, float, float], yaw: float
) -> None:
    config = ReferenceConfig()
    reference = Reference(config)
    follow(reference, lambda t: state(t), 5)

    def jumped(t: float) -> LeaderState:
        return state(t, (2.0 + jump[0], jump[1], 1.5 + jump[2]), yaw=(yaw, 0.0))

    parts = []
    for n in range(6, 260):
        parts.append(reference.advance(jumped((n - 1) * 0.1), n * PERIOD_NS, POINT_NS, POINTS))
    place, rate, growth = (
        np.concatenate([getattr(p, f) for p in parts]) for f in Drift.__annotations__
    )
    goal = np.array([2.0 + jump[0], jump[1], 1.5 + jump[2]])
    np.testing.assert_allclose(place[-1, :3], goal, atol=0.01)
    assert math.remainder(place[-1, 3] - yaw, 2.0 * math.pi) == pytest.approx(0.0, abs=0.01)
    assert np.linalg.norm(growth[:, :3], axis=1).max() <= config.a_max + 1e-9
    assert np.linalg.norm(rate[:, :3], axis=1).max() <= 1.3 * config.closing_speed
    away = np.linalg.norm(place[:, :3] - goal, axis=1)
    assert away.max() <= np.linalg.norm(jump) + 0.02, "no overshoot to the other side"
    mean_rate = 0.5 * (rate[1:] + rate[:-1])
    np.testing.assert_allclose(np.diff(place, axis=0) / DT, mean_rate, atol=0.01)


@pytest.mark.parametrize("frame", ["heading", "world"])
def test_places_move_as_their_derivatives_say(frame: str) -> None:
    step = 1e-4
    before, now, after = (
        attached(WEDGE, frame, drift_of(on_a_round(7.0 + k * step))) for k in (-1, 0, 1)
    )
    np.testing.assert_allclose(
        (after.position - before.position) / (2 * step), now.velocity, atol=1e-6
    )
    np.testing.assert_allclose(
        (after.velocity - before.velocity) / (2 * step), now.acceleration, atol=1e-6
    )
    leader = on_a_round(7.0)
    arm = now.position[0] - leader.position
    if frame == "world":
        np.testing.assert_allclose(arm, WEDGE)
    else:
        ahead = np.array([math.cos(leader.yaw_rad), math.sin(leader.yaw_rad), 0.0])
        np.testing.assert_allclose(arm @ ahead, WEDGE[:, 0], atol=1e-12)


def test_from_the_ground_to_the_places_of_a_turning_leader() -> None:
    followers = Followers(SPAWN, FollowConfig(WEDGE))
    slots = fly(followers, on_a_round, 400)
    np.testing.assert_array_equal(slots[0].motion.position[0], SPAWN)
    assert followers.phase is Phase.FOLLOW
    assert followers.joined_s is not None
    first = round(followers.joined_s * 10) + 1
    for n in range(first, 400):
        ideal = followers.ideal(on_a_round(n * 0.1))
        error = slots[n].motion.position[0] - ideal.position[0]
        assert np.abs(error).max() < 0.05
    last = slots[-1]
    assert math.remainder(last.yaw[0] - 0.25 * 39.9, 2.0 * math.pi) == pytest.approx(0.0, abs=0.02)
    assert last.yaw_rate[0] == pytest.approx(0.25, abs=0.02)


@pytest.mark.parametrize("frame", ["heading", "world"])
def test_commands_are_smooth_and_consistent(frame: str) -> None:
    followers = Followers(SPAWN, FollowConfig(WEDGE, frame=frame))
    slots = fly(followers, on_a_round, 300)
    p = positions(slots)
    v = np.concatenate([slot.motion.velocity for slot in slots])
    a = np.concatenate([slot.motion.acceleration for slot in slots])
    np.testing.assert_allclose(np.diff(p, axis=0) / DT, 0.5 * (v[1:] + v[:-1]), atol=0.005)
    np.testing.assert_allclose(np.diff(v, axis=0) / DT, 0.5 * (a[1:] + a[:-1]), atol=0.1)
    assert np.linalg.norm(v, axis=-1).max() < 4.0
    yaw = np.unwrap(np.concatenate([slot.yaw for slot in slots]))
    rate = np.concatenate([slot.yaw_rate for slot in slots])
    np.testing.assert_allclose(np.diff(yaw) / DT, 0.5 * (rate[1:] + rate[:-1]), atol=0.02)
    if frame == "world":
        np.testing.assert_array_equal(yaw, 0.0)


@given(
    seed=st.integers(0, 2**32 - 1),
    count=st.integers(1, 6),
    kind=st.sampled_from(["circle", "wedge", "line"]),
    x=st.floats(-4.0, 8.0),
    y=st.floats(-6.0, 6.0),
    yaw=st.floats(-3.1, 3.1),
)
@settings(max_examples=30)
def test_joining_a_hovering_leader_comes_close_to_nobody(
    seed: int, count: int, kind: str, x: float, y: float, yaw: float
) -> None:
    spawn = places(Pattern("grid", 1.6), count) + np.array([0.0, 0.0, 0.1])
    pattern = places(Pattern(kind, 1.8), count + 1)
    offsets = np.random.default_rng(seed).permutation(pattern[1:] - pattern[0])
    leader = state(0.0, (x, y, 2.0), yaw=(yaw, 0.0))
    followers = Followers(spawn, FollowConfig(offsets))
    slots = fly(followers, standing(leader), 450)
    if followers.phase is Phase.TAKE_OFF:
        assert "no order of departures" in followers.problem
        np.testing.assert_array_equal(slots[-1].motion.velocity, 0.0)
        return
    assert followers.phase is Phase.FOLLOW
    flown = positions(slots)[130:]
    everybody = np.concatenate(
        [flown, np.broadcast_to(leader.position, (len(flown), 1, 3))], axis=1
    )
    climbed = np.concatenate([spawn + np.array([0.0, 0.0, 0.5]), leader.position[None]])
    assert min_separation(everybody) >= min(1.0, min_separation(climbed[None])) - 1e-6
    ideal = followers.ideal(leader).position[0]
    np.testing.assert_allclose(flown[-1], ideal, atol=1e-3)


def test_places_are_taken_in_order_if_that_is_wanted() -> None:
    for assign, expected in ((False, WEDGE[[2, 0, 1]]), (True, WEDGE)):
        config = FollowConfig(WEDGE[[2, 0, 1]], frame="world", assign=assign)
        followers = Followers(SPAWN, config)
        leader = state(0.0, (6.0, 1.0, 2.0))
        slots = fly(followers, standing(leader), 300)
        arms = slots[-1].motion.position[0] - leader.position
        np.testing.assert_allclose(arms, expected, atol=1e-3)


def test_nobody_follows_a_leader_into_the_ground() -> None:
    config = FollowConfig(WEDGE + np.array([0.0, 0.0, -0.3]), lowest_m=0.8)
    followers = Followers(SPAWN, config)
    slots = fly(followers, lambda t: state(t, (2.0, 0.0, 0.1)), 200)
    assert followers.phase is Phase.FOLLOW
    np.testing.assert_allclose(slots[-1].motion.position[..., 2], 0.8, atol=1e-6)


def test_without_a_leader_they_hover() -> None:
    followers = Followers(SPAWN, FollowConfig(WEDGE))
    slots = [followers.step(None, n * PERIOD_NS, n * PERIOD_NS) for n in range(60)]
    np.testing.assert_allclose(slots[-1].motion.position[-1], SPAWN + np.array([0.0, 0.0, 0.5]))
    np.testing.assert_array_equal(slots[-1].motion.velocity, 0.0)
    assert followers.phase is Phase.TAKE_OFF


def test_the_flight_ends_when_the_leader_has_stood_still() -> None:
    def path(t: float) -> LeaderState:
        return (
            on_a_round(min(t, 20.0))
            if t < 20.0
            else replace(
                state(t, tuple(on_a_round(20.0).position)), yaw_rad=on_a_round(20.0).yaw_rad
            )
        )

    followers = Followers(SPAWN, FollowConfig(WEDGE, end_when_still_s=3.0))
    done = None
    for n in range(2, 400):
        followers.step(path((n - 1) * 0.1), (n - 1) * PERIOD_NS, n * PERIOD_NS)
        if followers.phase is Phase.DONE and done is None:
            done = (n - 1) * 0.1
    assert done == pytest.approx(23.0, abs=0.11)


def test_a_leader_that_only_paused_is_followed_on() -> None:
    pause_s = (20.0, 24.0)

    def path(t: float) -> LeaderState:
        if pause_s[0] <= t < pause_s[1]:
            at = on_a_round(pause_s[0])
            return replace(state(t, tuple(at.position)), yaw_rad=at.yaw_rad)
        return replace(
            on_a_round(t if t < pause_s[0] else t - pause_s[1] + pause_s[0]),
            stamp_ns=round(t * 1e9),
        )

    followers = Followers(SPAWN, FollowConfig(WEDGE, end_when_still_s=2.0))
    phases = []
    for n in range(2, 350):
        followers.step(path((n - 1) * 0.1), (n - 1) * PERIOD_NS, n * PERIOD_NS)
        phases.append(followers.phase)
    done = [index for index, phase in enumerate(phases) if phase is Phase.DONE]
    assert 0.1 * (done[0] + 1) == pytest.approx(22.0, abs=0.11)
    assert 0.1 * (done[-1] + 1) == pytest.approx(24.0, abs=0.11)
    assert phases[-1] is Phase.FOLLOW


@pytest.mark.parametrize(
    ("change", "what"),
    [
        ({"frame": "body"}, "frame: 'body'; legal: heading, world"),
        ({"offsets": np.full((3, 3), np.nan)}, "offsets: .*finite"),
        ({"offsets": WEDGE * 0.4}, "offsets: counted from the leader, places 1 and 2 are 0.849"),
        ({"offsets": WEDGE[[0, 0, 1]]}, "places 2 and 3 are 0.000 m apart"),
        ({"lowest_m": -1.0}, "lowest_m: -1.0"),
        ({"end_when_still_s": math.inf}, "end_when_still_s: inf"),
        ({"reference": ReferenceConfig(bandwidth=0.0)}, "bandwidth: 0.0"),
    ],
)
def test_bad_configurations_are_refused(change: dict[str, object], what: str) -> None:
    good: dict[str, object] = {"offsets": WEDGE}
    with pytest.raises(FormationError, match=what):
        Followers(SPAWN, FollowConfig(**(good | change)))  # type: ignore[arg-type]


def test_the_record_says_where_everybody_belonged() -> None:
    followers = Followers(SPAWN, FollowConfig(WEDGE))
    log = FollowLog("UAV1", ["UAV2", "UAV3", "UAV4"], start_ns=300_000_000)
    early = log.records({})
    assert [record["vehicle"] for record in early] == ["UAV1", "UAV2", "UAV3", "UAV4"]
    assert all("have not joined UAV1" in record["error"] for record in early)
    for n in range(2, 300):
        leader = on_a_round((n - 1) * 0.1)
        log.add(followers, leader)
        log.add(followers, leader)
        followers.step(leader, (n - 1) * PERIOD_NS, n * PERIOD_NS)
    records = log.records({"follow": {}})
    assert followers.joined_s is not None
    for index, record in enumerate(records):
        time = np.array(record["knots"]["time_s"])
        assert time[0] == pytest.approx(followers.joined_s)
        np.testing.assert_allclose(np.diff(time), 0.1)
        leader = on_a_round(time[40])
        expected = leader.position if index == 0 else followers.ideal(leader).position[0, index - 1]
        np.testing.assert_allclose(record["knots"]["position"][40], expected)
        assert record["rows"][4] == record["knots"]["position"][40]
        assert record["row_time_s"][4] == time[40]
        assert record["start_time_s"] == 0.3
        assert record["error"] == ""
