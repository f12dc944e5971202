# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from trident_eval.core.metrics import (
    closest_approach,
    instant_rms,
    lengths,
    rigid_residuals,
    rms,
)


def rotation(rng: np.random.Generator) -> np.ndarray:
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q if np.linalg.det(q) > 0 else q[:, [1, 0, 2]]


@given(seed=st.integers(0, 10_000), count=st.integers(1, 8), flat=st.booleans())
def test_a_rigid_motion_leaves_nothing(seed: int, count: int, flat: bool) -> None:
    rng = np.random.default_rng(seed)
    commanded = rng.normal(size=(4, count, 3))
    if flat:
        commanded[..., 2] = 1.0
    turned = np.stack([points @ rotation(rng).T + rng.normal(size=3) for points in commanded])
    np.testing.assert_allclose(rigid_residuals(turned, commanded), 0.0, atol=1e-9)


@given(seed=st.integers(0, 10_000))
def test_no_rigid_motion_does_better(seed: int) -> None:
    rng = np.random.default_rng(seed)
    commanded = rng.normal(size=(1, 6, 3))
    measured = commanded + 0.3 * rng.normal(size=(1, 6, 3))
    best = rms(rigid_residuals(measured, commanded))
    for _ in range(20):
        angle = 0.1 * rng.normal(size=3)
        cross = np.array(
            [[0, -angle[2], angle[1]], [angle[2], 0, -angle[0]], [-angle[1], angle[0], 0]]
        )
        small, _ = np.linalg.qr(np.eye(3) + cross)
        small = small * np.sign(np.diag(small))
        center = commanded.mean(axis=1, keepdims=True)
        moved = (commanded - center) @ small.T + measured.mean(axis=1, keepdims=True)
        aligned = rigid_residuals(moved, commanded)
        assert rms(aligned) < 1e-9
        assert best <= rms(measured - moved) + 1e-12


def test_scale_is_an_error_and_is_not_aligned_away() -> None:
    square = np.array([[[1.0, 1, 0], [-1, 1, 0], [-1, -1, 0], [1, -1, 0]]])
    np.testing.assert_allclose(lengths(rigid_residuals(1.1 * square, square)), 0.1 * np.sqrt(2))


def test_a_mirrored_formation_is_not_aligned_away() -> None:
    triangle = np.array([[[2.0, 0, 0], [0, 1, 0], [0, -1, 1.0], [-1, 0, -1]]])
    assert rms(rigid_residuals(triangle * [1, 1, -1], triangle)) > 0.1


def test_one_vehicle_out_of_place_is_seen_in_the_numbers() -> None:
    line = np.array([[[0.0, 0, 0], [1.0, 0, 0], [2.0, 0, 0], [3.0, 0, 0]]])
    bent = line.copy()
    bent[0, 1, 2] = 0.2
    residuals = rigid_residuals(bent, line)
    assert 0.0 < instant_rms(residuals)[0] < 0.1
    assert instant_rms(bent - line)[0] == pytest.approx(0.1)


def test_an_instant_without_a_vehicle_has_no_error() -> None:
    line = np.array([[[0.0, 0, 0], [1.0, 0, 0]]] * 2)
    gone = line.copy()
    gone[1, 0] = np.nan
    residuals = rigid_residuals(gone, line)
    assert np.isfinite(residuals[0]).all()
    assert np.isnan(residuals[1]).all()
    assert np.isnan(rms(residuals))


def test_approach_counts_between_the_states() -> None:
    points = np.array([[[-1.0, 0.1, 0], [5.0, 0, 0]], [[1.0, 0.1, 0], [np.nan, 0, 0]]])
    np.testing.assert_allclose(closest_approach(points, np.zeros((2, 3))), [0.1, 5.0])
    gone = np.full((2, 1, 3), np.nan)
    assert closest_approach(gone, np.zeros((1, 3)))[0] == np.inf
