# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""SLAM on drives through a simulated building, judged by the truth, for many seeds.

Each seed drives a tour of its own by every room, which is mapped, and a second one, which is
localised in the saved session. Sensors are those of `datasets.recorded_drive`: an RPLidar A1 with
noise, encoders with drift. Nothing of it needs ROS.
"""

from __future__ import annotations

import json
import math
import tempfile
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation
from trident_eval.core.errors import EvalError
from trident_eval.core.tracks import Array
from trident_eval.ros_paths import package_folder
from trident_eval.slam.alignment import AbsoluteErrors, absolute_errors
from trident_eval.slam.grid import Grid, read_grid
from trident_eval.slam.map_agreement import agreement
from trident_eval.slam.offline import Run, run_log
from trident_eval.slam.tour import moved, write_tum
from trident_eval.slam.trajectory import Trajectory, read_tum

from trident_benchmarks.datasets.recorded_drive import Noise, Recording, compose, drive, relative
from trident_benchmarks.datasets.route import Roads, RoutePilot

METHOD = "graph_slam_2d"
ATE_LIMIT_M = 0.05
FALSE_M, FALSE_RAD = 0.3, math.radians(5.0)
_APART_M = 5.0
_SECOND_SEED = 1000  # the second drive's is so much larger
_SLOWEST_M_S = 0.1  # a drive that is slower has not come to its end
_START_SIGMA = (0.1, 0.1, 0.05)  # of where a user says that the robot is [m, m, rad]
_LIDAR_Z_M = 0.115
_ROBOT_HEIGHTS_M = (0.03, _LIDAR_Z_M, 0.2)


@dataclass(frozen=True)
class Building:
    """A world, paths through it and its true map.

    Attributes:
        world_file: SDF.
        roads: where the robot has room.
        truth: cut at the lidar's height.
    """

    world_file: Path
    roads: Roads
    truth: Grid


@dataclass(frozen=True)
class Loops:
    """What graph_slam_2d took for one place, by whether it was.

    Attributes:
        found: by the search for loops.
        reused: surfaces of long ago that the scan was matched against.
        false: of both, farther from the truth than FALSE_M or FALSE_RAD.
    """

    found: int
    reused: int
    false: int


def building(name: str, folder: Path, start: tuple[float, float] = (0.0, 0.0)) -> Building:
    """Cut a world and look for paths through it.

    Args:
        name: of a file in worlds/, or a file.
        folder: where the true map goes.
        start: a free point from which all that is mapped can be reached.

    Raises:
        EvalError: there is no such world.
    """
    from trident_sim.occupancy import MapConfig, occupancy_map

    from trident_sim import SimulationWarning, World

    file = Path(name)
    if file.suffix != ".world":
        file = package_folder("trident_bringup") / "worlds" / f"{name}.world"
    if not file.is_file():
        raise EvalError(
            f"world {name}: no file {file}; legal: a file, or the name of one in worlds/"
        )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SimulationWarning)
        world = World(file)
        true_map = occupancy_map(world, MapConfig(heights=(_LIDAR_Z_M,), start=start))
        roads = Roads(occupancy_map(world, MapConfig(heights=_ROBOT_HEIGHTS_M, start=start)))
    true_map.save(folder / "true_map.pgm")
    return Building(file, roads, read_grid(folder / "true_map.yaml"))


def drive_along(world_file: Path, waypoints: Array, seed: int, speed: float = 0.5) -> Recording:
    """A drive along waypoints, from the first to the last one.

    Args:
        world_file: SDF.
        waypoints: x, y [m, world], shape (n, 2).
        seed: of the sensors' noise.
        speed: on straights [m/s].

    Raises:
        EvalError: the robot does not come to the end.
    """
    ahead = waypoints[1] - waypoints[0]
    start = np.array([[*waypoints[0], math.atan2(ahead[1], ahead[0])]])
    length = float(np.linalg.norm(np.diff(waypoints, axis=0), axis=1).sum())
    pilot = RoutePilot(waypoints, speed)
    recording = drive(world_file, start, seed, length / _SLOWEST_M_S, Noise(), pilot=pilot)
    if not pilot.is_done:
        raise EvalError(f"{world_file}: seed {seed}: the robot did not come to the end of its tour")
    return recording


def write_carmen(recording: Recording, path: Path) -> None:
    """A drive as a CARMEN log, which also contains how long a sweep takes."""
    lidar = recording.lidar
    lines = [f"PARAM laser_range_min {lidar.range_min:.6g}"]
    lines += [f"PARAM laser_time_increment {lidar.time_increment:.9g}"]
    for sweep in recording.sweeps:
        count = len(sweep.ranges)
        ranges = np.where(np.isfinite(sweep.ranges), sweep.ranges, lidar.range_max)
        x, y, yaw = sweep.begin
        pose = f"{x:.6f} {y:.6f} {yaw:.8f}"
        about = f"0 {lidar.angle_min:.9f} {lidar.angle_increment * count:.9f}"
        about += f" {lidar.angle_increment:.9f} {lidar.range_max:g} 0.01 0"
        values = " ".join(f"{value:.3f}" for value in ranges)
        stamp = f"{sweep.stamp:.6f} sim {sweep.stamp:.6f}"
        lines.append(f"ROBOTLASER1 {about} {count} {values} 0 {pose} {pose} 0 0 0 0 0 {stamp}")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def true_trajectory(recording: Recording) -> Trajectory:
    """Where the base was at each scan."""
    stamp, x, y, yaw = recording.truth.T
    return Trajectory(stamp, np.column_stack((x, y, 0 * x)), Rotation.from_euler("z", yaw))


def judge_loops(path: Path, truth: Array) -> Loops:
    """Compare loops.csv with where the robot was.

    Args:
        path: the file.
        truth: time, x, y, yaw of each scan, shape (n, 4).
    """
    counts = {"loop": 0, "reuse": 0}
    false = 0
    for line in path.read_text(encoding="utf-8").splitlines()[1:]:
        older, newer, x, y, yaw, kind = line.split(",")
        counts[kind] += 1
        measured = np.array([float(x), float(y), float(yaw)])
        true = relative(truth[int(older), 1:], truth[int(newer), 1:])
        error = relative(true, measured)
        false += bool(np.hypot(*error[:2]) > FALSE_M or abs(error[2]) > FALSE_RAD)
    return Loops(counts["loop"], counts["reuse"], false)


def map_drive(recording: Recording, folder: Path) -> tuple[dict[str, Any], AbsoluteErrors]:
    """Run a drive through SLAM and judge its trajectories and loops.

    Args:
        recording: the drive.
        folder: is made; gets the log, the truth and what `./trident slam` writes, and the session.

    Returns:
        Numbers, and the errors of the final poses.

    Raises:
        EvalError: the program fails.
    """
    truth = _write_drive(recording, folder)
    words = ("--keep-session", str(folder / "map.session"))
    timing = run_log(Run(folder / "drive.log", METHOD, folder, words=words), show=False)
    final = absolute_errors(read_tum(folder / "trajectory.tum"), truth, "SE2")
    causal = absolute_errors(read_tum(folder / "causal.tum"), truth, "SE2")
    loops = judge_loops(folder / "loops.csv", recording.truth)
    numbers: dict[str, Any] = {
        "scans": len(recording.sweeps),
        "way_m": _length(truth),
        "cpu_s": timing["cpu_s"],
        "final": final.summary(),
        "causal": causal.summary(),
        "loops": loops.found,
        "reused": loops.reused,
        "false_loops": loops.false,
    }
    return numbers, final


def localize_drive(
    recording: Recording, session: Path, T_world_map: Array, seed: int, folder: Path
) -> dict[str, Any]:
    """Run a drive in the mode `localization` on a session and judge it in the map's frame.

    Args:
        recording: the drive.
        session: the file.
        T_world_map: where the map lies, a 4 x 4 matrix.
        seed: of how wrong the user is about where the robot begins.
        folder: is made; gets the log, the truth and the trajectories.

    Raises:
        EvalError: the program fails.
    """
    truth = _write_drive(recording, folder)
    (folder / "localization.yaml").write_text("mode: localization\n", encoding="utf-8")
    map_pose = np.array([*T_world_map[:2, 3], math.atan2(T_world_map[1, 0], T_world_map[0, 0])])
    start = relative(map_pose, recording.truth[0, 1:])
    wrong = np.random.default_rng((seed, 5)).standard_normal(3) * _START_SIGMA
    x, y, yaw = compose(start, wrong)
    words = ("--session", str(session), "--start", f"{x:.6f},{y:.6f},{yaw:.6f}")
    config = folder / "localization.yaml"
    run_log(Run(folder / "drive.log", METHOD, folder, config, words), show=False)
    estimate = read_tum(folder / "causal.tum")
    return absolute_errors(moved(estimate, T_world_map), truth, "none").summary()


def measure(building: Building, seed: int, folder: Path) -> dict[str, Any]:
    """Both drives of a seed.

    Raises:
        EvalError: a drive or a program fails.
    """
    tour = building.roads.tour(seed, _APART_M)
    numbers, final = map_drive(drive_along(building.world_file, tour, seed), folder)
    T = final.T_truth_map
    flat = np.eye(3)
    flat[:2, :2], flat[:2, 2] = T[:2, :2], T[:2, 3]
    numbers["map"] = agreement(read_grid(folder / "map.yaml"), building.truth, flat).summary()
    other = seed + _SECOND_SEED
    second = drive_along(building.world_file, building.roads.tour(other, _APART_M), other)
    session = folder / "map.session"
    numbers["localization"] = localize_drive(second, session, T, other, folder / "localization")
    return {"seed": seed} | numbers


def measure_all(
    name: str, seeds: Sequence[int], keep: Path | None, say: Callable[[str], None]
) -> list[dict[str, Any]]:
    """A row for every seed.

    Args:
        name: of the world.
        seeds: of the drives.
        keep: folder that keeps logs, trajectories and maps; None: nothing is kept.
        say: takes a line about each.

    Raises:
        EvalError: a drive or a program fails.
    """
    rows = []
    with tempfile.TemporaryDirectory(prefix="trident_bench_slam_") as temporary:
        folder = keep or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        place = building(name, folder)
        for seed in seeds:
            rows.append(measure(place, seed, folder / f"seed{seed}"))
            say(f"{name} {line(rows[-1])}")
    return rows


def reasons(rows: Sequence[dict[str, Any]]) -> list[str]:
    """What is not as it must be; empty: all is."""
    found = []
    for row in rows:
        for part in ("final", "localization"):
            error = row[part]["ate_rmse_m"]
            if not error < ATE_LIMIT_M:
                found.append(f"{_seed(row)}: {part}: RMSE {error:.3f} m, limit {ATE_LIMIT_M} m")
        if row["false_loops"]:
            found.append(f"{_seed(row)}: {row['false_loops']} false loops, must be 0")
    return found


def _seed(row: dict[str, Any]) -> str:
    return f"seed {row['seed']}"


def line(row: dict[str, Any]) -> str:
    """One row in words."""
    return (
        f"seed {row['seed']}: {row['way_m']:.0f} m, {row['loops']} loops, "
        f"{row['false_loops']} false, final {row['final']['ate_rmse_m']:.4f} m, "
        f"localization {row['localization']['ate_rmse_m']:.4f} m"
    )


_COLUMNS: tuple[tuple[str, Callable[[dict[str, Any]], float], str], ...] = (
    ("path [m]", lambda row: row["way_m"], ".0f"),
    ("loops", lambda row: row["loops"], ".0f"),
    ("reused", lambda row: row["reused"], ".0f"),
    ("false", lambda row: row["false_loops"], ".0f"),
    ("final RMSE [m]", lambda row: row["final"]["ate_rmse_m"], ".4f"),
    ("final max [m]", lambda row: row["final"]["ate_max_m"], ".3f"),
    ("causal RMSE [m]", lambda row: row["causal"]["ate_rmse_m"], ".4f"),
    ("localization RMSE [m]", lambda row: row["localization"]["ate_rmse_m"], ".4f"),
    ("localization max [m]", lambda row: row["localization"]["ate_max_m"], ".3f"),
    ("map precision", lambda row: row["map"]["map_precision"], ".3f"),
    ("map recall", lambda row: row["map"]["map_recall"], ".3f"),
    ("wall error [m]", lambda row: row["map"]["map_wall_error_mean_m"], ".4f"),
    ("wall thickness [m]", lambda row: row["map"]["wall_thickness_m"], ".3f"),
    ("CPU s", lambda row: row["cpu_s"], ".2f"),
)
_LIMITS = {"final RMSE [m]": "< 0.05", "localization RMSE [m]": "< 0.05", "false": "0"}


def table(rows: Sequence[dict[str, Any]]) -> str:
    """All rows, the worst of each column, and the limits, as Markdown."""
    head = ["seed", *(name for name, _, _ in _COLUMNS)]
    lines = [_cells(head), _cells(["---:"] * len(head))]
    for row in rows:
        lines.append(_cells([str(row["seed"]), *(f"{get(row):{f}}" for _, get, f in _COLUMNS)]))
    median = [f"{np.median([get(row) for row in rows]):{f}}" for _, get, f in _COLUMNS]
    lines.append(_cells(["median", *median]))
    lines.append(_cells(["limit", *(_LIMITS.get(name, "") for name, _, _ in _COLUMNS)]))
    return "\n".join(lines)


def _cells(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _write_drive(recording: Recording, folder: Path) -> Trajectory:
    """Write the log and the truth, which is returned, into a folder that is made."""
    folder.mkdir(parents=True, exist_ok=True)
    write_carmen(recording, folder / "drive.log")
    truth = true_trajectory(recording)
    write_tum(folder / "truth.tum", truth)
    return truth


def _length(trajectory: Trajectory) -> float:
    return float(np.linalg.norm(np.diff(trajectory.p, axis=0), axis=1).sum())


def as_json(rows: Sequence[dict[str, Any]], about: dict[str, Any]) -> str:
    """The rows and what they were measured on."""
    return json.dumps(about | {"rows": list(rows)}, indent=2, allow_nan=False) + "\n"
