# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from trident_fleet.core.follow.leader import LeaderTrack, Measurement, rotate, wrapped, yaw_of

PERIOD_NS = 100_000_000


def measured(stamp_ns: int, x: float = 0.0, **more: object) -> Measurement:
    return Measurement(stamp_ns, np.array([x, 0.0, 1.0]), 0.0, **more)  # type: ignore[arg-type]


def add(track: LeaderTrack, measurement: Measurement) -> None:
    track.add(measurement.stamp_ns, lambda: measurement)


def test_the_newest_measurement_that_is_not_younger_counts() -> None:
    track = LeaderTrack()
    assert track.at(0) is None
    for stamp_ns in (40, 90, 140):
        add(track, measured(stamp_ns, x=float(stamp_ns)))
    for time_ns, expected in ((100, 90), (139, 90), (140, 140), (300, 140)):
        state = track.at(time_ns)
        assert state is not None
        assert (state.stamp_ns, state.position[0]) == (expected, expected)


def test_it_is_certain_only_when_a_later_one_has_come() -> None:
    track = LeaderTrack()
    assert not track.is_known_at(0)
    add(track, measured(90))
    assert not track.is_known_at(100)
    add(track, measured(110))
    assert track.is_known_at(100)
    assert not track.is_known_at(120)


@given(
    stamps=st.lists(st.integers(0, 1000), min_size=1, max_size=30, unique=True).map(sorted),
    bursts=st.lists(st.integers(1, 5), min_size=30, max_size=30),
)
def test_states_do_not_depend_on_when_messages_arrive(stamps: list[int], bursts: list[int]) -> None:
    def states(burst_sizes: list[int]) -> list[tuple[int, float, float]]:
        track, found, arrived, due = LeaderTrack(), [], 0, 100
        for size in burst_sizes:
            for stamp in stamps[arrived : arrived + size]:
                add(track, measured(stamp, x=float(stamp), velocity=np.array([stamp, 0.0, 0.0])))
            arrived += size
            while track.is_known_at(due):
                state = track.at(due)
                if state is not None:
                    found.append((state.stamp_ns, state.velocity[0], state.acceleration[0]))
                due += 100
        return found

    assert states(bursts) == states([1] * 30) == states([30])


def test_old_repeated_and_infinite_messages_count_for_nothing() -> None:
    track = LeaderTrack()
    add(track, measured(100, x=1.0))
    add(track, measured(100, x=2.0))
    add(track, measured(50, x=3.0))
    add(track, measured(150, x=math.nan))
    add(track, measured(160, velocity=np.array([math.inf, 0.0, 0.0])))
    track.add(170, lambda: None)
    state = track.at(200)
    assert state is not None
    assert state.position[0] == 1.0
    assert track.is_known_at(170)


def test_messages_that_do_not_count_are_not_decoded() -> None:
    decoded: list[int] = []

    def decoder(stamp: int) -> Measurement:
        decoded.append(stamp)
        return measured(stamp)

    track = LeaderTrack()
    for stamp in range(10, 210, 10):
        track.add(stamp, lambda stamp=stamp: decoder(stamp))  # type: ignore[misc]
    track.at(100)
    track.at(200)
    assert decoded == [100, 200]


def test_poses_alone_give_rates_by_their_differences() -> None:
    track = LeaderTrack()
    states = []
    for index in range(4):
        yaw = wrapped(3.0 + 0.2 * index)  # passes from pi to -pi
        position = np.array([0.1 * index**2, 0.0, 1.0])
        add(track, Measurement(index * PERIOD_NS, position, yaw))
        states.append(track.at(index * PERIOD_NS))
    first, *_, last = states
    assert first is not None
    assert last is not None
    np.testing.assert_array_equal(first.velocity, 0.0)
    np.testing.assert_allclose(last.velocity, [5.0, 0.0, 0.0])
    assert last.yaw_rate == pytest.approx(2.0)
    np.testing.assert_array_equal(last.acceleration, 0.0), "twice a difference would be noise"


def test_acceleration_is_the_difference_of_measured_velocities() -> None:
    track = LeaderTrack()
    for index in range(3):
        velocity = np.array([0.0, 0.05 * index, 0.0])
        add(track, measured(index * PERIOD_NS, velocity=velocity, yaw_rate=0.3))
        state = track.at(index * PERIOD_NS)
    assert state is not None
    np.testing.assert_allclose(state.acceleration, [0.0, 0.5, 0.0])
    assert state.yaw_rate == 0.3


@given(
    yaw=st.floats(-3.1, 3.1),
    tilt=st.floats(-1.4, 1.4),
    vector=st.tuples(*[st.floats(-5.0, 5.0)] * 3),
)
def test_a_turned_vector_and_its_heading(
    yaw: float, tilt: float, vector: tuple[float, float, float]
) -> None:
    # About z, then about the new y.
    cy, sy, ct, s_t = (f(a / 2.0) for a in (yaw, tilt) for f in (math.cos, math.sin))
    quaternion = (-sy * s_t, cy * s_t, sy * ct, cy * ct)
    about_z = np.array(
        [[math.cos(yaw), -math.sin(yaw), 0], [math.sin(yaw), math.cos(yaw), 0], [0, 0, 1]]
    )
    about_y = np.array(
        [[math.cos(tilt), 0, math.sin(tilt)], [0, 1, 0], [-math.sin(tilt), 0, math.cos(tilt)]]
    )
    expected = about_z @ about_y @ np.array(vector)
    np.testing.assert_allclose(rotate(quaternion, np.array(vector)), expected, atol=1e-9)
    assert yaw_of(quaternion) == pytest.approx(yaw, abs=1e-9)


def test_no_attitude_turns_nothing() -> None:
    np.testing.assert_array_equal(rotate((0, 0, 0, 0), np.array([1.0, 2.0, 3.0])), [1, 2, 3])
    assert yaw_of((0, 0, 0, 0)) == 0.0
