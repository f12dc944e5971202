# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The suite turtlebot3: a Burger and a Waffle among nine pillars, by turtlebot3_navigation's files.

move_base and amcl get the parameters that `turtlebot3_navigation.launch` gives them, whichever
package of that name the shell finds first.
"""

from __future__ import annotations

import argparse
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any

from trident_eval.ros_paths import package_folder

from trident_benchmarks.nav import trials
from trident_benchmarks.nav.launch_files import launch_parameters, node_parameters
from trident_benchmarks.nav.limits import RobotLimits
from trident_benchmarks.nav.tour_rows import Driver
from trident_benchmarks.nav.tours import Course, chosen_robots, drive_all, map_building
from trident_benchmarks.nav.trials import Robot

COURSE = Course("turtlebot3", home=(-2.0, -0.5), apart_m=1.0, goals=10, quick_goals=5)
#: Robots, and the heights at which their bodies may touch something [m].
ROBOTS: tuple[tuple[Robot, tuple[float, ...]], ...] = (
    (trials.BURGER, (0.03, 0.115, 0.18)),
    (trials.WAFFLE, (0.03, 0.12)),
)
#: Parameters of amcl that have no meaning without ROS, but for frames and the first pose.
_NODE_KEYS = (
    "first_map_only",
    "gui_publish_rate",
    "save_pose_rate",
    "tf_broadcast",
    "transform_tolerance",
    "use_map_topic",
)
_LAUNCH = ("turtlebot3_navigation", "turtlebot3_navigation.launch")


def _is_filters(key: str) -> bool:
    """Whether amcl's filter has the parameter, not the node about it."""
    return not (key.endswith("_frame_id") or key.startswith("initial_") or key in _NODE_KEYS)


def driver(robot: Robot, heights: tuple[float, ...], folder: Path) -> tuple[Driver, Path]:
    """A robot as the launch file drives it.

    Args:
        robot: which one.
        heights: at which its body may touch something [m].
        folder: gets a file for each node.

    Returns:
        The driver and the file with amcl's parameters.

    Raises:
        EvalError: the launch file cannot be read, or lacks a node.
    """
    model = robot.name.removeprefix("turtlebot3_")
    words = [*_LAUNCH, f"model:={model}", "map_file:=map.yaml", "open_rviz:=false"]
    tree = launch_parameters(words, {"TURTLEBOT3_MODEL": model})
    tree["amcl"] = {key: value for key, value in tree.get("amcl", {}).items() if _is_filters(key)}
    move_base, amcl = (
        node_parameters(tree, node, folder / f"{robot.name}_{node}.yaml")
        for node in ("move_base", "amcl")
    )
    return Driver(robot, heights, RobotLimits(move_base), (move_base,)), amcl


def measure(options: argparse.Namespace) -> list[dict[str, Any]]:
    """Maps the arena, drives both robots and prints the table.

    Returns:
        A row per robot.

    Raises:
        EvalError: a run could not be made.
    """
    chosen = chosen_robots(options.robot, ROBOTS)
    world = package_folder("turtlebot3_gazebo") / "worlds" / "turtlebot3_world.world"
    with tempfile.TemporaryDirectory(prefix="trident_bench_turtlebot3_") as name:
        folder = Path(name)
        drivers = [driver(robot, heights, folder) for robot, heights in chosen]
        building = map_building(str(world), COURSE, folder)
        rows = []
        for one, amcl in drivers:
            known = replace(building.known, amcl=amcl)
            rows += drive_all(COURSE, [one], replace(building, known=known), options)
    return rows
