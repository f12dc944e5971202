# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The three domains together: a small fleet is measured, rows are printed, bad names refused."""

from __future__ import annotations

import dataclasses
from typing import Any

import pytest
from trident_benchmarks.__main__ import main
from trident_benchmarks.results import UNUSABLE
from trident_benchmarks.sim import coast
from trident_eval.core.errors import EvalError


def row(**values: Any) -> dict[str, Any]:
    known = {"mode": "fleet", "n": 3, "platforms": {"uavs": 1, "ugvs": 0, "usvs": 2}}
    figures = {"rtf": 7.5, "least_rtf": 5.0, "cpu_s_per_sim_s": 0.1, "world": "coast"}
    return known | figures | {"repeatable": True, "same_for_all_threads": True} | values


def test_a_fleet_without_cameras_is_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(coast, "_HASH_S", 0.2)
    monkeypatch.setattr(coast, "_WARM_UP_S", 0.3)
    case = dataclasses.replace(coast.CASES[0], groups=(coast.OTHERS, coast.LIDARS_3D), sim_s=0.5)
    measured = coast.measure(case, 1, quick=False)
    assert measured["rtf"] > 0.0
    assert coast.is_sound(measured)
    assert len(measured["state_hash"]) == 64


def test_a_silent_sensor_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(coast, "_WARM_UP_S", 0.1)
    case = dataclasses.replace(coast.CASES[1], sim_s=0.01)
    with pytest.raises(EvalError, match=r"wamvs: nothing on usv1/fix in 0.01 s"):
        coast.measure(case, 1, quick=False)


def test_rows_are_printed() -> None:
    failed = coast.failed(coast.CASES[0], "no such world")
    assert coast.headline([row(), failed]) == {"fleet_rtf": 7.5}
    table = coast.markdown_table([row(), row(repeatable=False), failed])
    assert "| fleet | 1 uavs, 2 usvs in coast | 7.5 | 5 | 0.1 | yes |" in table
    assert "| NO |" in table
    assert "failed: no such world" in table
    assert "DIFFER" in coast.line(row(same_for_all_threads=False))


def test_a_number_of_each_row_is_asked_for() -> None:
    asked = {case.name: (case.platforms, case.least_rtf) for case in coast.CASES}
    assert asked["cross_domain"] == ((1, 1, 1), 2.0)
    assert asked["wamvs"] == ((0, 0, 2), 20.0)
    assert asked["fleet"] == ((6, 6, 6), 5.0)
    assert asked["fleet_lidar"] == ((6, 6, 6), 2.0)


def test_an_unknown_fleet_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sim", "--world", "coast", "--mode", "armada"]) == UNUSABLE
    assert "mode 'armada' is unknown; legal: cross_domain, wamvs" in capsys.readouterr().err
