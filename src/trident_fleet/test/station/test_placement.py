# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import NamedTuple, cast

import numpy as np
import pytest
from polygons import U_SHAPE
from trident_fleet.core.quintic import Array
from trident_fleet.core.station.fence import Fence
from trident_fleet.core.station.link_field import LinkField
from trident_fleet.core.station.placement import (
    expected_gain,
    places_about,
    survey_places,
    worst_of,
)

FENCE = Fence(U_SHAPE, 10.0, 30.0)
OTHERS = [np.array([20.0, 95.0, 1.0]), np.array([80.0, 95.0, 1.0])]


class Normal(NamedTuple):
    """What `worst_of` looks at of a field."""

    mean_db: Array
    variance_db2: Array


def worst(*normals: tuple[float, float]) -> tuple[float, float]:
    fields = [Normal(np.array([mean]), np.array([sigma**2])) for mean, sigma in normals]
    mean, variance = worst_of(cast("list[LinkField]", fields))
    return float(mean[0]), math.sqrt(float(variance[0]))


@pytest.mark.parametrize(
    "normals",
    [
        [(20.0, 3.0), (22.0, 1.0)],
        [(20.0, 3.0), (20.0, 3.0)],
        [(15.0, 0.1), (30.0, 5.0)],
        [(20.0, 2.0), (21.0, 3.0), (19.0, 1.0)],
    ],
)
def test_the_moments_of_the_worst_are_those_of_many_draws(
    normals: list[tuple[float, float]],
) -> None:
    random = np.random.default_rng(1)
    draws = np.min([random.normal(mean, sigma, 200_000) for mean, sigma in normals], axis=0)
    mean, sigma = worst(*normals)
    assert mean == pytest.approx(draws.mean(), abs=0.03)
    assert sigma == pytest.approx(draws.std(), abs=0.03 if len(normals) == 2 else 0.07)


@pytest.mark.parametrize(("mean", "sigma"), [(20.0, 3.0), (25.0, 0.5), (15.0, 4.0), (10.0, 1.0)])
def test_the_expected_gain_is_that_of_many_draws(mean: float, sigma: float) -> None:
    draws = np.random.default_rng(2).normal(mean, sigma, 400_000)
    gain = expected_gain(np.array([mean]), np.array([sigma**2]), 21.0)[0]
    assert gain == pytest.approx(np.maximum(draws - 21.0, 0.0).mean(), abs=0.01)


def test_places_of_a_survey_are_in_the_fence_and_not_more_than_asked_for() -> None:
    random = np.random.default_rng(3)
    for count in (50, 500, 3000):
        places = survey_places(FENCE, 2.0, OTHERS, count, random)
        assert count / 3 <= len(places) <= count
        assert FENCE.clearance(places).min() >= 2.0


def test_places_of_a_survey_leave_what_is_far_from_a_robot_aside() -> None:
    places = survey_places(FENCE, 2.0, OTHERS, 2000, np.random.default_rng(3))
    farthest = np.max([np.linalg.norm(places - other, axis=1) for other in OTHERS], axis=0)
    assert 20.0 * math.log10(farthest.max() / farthest.min()) <= 6.0


def test_a_flat_fence_has_places_too() -> None:
    flat = Fence(U_SHAPE, 10.0, 12.0)
    places = survey_places(flat, 1.0, [], 400, np.random.default_rng(3))
    assert len(places) > 100
    np.testing.assert_allclose(places[:, 2], 11.0)


def test_places_about_a_center_are_near_it_and_in_the_fence() -> None:
    center = np.array([3.0, 50.0, 12.0])
    places = places_about([center], FENCE, 2.0, np.random.default_rng(4))
    np.testing.assert_array_equal(places[0], center)
    assert len(places) > 30
    assert np.linalg.norm(places - center, axis=1).max() <= 2.5
    assert FENCE.clearance(places).min() >= 2.0 - 1e-9
