# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The nodes of a robot in a world with its navigation, each to be started on its own."""

from __future__ import annotations

import json
import sys
import warnings
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import package_folder

from trident_benchmarks.processes import Processes

ROBOT = "my_nav_robot"
_LIDAR_Z_M = 0.15
_LAUNCH = ("roslaunch", "--disable-title")
_CLIENT = (sys.executable, "-m", "trident_benchmarks.nav.pains_suite.goal_client")


def save_true_map(folder: Path, world: str) -> Path:
    """The occupancy map of a world of worlds/; returns its YAML file."""
    from trident_sim.occupancy import MapConfig, occupancy_map

    from trident_sim import SimulationWarning, World

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SimulationWarning)
        file = package_folder("trident_bringup") / "worlds" / f"{world}.world"
        occupancy_map(World(file), MapConfig(heights=(_LIDAR_Z_M,))).save(folder / f"{world}.pgm")
    return folder / f"{world}.yaml"


def move_base_launch(folder: Path) -> Path:
    """A launch file of move_base alone, with the parameters of navigation.launch."""
    nav = package_folder("trident_bringup") / "config" / "nav"
    files = (nav / "move_base.yaml", nav / "costmaps.yaml", nav / "robots" / f"{ROBOT}.yaml")
    loads = "".join(f'<rosparam command="load" file="{file}"/>' for file in files)
    file = folder / "move_base.launch"
    file.write_text(
        f'<launch><node name="move_base" pkg="move_base" type="move_base" output="screen">{loads}'
        "</node></launch>",
        encoding="utf-8",
    )
    return file


def commands(
    folder: Path,
    map_file: Path,
    world: str,
    start: tuple[float, float, float],
    goals: tuple[str, ...],
    speed: float,
) -> dict[str, list[str]]:
    """What starts each part; `client` sends the goals.

    Args:
        folder: for files of the run.
        map_file: of the map.
        world: of worlds/.
        start: x, y [m], yaw [rad].
        goals: arguments of the client.
        speed: the real-time factor.
    """
    x, y, yaw = start
    bringup = [*_LAUNCH, "trident_bringup"]
    return {
        "world": [
            *_LAUNCH,
            str(package_folder("trident_bringup") / "launch/sim/world.launch"),
            f"world:={world}",
            f"real_time_factor:={speed}",
        ],
        "robot": [
            *_LAUNCH,
            str(package_folder("trident_bringup") / "launch/robot/ground_robot.launch"),
            f"robot:={ROBOT}",
            *(f"x:={x}", f"y:={y}", f"yaw:={yaw}"),
        ],
        "localization": [
            *bringup,
            "localization.launch",
            f"map_file:={map_file}",
            *(f"initial_pose_x:={x}", f"initial_pose_y:={y}", f"initial_pose_a:={yaw}"),
        ],
        "move_base": [*_LAUNCH, str(move_base_launch(folder))],
        "client": [*_CLIENT, *goals],
    }


def client_rows(processes: Processes) -> list[dict[str, Any]]:
    """What the client has printed so far.

    Raises:
        EvalError: it was something else.
    """
    text = processes.log("client").read_text(encoding="utf-8")
    try:
        return [json.loads(line) for line in text.splitlines() if line.startswith("{")]
    except ValueError as error:
        raise EvalError(f"goal_client: a line is not JSON: {error}") from error
