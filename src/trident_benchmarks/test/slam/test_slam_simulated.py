# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""SLAM on simulated drives: how it is judged, and two drives of the benchmark."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from trident_benchmarks.__main__ import main
from trident_benchmarks.datasets.recorded_drive import Lidar, Recording, Sweep
from trident_benchmarks.slam import simulated
from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import package_folder

RING = np.array([[0.0, -4.5], [18.8, -4.5], [18.8, 4.6], [0.0, 4.6], [0.0, -4.5]])
TRUTH = np.array([[0.0, 0.0, 0.0, 0.0], [1.0, 1.0, 0.0, 0.0], [2.0, 1.0, 1.0, math.pi / 2]])


def row(**changes: Any) -> dict[str, Any]:
    """A row of the benchmark that keeps all limits."""
    errors = {"ate_rmse_m": 0.02, "ate_max_m": 0.1}
    walls = {"map_precision": 1.0, "map_recall": 1.0, "map_wall_error_mean_m": 0.01}
    whole = {"seed": 3, "scans": 9, "way_m": 5.0, "cpu_s": 1.0, "loops": 1, "reused": 2}
    whole |= {"false_loops": 0, "map": walls | {"wall_thickness_m": 0.05}}
    return whole | {"final": errors, "causal": errors, "localization": errors} | changes


@pytest.mark.parametrize(
    ("x", "yaw", "false"),
    [(1.29, 0.0, 0), (1.31, 0.0, 1), (1.0, 0.08, 0), (1.0, -0.09, 1), (1.0, 2 * math.pi, 0)],
)
def test_a_loop_is_false_beyond_the_limits(
    tmp_path: Path, x: float, yaw: float, false: int
) -> None:
    file = tmp_path / "loops.csv"
    turned = yaw + math.pi / 2
    file.write_text(f"head\n0,1,{x},0,{yaw},loop\n1,2,0,1,{turned},reuse\n1,2,0,1,1.57,reuse\n")
    loops = simulated.judge_loops(file, TRUTH)
    assert (loops.found, loops.reused) == (1, 2)
    assert loops.false == false * (2 if x == 1.0 else 1)


def test_limits_are_strict_and_named() -> None:
    assert simulated.reasons([row()]) == []
    bad = {"ate_rmse_m": 0.05, "ate_max_m": 0.1}
    missed = simulated.reasons([row(final=bad), row(false_loops=2), row(localization=bad)])
    assert missed == [
        "seed 3: final: RMSE 0.050 m, limit 0.05 m",
        "seed 3: 2 false loops, must be 0",
        "seed 3: localization: RMSE 0.050 m, limit 0.05 m",
    ]
    assert simulated.reasons([row(final={"ate_rmse_m": math.nan, "ate_max_m": 0})])


def test_the_command_prints_the_table_and_fails_where_a_limit_is_missed(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    rows = [row(), row(seed=4, false_loops=1)]

    def measure_all(name: str, seeds: range, *_: Any) -> list[dict[str, Any]]:
        assert (name, list(seeds)) == ("office", [0, 1])
        return rows

    monkeypatch.setattr(simulated, "measure_all", measure_all)
    words = ["slam", "--world", "office", "--quick", "--out", str(tmp_path / "rows.json")]
    assert main(words) == 1
    said = capsys.readouterr().out
    assert "| 4 | 5 | 1 | 2 | 1 | 0.0200 |" in said
    assert "seed 4: 1 false loops" in said
    assert json.loads((tmp_path / "rows.json").read_text())["rows"] == rows
    rows.pop()
    assert main(words) == 0


def test_a_world_that_is_not_there_is_named(tmp_path: Path) -> None:
    pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")
    with pytest.raises(EvalError, match=r"world atlantis: no file .*atlantis.world"):
        simulated.building("atlantis", tmp_path)


def test_a_drive_becomes_a_carmen_log(tmp_path: Path) -> None:
    lidar = Lidar(0.0, math.pi, 0.15, 12.0, 0.001)
    sweep = Sweep(1.5, np.array([2.0, math.inf]), np.array([1.0, 2.0, 0.5]), np.zeros(3))
    log = tmp_path / "drive.log"
    simulated.write_carmen(Recording(lidar, (sweep,), TRUTH[:1], np.zeros(3)), log)
    assert log.read_text().splitlines() == [
        "PARAM laser_range_min 0.15",
        "PARAM laser_time_increment 0.001",
        "ROBOTLASER1 0 0.000000000 6.283185307 3.141592654 12 0.01 0 2 2.000 12.000 0 1.000000 "
        "2.000000 0.50000000 1.000000 2.000000 0.50000000 0 0 0 0 0 1.500000 sim 1.500000",
    ]


@pytest.fixture(scope="module")
def office() -> Path:
    pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")
    return package_folder("trident_bringup") / "worlds" / "office.world"


@pytest.mark.parametrize("seed", [0, 1])
def test_the_office_is_mapped_and_found_again(office: Path, seed: int, tmp_path: Path) -> None:
    numbers, final = simulated.map_drive(drive(office, RING, seed), tmp_path)
    assert final.summary()["ate_rmse_m"] < simulated.ATE_LIMIT_M
    assert numbers["way_m"] > 50.0
    assert numbers["loops"] + numbers["reused"] > 0
    assert numbers["false_loops"] == 0
    T, session = final.T_truth_map, tmp_path / "map.session"
    back = drive(office, RING[:1:-1], seed + 2)
    again = simulated.localize_drive(back, session, T, seed, tmp_path / "again")
    assert again["ate_rmse_m"] < simulated.ATE_LIMIT_M
    assert again["poses"] == len(back.sweeps)


def drive(office: Path, path: npt.NDArray[np.float64], seed: int) -> Recording:
    """Along a path at 0.8 m/s."""
    return simulated.drive_along(office, path, seed, speed=0.8)
