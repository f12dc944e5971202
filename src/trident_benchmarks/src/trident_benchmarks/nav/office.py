# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The suite office: all ground robots in a building, by the one default configuration."""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path
from typing import Any

from trident_eval.ros_paths import package_folder

from trident_benchmarks.nav import trials
from trident_benchmarks.nav.limits import RobotLimits
from trident_benchmarks.nav.tour_rows import Driver
from trident_benchmarks.nav.tours import Course, chosen_robots, drive_all, map_building
from trident_benchmarks.nav.trials import Robot

WORLD = "office"
COURSE = Course("office", home=(0.0, -4.5), apart_m=5.0, goals=20, quick_goals=5)

#: Robots, and the heights at which their bodies may touch something [m].
ROBOTS: tuple[tuple[Robot, tuple[float, ...]], ...] = (
    (trials.MY_NAV_ROBOT, (0.03, 0.115)),
    (trials.BURGER, (0.03, 0.115, 0.18)),
    (trials.WAFFLE, (0.03, 0.12)),
    (trials.JACKAL, (0.03, 0.15, 0.25, 0.3)),
    (trials.UGV, (0.03, 0.15, 0.23)),
    (trials.CAR, (0.03, 0.09, 0.16)),
)


def driver(robot: Robot, heights: tuple[float, ...]) -> Driver:
    """A robot with the default configuration.

    Raises:
        EvalError: its file has no limits.
    """
    folder = package_folder("trident_bringup") / "config" / "nav" / "robots"
    limits = RobotLimits(folder / f"{robot.name}.yaml")
    return Driver(robot, heights, limits, tuple(trials.default_parameters(robot, has_map=True)))


def measure(options: argparse.Namespace) -> list[dict[str, Any]]:
    """Maps the building, drives all robots and prints the table.

    Returns:
        A row per robot.

    Raises:
        EvalError: a run could not be made.
    """
    drivers = [driver(*chosen) for chosen in chosen_robots(options.robot, ROBOTS)]
    with tempfile.TemporaryDirectory(prefix="trident_bench_office_") as name:
        building = map_building(WORLD, COURSE, Path(name))
        return drive_all(COURSE, drivers, building, options)
