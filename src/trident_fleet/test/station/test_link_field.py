# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
from trident_fleet.core.quintic import Array
from trident_fleet.core.station.config import FieldConfig
from trident_fleet.core.station.link_field import LinkField, Measurement, field_of

CONFIG = FieldConfig()
OTHER = np.array([10.0, -40.0, 2.0])


def places(count: int, seed: int = 1) -> Array:
    return np.random.default_rng(seed).uniform([-40, -40, 15], [40, 40, 30], (count, 3))


def measured(at: Array, snr_db: Array, other: Array = OTHER) -> list[Measurement]:
    return [
        Measurement(float(i), place, other, float(value))
        for i, (place, value) in enumerate(zip(at, snr_db, strict=True))
    ]


def covariance(a: Array, b: Array) -> Array:
    """The kernel, all at once."""
    c = CONFIG
    distance = [np.linalg.norm(p - OTHER, axis=1) for p in (a, b)]
    log = [10.0 * np.log10(d / 50.0) for d in distance]
    turn = [(p - OTHER) / d[:, None] for p, d in zip((a, b), distance, strict=True)]
    apart = np.linalg.norm(a[:, None] - b[None], axis=-1)
    turned = np.linalg.norm(turn[0][:, None] - turn[1][None], axis=-1)
    return np.asarray(
        c.level_sigma_db**2
        + c.exponent_sigma**2 * np.outer(*log)
        + c.shadow_sigma_db**2 * np.exp(-apart / c.decorrelation_m)
        + c.blocked_sigma_db**2 * np.exp(-turned / c.view_rad)
    )


def free_space(at: Array, level_db: float = CONFIG.level_db) -> Array:
    return np.asarray(level_db - 20.0 * np.log10(np.linalg.norm(at - OTHER, axis=1)))


def test_the_posterior_is_that_of_the_formula() -> None:
    seen, asked = places(30), places(50, seed=2)
    values = free_space(seen, 55.0) + np.random.default_rng(3).normal(0.0, 3.0, 30)
    field = field_of(measured(seen, values), asked, OTHER, CONFIG, 0)
    inverse = np.linalg.inv(covariance(seen, seen) + CONFIG.noise_db**2 * np.eye(30))
    cross = covariance(asked, seen)
    mean = free_space(asked) + cross @ inverse @ (values - free_space(seen))
    variance = np.diag(covariance(asked, asked) - cross @ inverse @ cross.T)
    np.testing.assert_allclose(field.mean_db, mean, atol=2e-2)
    np.testing.assert_allclose(field.variance_db2, variance, atol=2e-2)


def test_level_and_exponent_are_fitted() -> None:
    seen, asked = places(60), places(40, seed=2)
    distance = np.linalg.norm(asked - OTHER, axis=1)
    law = 44.0 - 25.0 * np.log10(distance)
    values = 44.0 - 25.0 * np.log10(np.linalg.norm(seen - OTHER, axis=1))
    field = field_of(measured(seen, values), asked, OTHER, CONFIG, 0)
    assert np.abs(field.mean_db - law).max() < 1.5
    assert np.abs(free_space(asked) - law).min() > 15.0


def test_without_measurements_it_is_the_prior() -> None:
    asked = places(20)
    field = LinkField(asked, OTHER, CONFIG, 5)
    np.testing.assert_allclose(field.mean_db, free_space(asked))
    assert field.variance_db2.min() > CONFIG.level_sigma_db**2


def test_a_drop_is_expected_again_in_that_direction() -> None:
    seen = places(80)
    blocked = seen[:, 0] > OTHER[0] + 5.0
    values = free_space(seen) - 12.0 * blocked
    asked = np.array([[35.0, 20.0, 20.0], [-35.0, 20.0, 20.0]])
    field = field_of(measured(seen, values), asked, OTHER, CONFIG, 0)
    behind, free = field.mean_db - free_space(asked)
    assert behind < free - 8.0


def test_what_was_measured_before_the_other_moved_on_counts_less() -> None:
    seen = places(1)
    level = measured(places(40, seed=5), free_space(places(40, seed=5)))
    high = measured(seen, free_space(seen) + 8.0)
    there = field_of(level + high, seen, OTHER, CONFIG, 0)
    moved = OTHER + np.array([30.0, 0.0, 0.0])
    gone = field_of(level + high, seen, moved, CONFIG, 0)
    prior = field_of(level, seen, OTHER, CONFIG, 0)
    assert there.mean_db[0] > prior.mean_db[0] + 5.0
    assert gone.variance_db2[0] > there.variance_db2[0] + 5.0


def test_it_is_full_when_it_is() -> None:
    field = LinkField(places(5), OTHER, CONFIG, 2)
    for measurement in measured(places(2), np.array([20.0, 21.0])):
        assert not field.is_full
        field.add(measurement)
    assert field.is_full
