# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Goals all over a building, in a map made by SLAM, localized by amcl, and how they are judged.

The map is made in the run, of a drive by every room. Each seed has a start and goals of its own;
the robot drives from one to the next, all of it without ROS.
"""

from __future__ import annotations

import argparse
import math
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from trident_eval.core.errors import EvalError

from trident_benchmarks.nav import trials
from trident_benchmarks.nav.goals import Places, lower_bound_s
from trident_benchmarks.nav.limits import RobotLimits
from trident_benchmarks.nav.tour_rows import Driver, Tour, report, row_of, table
from trident_benchmarks.nav.trials import KnownMap, Outcome, Robot, Task, Trials
from trident_benchmarks.results import say

if TYPE_CHECKING:
    from trident_sim.occupancy import OccupancyMap

_SEEDS, _QUICK_SEEDS = 10, 1
_MAP_SEED = 1
_MIN_DISTANCE_M = 1.0
_SPARE_M = 0.1  # beyond the circumscribed circle that a goal has
_SLOWEST, _LEAST_LIMIT_S = 10.0, 60.0  # times the lower bound of the longest path of all
_LONGEST_M = 70.0
_MY_LIDAR_NOISE = (0.01, 0.01)  # [m], part of the range: as the benchmark of SLAM has them


@dataclass(frozen=True)
class Course:
    """What the drives of a suite have in common.

    Attributes:
        suite: its name.
        home: x, y [m] from which all of the building can be reached.
        apart_m: waypoints of the drive that maps it.
        goals: of a seed.
        quick_goals: the same, with --quick.
    """

    suite: str
    home: tuple[float, float]
    apart_m: float
    goals: int
    quick_goals: int


@dataclass(frozen=True)
class Building:
    """A building as its map says and as it is.

    Attributes:
        world: SDF file.
        known: what robots know of it.
    """

    world: Path
    known: KnownMap


def map_building(world: str, course: Course, folder: Path) -> Building:
    """Drive by every room and make a map of it by SLAM.

    Args:
        world: name or file.
        course: where in it, and how far apart the waypoints of the drive are.
        folder: gets log, trajectories and map.

    Raises:
        EvalError: the drive or a program failed.
    """
    from trident_benchmarks.slam.simulated import building, drive_along, map_drive

    place = building(world, folder, course.home)
    tour = place.roads.tour(_MAP_SEED, course.apart_m)
    mapped = folder / "map"
    numbers, final = map_drive(drive_along(place.world_file, tour, _MAP_SEED), mapped)
    say(f"map: {numbers['way_m']:.0f} m, RMSE of the poses {final.summary()['ate_rmse_m']:.3f} m")
    T = final.T_truth_map
    pose = (float(T[0, 3]), float(T[1, 3]), math.atan2(T[1, 0], T[0, 0]))
    return Building(place.world_file, KnownMap(mapped / "map.yaml", pose))


def true_map(
    world: Path, heights: Sequence[float], home: tuple[float, float] = (0.0, 0.0)
) -> OccupancyMap:
    """What a robot of some heights may touch, about a free point."""
    from trident_sim.occupancy import MapConfig, occupancy_map

    from trident_sim import SimulationWarning, World

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SimulationWarning)
        return occupancy_map(World(world), MapConfig(heights=tuple(heights), start=home))


def make_tour(
    places: Places, limits: RobotLimits, home: tuple[float, float], seed: int, count: int
) -> Tour:
    """Random goals, each reachable from the one before.

    Args:
        places: where there is room.
        limits: of the robot.
        home: a point from which the start can be reached.
        seed: of the choice.
        count: of the goals.

    Raises:
        EvalError: there are no such places.
    """
    random = np.random.default_rng((seed, 11))
    start, _ = places.goal(random, (*home, 0.0), _MIN_DISTANCE_M)
    here, goals, bounds = start, [], []
    for _ in range(count):
        goal, route = places.goal(random, here, _MIN_DISTANCE_M)
        bounds.append(lower_bound_s(route, here, goal, limits))
        goals.append(goal)
        here = goal
    return Tour(start, tuple(goals), tuple(bounds))


def task_of(robot: Robot, building: Building, tour: Tour, seed: int, limits: RobotLimits) -> Task:
    """A tour as the program drives it."""
    limit_s = max(_LEAST_LIMIT_S, _SLOWEST * _LONGEST_M / limits.speed)
    extra = {
        "map": building.known.record(),
        "ends_at_contact": False,
        "seeds": [seed],
    }
    if robot is trials.MY_NAV_ROBOT:
        extra["range_noise"] = _MY_LIDAR_NOISE
    return Task(
        name=f"{robot.name}_{seed}",
        world=building.world.read_text(encoding="utf-8"),
        start=tour.start,
        goal=(0.0, 0.0, 0.0),
        time_limit_s=limit_s,
        success_radius_m=0.0,
        moved_m=0.0,
        goals=tour.goals,
        extra=extra,
    )


def chosen_robots(
    names: Sequence[str], robots: Sequence[tuple[Robot, Any]]
) -> list[tuple[Robot, Any]]:
    """Those of the names, or all.

    Raises:
        EvalError: a name is not known.
    """
    known = {robot.name for robot, _ in robots}
    for name in names:
        if name not in known:
            raise EvalError(f"--robot {name}: not known, legal: {', '.join(sorted(known))}")
    return [(robot, more) for robot, more in robots if not names or robot.name in names]


def _seeds(options: argparse.Namespace) -> range:
    many = options.seeds or (_QUICK_SEEDS if options.quick else _SEEDS)
    return range(options.first_seed, options.first_seed + many)


def _goal_count(course: Course, options: argparse.Namespace) -> int:
    return options.goals or (course.quick_goals if options.quick else course.goals)


def drive_robot(
    course: Course, driver: Driver, building: Building, options: argparse.Namespace
) -> tuple[dict[str, Any], list[Outcome], OccupancyMap]:
    """All tours of a robot.

    Returns:
        The row, the runs and the true map.

    Raises:
        EvalError: a run could not be made.
    """
    seeds = _seeds(options)
    limits = driver.limits
    grid = true_map(building.world, driver.heights, course.home)
    places = Places(grid, limits.inscribed_m, limits.circumscribed_m + _SPARE_M)
    first = options.first_goal
    all_goals = first - 1 + _goal_count(course, options)
    tours = [make_tour(places, limits, course.home, seed, all_goals).since(first) for seed in seeds]
    tasks = [
        task_of(driver.robot, building, tour, seed, limits)
        for tour, seed in zip(tours, seeds, strict=True)
    ]
    parameters = [*driver.parameters, *options.config]
    outcomes = Trials(driver.robot, parameters, options.jobs).run(
        tasks, [1], partial(report, limits)
    )
    runs = [run for one in outcomes for run in one]
    return row_of(course.suite, driver, tours, runs), runs, grid


def drive_all(
    course: Course, drivers: Sequence[Driver], building: Building, options: argparse.Namespace
) -> list[dict[str, Any]]:
    """Drives all robots, draws the tours of the first one and prints the table.

    Returns:
        A row per robot.

    Raises:
        EvalError: a run could not be made.
    """
    rows = []
    for driver in drivers:
        row, runs, grid = drive_robot(course, driver, building, options)
        rows.append(row)
        if options.picture is not None and len(rows) == 1:
            from trident_benchmarks.nav.pictures.drives import draw_tours

            draw_tours(options.picture, grid, runs)
    print(table(rows))
    return rows
