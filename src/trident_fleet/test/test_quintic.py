# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from trident_fleet.core.quintic import QuinticPath, hold, rest_to_rest

numbers = st.floats(-10.0, 10.0)


def some_path(rng: np.random.Generator, knots: int = 5, vehicles: int = 2) -> QuinticPath:
    time = np.cumsum(rng.uniform(0.1, 1.0, knots))
    return QuinticPath(time, *(rng.normal(size=(knots, vehicles, 3)) for _ in range(3)))


def test_knot_states_are_reached_from_both_sides() -> None:
    path = some_path(np.random.default_rng(1))
    for before in (0.0, 1e-9):
        motion = path.sample(path.time[1:-1] - before)
        np.testing.assert_allclose(motion.position, path.position[1:-1], atol=1e-6)
        np.testing.assert_allclose(motion.velocity, path.velocity[1:-1], atol=1e-5)
        np.testing.assert_allclose(motion.acceleration, path.acceleration[1:-1], atol=1e-4)


@pytest.mark.parametrize("order", [0, 1, 2])
def test_each_derivative_is_that_of_the_one_before(order: int) -> None:
    path = some_path(np.random.default_rng(2))
    h = 1e-6
    time = np.linspace(path.time[0] + 0.01, path.time[-1] - 0.01, 57)
    difference = path.derivative(time + h, order) - path.derivative(time - h, order)
    np.testing.assert_allclose(difference / (2 * h), path.derivative(time, order + 1), atol=2e-3)


@given(coefficients=arrays(np.float64, (6, 1, 3), elements=numbers))
def test_a_quintic_is_reproduced(coefficients: np.ndarray) -> None:
    def value(time: np.ndarray, order: int) -> np.ndarray:
        powers = np.arange(6)
        factor = np.ones(6)
        for _ in range(order):
            factor, powers = factor * powers, np.maximum(powers - 1, 0)
        return np.einsum("mk,kni->mni", factor * time[:, None] ** powers, coefficients)

    knots = np.array([0.5, 1.0, 2.5])
    path = QuinticPath(knots, *(value(knots, order) for order in range(3)))
    time = np.linspace(0.5, 2.5, 21)
    for order in range(4):
        scale = np.abs(coefficients).max() * 500.0 + 1.0
        np.testing.assert_allclose(
            path.derivative(time, order), value(time, order), atol=1e-10 * scale
        )


def test_fractions_of_every_step_are_the_same_as_times() -> None:
    path = some_path(np.random.default_rng(3))
    fractions = np.array([0.0, 0.25, 0.75])
    time = (path.time[:-1, None] + np.diff(path.time)[:, None] * fractions).ravel()
    for order in range(4):
        at = path.at_fractions(fractions, order).reshape(-1, 2, 3)
        np.testing.assert_allclose(at, path.derivative(time, order), rtol=1e-6, atol=1e-6)


def test_before_and_after_it_rests() -> None:
    path = rest_to_rest(np.zeros((1, 3)), np.ones((1, 3)), 2.0)
    motion = path.sample(np.array([-1.0, 0.0, 2.0, 5.0]))
    np.testing.assert_array_equal(motion.position[:, 0, 0], [0.0, 0.0, 1.0, 1.0])
    np.testing.assert_allclose(motion.velocity, 0.0, atol=1e-12)
    np.testing.assert_allclose(motion.acceleration, 0.0, atol=1e-12)


def test_minimum_jerk_peaks_at_fifteen_eighths_of_the_mean_speed() -> None:
    path = rest_to_rest(np.zeros((1, 3)), np.array([[4.0, 0.0, 0.0]]), 2.0)
    speed = path.derivative(np.linspace(0.0, 2.0, 201), 1)[:, 0, 0]
    assert speed.max() == pytest.approx(1.875 * 4.0 / 2.0)


def test_slower_is_the_same_path() -> None:
    path = some_path(np.random.default_rng(4))
    slow = path.stretched(2.0)
    time = np.linspace(path.time[0], path.time[-1], 31)
    late = path.time[0] + 2.0 * (time - path.time[0])
    np.testing.assert_allclose(slow.derivative(late, 0), path.derivative(time, 0), atol=1e-9)
    np.testing.assert_allclose(slow.derivative(late, 1), path.derivative(time, 1) / 2, atol=1e-9)


def test_one_after_the_other() -> None:
    first = hold(np.zeros((1, 3)), 1.5)
    both = first.then(rest_to_rest(np.zeros((1, 3)), np.ones((1, 3)), 2.0))
    assert both.duration == 3.5
    np.testing.assert_array_equal(both.derivative(np.array([1.5, 3.5]), 0)[:, 0, 0], [0.0, 1.0])


def test_a_single_knot_is_a_place() -> None:
    place = QuinticPath(np.zeros(1), *(np.ones((1, 2, 3)),) * 3)
    np.testing.assert_array_equal(place.sample(np.array([3.0])).position, np.ones((1, 2, 3)))
    np.testing.assert_array_equal(place.sample(np.array([3.0])).velocity, np.zeros((1, 2, 3)))
