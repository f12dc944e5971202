# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from trident_eval.core.sweep.axes import Axis, points_of, read_axes
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.strict_yaml import load

Write = Callable[[str], Path]


def axes_of(path: Path, samples: int = 8) -> tuple[Axis, ...]:
    return read_axes(load(path).section("axes"), samples, 1)


def test_kinds_of_axes(scenario_file: Write) -> None:
    path = scenario_file(
        "axes:\n"
        "  a: {list: [1, x, true]}\n"
        "  b: {range: [0, 1, 5]}\n"
        "  c: {log_range: [0.01, 100, 5]}\n"
        "  d: {grid: {e: [1, 2], f: [3, 4]}}\n"
    )
    a, b, c, d = axes_of(path)
    assert a.points == ((1,), ("x",), (True,))
    assert b.points == ((0.0,), (0.25,), (0.5,), (0.75,), (1.0,))
    assert c.points == ((0.01,), (0.1,), (1.0,), (10.0,), (100.0,))
    assert d == Axis(("e", "f"), ((1, 3), (1, 4), (2, 3), (2, 4)))


@pytest.mark.parametrize("kind", ["latin_hypercube", "sobol"])
def test_sampled_axes_fill_their_ranges_evenly_and_are_the_same_each_time(
    scenario_file: Write, kind: str
) -> None:
    text = f"axes:\n  a: {{{kind}: [0, 1]}}\n  b: {{{kind}: [-2, 2]}}\n"
    (axis,) = axes_of(scenario_file(text), samples=16)
    assert axis.names == ("a", "b")
    points = np.array(axis.points)
    assert points.shape == (16, 2)
    # Both put one point into each of 16 slices of each range.
    assert sorted((points[:, 0] * 16).astype(int)) == list(range(16))
    assert sorted(((points[:, 1] + 2) * 4).astype(int)) == list(range(16))
    assert axes_of(scenario_file(text), samples=16) == (axis,)


@given(st.lists(st.lists(st.integers(), min_size=1, max_size=4, unique=True), max_size=4))
def test_points_are_all_combinations_once(lists: list[list[int]]) -> None:
    axes = [Axis((f"x{i}",), tuple((v,) for v in values)) for i, values in enumerate(lists)]
    points = points_of(axes)
    assert len(points) == int(np.prod([len(values) for values in lists], dtype=int))
    assert len({tuple(sorted(point.items())) for point in points}) == len(points)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a: {}", "a: 0 kinds of values; legal: one of list, grid"),
        ("a: {list: [1], range: [0, 1, 2]}", "a: 2 kinds of values"),
        ("a: {list: []}", "list: empty; legal: one value or more"),
        ("a: {list: 3}", "list: no list"),
        ("a: {range: [0, 1, 0]}", "range: count 0; legal"),
        ("a: {range: [0, 1, 2.5]}", "range: count 2.5; legal"),
        ("a: {range: [0, .nan, 2]}", "range: "),
        ("a: {log_range: [0, 1, 3]}", "log_range: .0, 1.; legal: numbers above 0"),
        ("a: {sobol: [1, 1]}", "sobol: .1, 1.; legal: .lowest, highest."),
        ("a: {sobol: [0, 1]}\n  b: {latin_hypercube: [0, 1]}", "legal: one sampler for all"),
        ("a: {list: [1], extra: 2}", "extra: unknown key"),
    ],
)
def test_bad_axes_are_named_with_their_line(scenario_file: Write, text: str, message: str) -> None:
    with pytest.raises(FormationError, match=rf"study.yaml:\d+: .*{message}"):
        axes_of(scenario_file(f"axes:\n  {text}\n"))


def test_sampled_axes_without_a_number_of_samples(scenario_file: Write) -> None:
    with pytest.raises(FormationError, match="0 samples; legal"):
        axes_of(scenario_file("axes:\n  a: {sobol: [0, 1]}\n"), samples=0)
