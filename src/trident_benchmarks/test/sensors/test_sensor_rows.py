# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from trident_benchmarks.__main__ import main
from trident_benchmarks.results import UNUSABLE
from trident_benchmarks.sensors import ray_sensors as sensors


def row(mode: str, **values: float) -> dict[str, object]:
    known = {"samples_per_s": 1.0, "mrays_per_s": 2.0, "core_share": 0.5, "rtf": 4.0}
    return {"mode": mode, "n": 1, "runs": 1} | known | values


def test_the_figures_that_are_asked_for() -> None:
    rows = [
        row("rings16x1800", mrays_per_s=11.5),
        row("vlp16_10hz", core_share=0.03),
        row("rgbd_640x480_30hz", rtf=1.7),
        {"mode": "scan360", "n": 1, "error": "no such plugin"},
    ]
    assert sensors.headline(rows) == {
        "mrays_per_s_core": 11.5,
        "vlp16_core_share": 0.03,
        "rgbd_640x480_30hz_rtf": 1.7,
    }


def test_a_table_has_gazebos_figures_and_failures() -> None:
    text = sensors.markdown_table([row("scan360"), {"mode": "b", "n": 6, "error": "why"}])
    assert "| scan360 | 1 | 1 | 2 | 0.5 | 4 | 1 |" in text
    assert "| b | 6 | failed: why |" in text
    assert "scan360_per_s 3700" in text


def test_every_case_has_a_name_of_its_own() -> None:
    names = [case.name for case in sensors.CASES]
    assert len(set(names)) == len(names)


def test_a_lidar_is_measured_on_moving_robots() -> None:
    pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")
    case = next(case for case in sensors.CASES if case.name == "scan360_6robots")
    result = sensors.measure(case, 1, quick=True)
    assert result["n"] == 6
    assert result["samples_per_s"] > 0.0
    assert result["mrays_per_s"] == pytest.approx(result["samples_per_s"] * 360 / 1e6)


def test_an_unknown_row_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sensors", "--mode", "sonar"]) == UNUSABLE
    assert "mode 'sonar' is unknown; legal: scan360" in capsys.readouterr().err
