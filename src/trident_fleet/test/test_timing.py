# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from trident_fleet.core.config import FlightLimits
from trident_fleet.core.files.formation_file import FormationSource, read_formation
from trident_fleet.core.quintic import Array, QuinticPath
from trident_fleet.core.timing import excess, fly_through


def largest(path: QuinticPath, order: int) -> float:
    time = np.linspace(path.time[0], path.time[-1], 20_001)
    return float(np.linalg.norm(path.derivative(time, order), axis=-1).max())


def assert_keeps(path: QuinticPath, limits: FlightLimits) -> None:
    assert largest(path, 1) <= limits.v_max * 1.001
    assert largest(path, 2) <= limits.a_max * 1.001
    assert largest(path, 3) <= limits.j_max * 1.001


def random_rows(seed: int, steps: int, vehicles: int) -> Array:
    rng = np.random.default_rng(seed)
    return np.cumsum(rng.normal(scale=0.1, size=(steps, vehicles, 3)), axis=0)


LIMITS = [FlightLimits(), FlightLimits(v_max=0.5), FlightLimits(a_max=0.2), FlightLimits(j_max=0.3)]


@pytest.mark.parametrize("limits", LIMITS, ids=["default", "slow", "gentle", "smooth"])
def test_the_limits_hold_and_one_of_them_is_used(own_formation: Path, limits: FlightLimits) -> None:
    rows = read_formation(FormationSource(str(own_formation)))
    path = fly_through(rows, limits)
    assert_keeps(path, limits)
    assert excess(path, limits) == pytest.approx(1.0, abs=2e-3)


@settings(max_examples=25)
@given(seed=st.integers(0, 10_000), steps=st.integers(2, 30), vehicles=st.integers(1, 4))
def test_every_row_is_passed_exactly_from_rest_to_rest(
    seed: int, steps: int, vehicles: int
) -> None:
    rows = random_rows(seed, steps, vehicles)
    limits = FlightLimits()
    path = fly_through(rows, limits)
    assert_keeps(path, limits)
    np.testing.assert_array_equal(path.derivative(path.time, 0), rows)
    for end in (0, -1):
        assert not path.velocity[end].any()
        assert not path.acceleration[end].any()
    assert (np.diff(path.time) > 0.0).all()


def test_acceleration_has_no_jumps(own_formation: Path) -> None:
    rows = read_formation(FormationSource(str(own_formation)))
    path = fly_through(rows, FlightLimits())
    time = np.arange(0.0, path.duration, 1e-3)
    jumps = np.linalg.norm(np.diff(path.derivative(time, 2), axis=0), axis=-1)
    assert jumps.max() <= FlightLimits().j_max * 1e-3 * 1.01


def test_the_flight_is_short(own_formation: Path) -> None:
    rows = read_formation(FormationSource(str(own_formation)))
    path = fly_through(rows, FlightLimits())
    distances = np.linalg.norm(np.diff(rows, axis=0), axis=-1).sum(axis=0)
    # Two and a half times what the longest path takes at full speed without any corner.
    assert path.duration < 2.5 * distances.max() / FlightLimits().v_max


def test_a_straight_line_is_flown_close_to_the_limits() -> None:
    rows = np.zeros((101, 1, 3))
    rows[:, 0, 0] = np.linspace(0.0, 20.0, 101)
    limits = FlightLimits(v_max=2.0, a_max=1.0, j_max=4.0)
    ideal = 20.0 / 2.0 + 2.0 / 1.0 + 1.0 / 4.0
    assert ideal <= fly_through(rows, limits).duration < 1.25 * ideal


def test_rows_that_repeat_and_vehicles_that_wait_do_no_harm() -> None:
    rows = np.zeros((30, 2, 3))
    rows[10:20, 0, 0] = np.linspace(0.0, 2.0, 10)
    rows[20:, 0, 0] = 2.0
    path = fly_through(rows, FlightLimits())
    assert_keeps(path, FlightLimits())
    np.testing.assert_array_equal(path.derivative(path.time, 0), rows)
    assert path.duration < 20.0


def test_standing_still_takes_no_time_worth_mentioning() -> None:
    assert fly_through(np.ones((5, 2, 3)), FlightLimits()).duration < 1.0


def test_the_same_rows_give_the_same_bits(own_formation: Path) -> None:
    rows = read_formation(FormationSource(str(own_formation)))
    first, second = (fly_through(rows.copy(), FlightLimits()) for _ in range(2))
    for name in ("time", "position", "velocity", "acceleration"):
        assert getattr(first, name).tobytes() == getattr(second, name).tobytes()
