# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Judges a robot that has mapped a world along a tour and found itself in the map again."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from trident_eval.core.errors import EvalError
from trident_eval.core.provenance import read_object
from trident_eval.core.tracks import Array
from trident_eval.core.verdict import Verdict, take_over
from trident_eval.slam import evaluation
from trident_eval.slam.alignment import absolute_errors
from trident_eval.slam.grid import read_grid
from trident_eval.slam.map_agreement import agreement
from trident_eval.slam.trajectory import Trajectory, read_tum

RECORD = "slam_tour.json"
MAPPING, LOCALIZATION, TRUTH = "mapping", "localization", "truth"
ATE_LIMIT_M = 0.05
PRECISION_LIMIT = 0.95


def write_tum(path: Path, trajectory: Trajectory) -> None:
    """Write a trajectory, six decimals."""
    rows = np.column_stack([trajectory.stamp, trajectory.p, trajectory.R.as_quat()])
    np.savetxt(path, rows, fmt="%.6f")


def moved(trajectory: Trajectory, T: Array) -> Trajectory:
    """The trajectory in another frame; `T` is a 4 x 4 matrix."""
    R = Rotation.from_matrix(T[:3, :3])
    return Trajectory(trajectory.stamp, R.apply(trajectory.p) + T[:3, 3], R * trajectory.R)


def read_record(folder: Path) -> dict[str, Any] | None:
    """What the tour's node wrote about the tour, or None without one.

    Raises:
        EvalError: it is not what the node writes.
    """
    path = folder / RECORD
    if not path.is_file():
        return None
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise EvalError(f"{path}: {error}; legal: what slam_tour.py writes") from error
    needed = {"world", "robot", "start", "lidar_height", "errors"}
    if not isinstance(record, dict) or not needed <= record.keys():
        raise EvalError(f"{path}: needs {', '.join(sorted(needed))}")
    return record


def judge_tour(folder: Path, record: dict[str, Any]) -> tuple[evaluation.Evaluation, Verdict]:
    """Both rounds and the map against the truth.

    The map's frame is laid on the world by the first round; the second round is judged in that
    frame, so that it counts where in the map the robot believes to be.
    """
    found = evaluation.Evaluation()
    reasons = [str(error) for error in record["errors"]]
    truth = read_tum(folder / f"{TRUTH}.tum") if not reasons else None
    if truth is not None:
        first = found.trajectories[MAPPING] = read_tum(folder / f"{MAPPING}.tum")
        found.absolute[MAPPING] = absolute_errors(first, truth, "SE2")
        T = found.absolute[MAPPING].T_truth_map
        second = found.trajectories[LOCALIZATION] = read_tum(folder / f"{LOCALIZATION}.tum")
        found.absolute[LOCALIZATION] = absolute_errors(moved(second, T), truth, "none")
        place = np.eye(3)
        place[:2, :2], place[:2, 2] = T[:2, :2], T[:2, 3]
        found.grid = read_grid(folder / "map.yaml")
        found.true_grid = read_grid(_true_map(folder, record))
        found.agreement = agreement(found.grid, found.true_grid, place)
    numbers = {"mode": "slam", "world": record["world"], "vehicles": [record["robot"]]}
    numbers |= {"ate_limit_m": ATE_LIMIT_M, "precision_limit": PRECISION_LIMIT}
    numbers |= found.summary()
    run = read_object(folder / "run.json")
    numbers |= {key: run[key] for key in ("state_hash", "sim_s", "wall_s", "rtf") if key in run}
    verdict = Verdict(numbers, reasons + _reasons(numbers))
    take_over(run, verdict)
    return found, verdict


def _reasons(numbers: dict[str, Any]) -> list[str]:
    reasons = []
    for part in (MAPPING, LOCALIZATION):
        error = numbers.get(part, {}).get("ate_rmse_m")
        if error is not None and error >= ATE_LIMIT_M:
            reasons.append(f"{part}: ATE RMSE {error:.3f} m, must be below {ATE_LIMIT_M} m")
    precision = numbers.get("map", {}).get("map_precision")
    if precision is not None and precision < PRECISION_LIMIT:
        reasons.append(f"map: {precision:.3f} of its walls are right, must be {PRECISION_LIMIT}")
    return reasons


def _true_map(folder: Path, record: dict[str, Any]) -> Path:
    x, y, _ = record["start"]
    target = folder / "true_map.pgm"
    words = [record["world"], f"--start={x},{y}", f"--height={record['lidar_height']}"]
    command = [sys.executable, "-m", "trident_sim.worldmap", *words, "--out", str(target)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise EvalError(f"the true map of {record['world']}: {done.stderr.strip()}")
    return target.with_suffix(".yaml")
