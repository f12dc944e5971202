# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import ttest_rel
from trident_eval.core.sweep.statistics import difference, estimate, half_width, holm


def test_an_interval_of_five_numbers_by_hand() -> None:
    found = estimate([1.0, 2.0, 3.0, 4.0, 5.0])
    # Student's t for 4 degrees of freedom at 97.5 %: 2.776445
    assert found.half_width == pytest.approx(2.776445 * math.sqrt(2.5) / math.sqrt(5), rel=1e-6)
    assert (found.t_low + found.t_high) / 2 == pytest.approx(3.0)
    assert 1.0 < found.bootstrap_low < 3.0 < found.bootstrap_high < 5.0


def test_one_number_has_no_interval() -> None:
    found = estimate([2.0])
    assert found.mean == 2.0
    assert math.isnan(found.t_low)
    assert found.half_width == half_width([2.0]) == math.inf


def test_intervals_hold_the_mean_as_often_as_they_say() -> None:
    random = np.random.default_rng(3)
    inside = {"t": 0, "bootstrap": 0}
    for _ in range(400):
        found = estimate(list(random.normal(1.0, 2.0, 12)))
        inside["t"] += found.t_low <= 1.0 <= found.t_high
        inside["bootstrap"] += found.bootstrap_low <= 1.0 <= found.bootstrap_high
    assert 0.92 <= inside["t"] / 400 <= 0.98
    assert inside["bootstrap"] / 400 >= 0.86  # percentiles are narrow for so few numbers


def test_paired_differences_agree_with_scipy() -> None:
    random = np.random.default_rng(4)
    first, second = random.normal(0, 1, 20), random.normal(0.3, 1, 20)
    found = difference(list(first), list(second))
    assert found.p_value == pytest.approx(ttest_rel(first, second).pvalue, rel=1e-9)
    assert found.estimate.mean == pytest.approx(float(np.mean(first - second)))


def test_equal_sides_differ_by_nothing() -> None:
    assert difference([1.0, 2.0], [1.0, 2.0]).p_value == 1.0
    assert difference([2.0, 3.0], [1.0, 2.0]).p_value == 0.0
    assert math.isnan(difference([1.0], [0.0]).p_value)


def test_holm_by_hand() -> None:
    assert holm([0.01, 0.04, 0.03]) == pytest.approx([0.03, 0.06, 0.06])
    with_nan = holm([math.nan, 0.02])
    assert math.isnan(with_nan[0])
    assert with_nan[1] == 0.02


@given(st.lists(st.floats(0.0, 1.0), min_size=1, max_size=20))
def test_holm_keeps_order_and_only_raises(p_values: list[float]) -> None:
    adjusted = holm(p_values)
    assert all(p <= q <= 1.0 for p, q in zip(p_values, adjusted, strict=True))
    by_p = [q for _, q in sorted(zip(p_values, adjusted, strict=True))]
    assert by_p == sorted(by_p)


def test_no_values_are_refused() -> None:
    with pytest.raises(ValueError, match="no values"):
        estimate([])
