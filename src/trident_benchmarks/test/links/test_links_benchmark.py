# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import pytest
from trident_benchmarks.__main__ import main
from trident_benchmarks.links import measure
from trident_benchmarks.links.goodput import CASES, GOODPUT_LIMIT, goodput_row
from trident_benchmarks.links.per import PER_LIMIT_DB, counted_losses, ratio_at_tenth
from trident_benchmarks.links.picture import coast_coverage, draw_goodput
from trident_benchmarks.links.silence import silence_line, silence_row
from trident_benchmarks.results import UNUSABLE


def test_goodput_of_one_station_is_that_of_ns3() -> None:
    row = goodput_row(CASES[0], None, 0.3)
    assert row["passed"]
    assert row["mbit_s"] == pytest.approx(30.77, rel=GOODPUT_LIMIT)
    assert measure.line(row).endswith("recorded: 30.77 (%+.1f %%)" % (100 * row["error"]))


def test_a_tenth_of_the_frames_is_lost_at_the_ratio_of_ns3() -> None:
    curve = counted_losses(7, 20, 1500, 19.62, 200)
    assert ratio_at_tenth(curve) == pytest.approx(19.62, abs=PER_LIMIT_DB)


def test_a_load_reaches_its_receiver() -> None:
    row = measure.load_row(measure.LOADS[0], 0.5)
    assert row["sent"] == 350
    assert row["received"] > 300
    assert "heard by one" in measure.line(row)


def test_a_medium_without_radios_changes_no_flight() -> None:
    row = silence_row(2, 1.0, 2)
    assert row["same_end"]
    assert row["ratio"] > 0.0
    assert "the same flight" in silence_line(row)


def test_the_adaptive_rate_and_its_picture(tmp_path: Path) -> None:
    row = measure.adaptive_row(300.0, is_quick=True)
    assert len(row["fixed_mbit_s"]) == 9
    assert 0.5 < row["share"] < 1.2
    draw_goodput(tmp_path / "goodput.png", [row, row | {"distance_m": 400.0}])
    assert (tmp_path / "goodput.png").stat().st_size > 10_000


def test_a_uav_covers_the_harbor_better_than_a_mast() -> None:
    coverage = coast_coverage(9)
    mast, uav = coverage["a mast on the shore"], coverage["a UAV at 25 m"]
    assert mast.shape == (9, 9)
    assert (uav[:4] > mast[:4]).mean() > 0.9  # the sea in the south
    assert uav[:4].min() > 10.0


def test_a_missing_folder_is_refused_before_anything_is_measured(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["links", "--out", str(tmp_path / "no" / "rows.json")]) == UNUSABLE
    assert "its folder does not exist" in capsys.readouterr().err
