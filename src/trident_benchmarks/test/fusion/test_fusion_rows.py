# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the benchmark of fusion are judged by their limits."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from trident_benchmarks.fusion.picture import draw, ellipse
from trident_benchmarks.fusion.program import runs
from trident_benchmarks.fusion.rows import (
    consistency_rows,
    delays_row,
    lies_row,
    line,
    outage_row,
    outliers_row,
    sharing_row,
    speed_rows,
)


def _run(**changes: Any) -> dict[str, Any]:
    run = {"kind": "ekf", "what": "all", "rms_m": [0.2, 0.2, 0.2], "nees_end": 48.0}
    return run | {"nis": 1000.0, "nis_size": 1000, "accused": 0} | changes


def _consistent(**changes: Any) -> list[dict[str, Any]]:
    alone = [_run(what=what, rms_m=[1.0, 0.4, 0.5]) for what in ("/pose", "/gnss")]
    return [_run(**changes), _run(kind="ukf"), *alone]


def test_a_filter_that_is_too_sure_or_not_sure_enough_misses_the_row() -> None:
    assert [row["passed"] for row in consistency_rows(_consistent())] == [True, True, True]
    for changes in ({"nees_end": 20.0}, {"nees_end": 80.0}, {"nis": 1200.0}):
        row = consistency_rows(_consistent(**changes))[0]
        assert not row["passed"]
        assert "(limit missed)" in line(row)


def test_the_gain_is_that_over_the_best_source_of_each_robot() -> None:
    row = consistency_rows(_consistent())[2]
    assert row["best_single_m"] == pytest.approx([1.0, 0.4, 0.5])
    assert not consistency_rows(_consistent(rms_m=[0.5, 0.5, 0.5]))[2]["passed"]


def test_outliers_and_outages_have_limits_in_meters() -> None:
    pair = [_run(what="without"), _run(what="with", rms_m=[0.21, 0.21, 0.21])]
    assert outliers_row(pair)["worse"] == pytest.approx(0.05)
    pair[1]["rms_m"] = [0.23, 0.23, 0.23]
    assert not outliers_row(pair)["passed"]
    seen = [_run(what="seen", rms_m=[0.0, 0.49, 0.0]), _run(what="unseen", rms_m=[0.0, 2.0, 0.0])]
    assert outage_row(seen)["passed"]
    seen[0]["rms_m"][1] = 0.51
    assert not outage_row(seen)["passed"]


def test_naive_fusion_must_fail_where_intersection_holds() -> None:
    own, naive = _run(what="intersection"), _run(what="naive", nees_end=900.0)
    assert sharing_row([own, naive])["passed"]
    assert not sharing_row([own, naive | {"nees_end": 48.0}])["passed"]
    assert not sharing_row([own | {"nees_end": 90.0}, naive])["passed"]


def test_each_other_row_has_its_limit() -> None:
    late = {"difference": 1e-7, "refused": 0}
    assert delays_row([late])["passed"]
    assert not delays_row([late | {"difference": 2e-6}])["passed"]
    assert not delays_row([late | {"refused": 1}])["passed"]
    assert lies_row([_run(what="uav/gnss")])["passed"]
    assert not lies_row([_run(what="uav/gnss usv/gnss")])["passed"]
    assert not speed_rows([{"kind": "ukf", "cpu_s_per_s": 0.02}])[0]["passed"]


def test_an_ellipse_has_two_standard_deviations_to_each_side() -> None:
    width, height, angle = ellipse([1.0, 0.0, 4.0])
    assert (width, height) == pytest.approx((4.0, 8.0))
    assert angle % 180.0 == pytest.approx(0.0)


def test_the_program_gives_what_rows_and_picture_need(tmp_path: Path) -> None:
    for row in (lies_row(runs("lies", 1)), delays_row(runs("delays", 1))):
        assert row["passed"], line(row)
    points = runs("picture", 1)
    assert len(points) == 2 * 90 * 3
    draw(tmp_path / "fusion.png", points)
    assert (tmp_path / "fusion.png").stat().st_size > 10_000
