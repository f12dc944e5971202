# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from test_slam_metrics import drive, room, write_map, write_tum
from trident_eval.__main__ import main
from trident_eval.slam import tour
from trident_eval.slam.trajectory import Trajectory

RECORD = {"world": "room", "robot": "r", "start": [0, 0, 0], "lidar_height": 0.1, "errors": []}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A tour without an error, whose map lies a metre off the world's origin."""
    truth = drive(200)
    T = np.eye(4)
    T[0, 3] = 1.0
    write_tum(tmp_path / "truth.tum", tour.moved(truth, T))
    write_tum(tmp_path / "mapping.tum", truth)
    write_tum(tmp_path / "localization.tum", truth)
    grid = room()
    write_map(tmp_path, grid)
    true_folder = tmp_path / "true"
    true_folder.mkdir()
    shifted = type(grid)(grid.cells, grid.resolution, grid.origin + np.array([1.0, 0.0, 0.0]))
    yaml = write_map(true_folder, shifted)
    monkeypatch.setattr(tour, "_true_map", lambda folder, record: yaml)
    (tmp_path / tour.RECORD).write_text(json.dumps(RECORD))
    return tmp_path


def test_a_good_tour_passes(folder: Path) -> None:
    assert main(["verdict", str(folder), "--no-pictures"]) == 0
    verdict = json.loads((folder / "verdict.json").read_text())
    assert verdict["pass"]
    assert verdict["mapping"]["ate_rmse_m"] < 1e-5
    assert verdict["localization"]["ate_rmse_m"] < 1e-5
    assert verdict["map"]["map_precision"] == 1.0


def test_the_second_round_is_judged_in_the_frame_of_the_first(folder: Path) -> None:
    truth = drive(200)
    write_tum(
        folder / "localization.tum",
        Trajectory(truth.stamp, truth.p + np.array([0.0, 0.2, 0.0]), truth.R),
    )
    assert main(["verdict", str(folder), "--no-pictures"]) == 1
    verdict = json.loads((folder / "verdict.json").read_text())
    assert verdict["localization"]["ate_rmse_m"] == pytest.approx(0.2, abs=1e-4)
    assert verdict["reasons"] == ["localization: ATE RMSE 0.200 m, must be below 0.05 m"]


def test_a_tour_that_broke_off_fails(folder: Path) -> None:
    record = RECORD | {"errors": ["amcl: not there after 60 s"]}
    (folder / tour.RECORD).write_text(json.dumps(record))
    assert main(["verdict", str(folder), "--no-pictures"]) == 1
    verdict = json.loads((folder / "verdict.json").read_text())
    assert verdict["reasons"] == ["amcl: not there after 60 s"]


def test_a_damaged_record_is_named(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / tour.RECORD).write_text("{")
    assert main(["verdict", str(folder)]) == 2
    assert "slam_tour.json" in capsys.readouterr().err
