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
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from trident_eval.core.errors import EvalError

from trident_benchmarks.nav import trials
from trident_benchmarks.nav.goals import Places, Pose, lower_bound_s
from trident_benchmarks.nav.limits import RobotLimits
from trident_benchmarks.nav.trials import GoalOutcome, KnownMap, Outcome, Robot, Task, Trials
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
class Driver:
    """A robot and how it is driven.

    Attributes:
        robot: which one.
        heights: at which its body may touch something [m].
        limits: what it is judged by.
        parameters: files; later ones win.
    """

    robot: Robot
    heights: tuple[float, ...]
    limits: RobotLimits
    parameters: tuple[Path, ...]


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


@dataclass(frozen=True)
class Tour:
    """A start, goals and the shortest paths between them.

    Attributes:
        start: x, y [m], yaw [rad] in the world.
        goals: the same, one after the other.
        bounds_s: lower bounds of the time to each.
    """

    start: Pose
    goals: tuple[Pose, ...]
    bounds_s: tuple[float, ...]


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


def is_reached(goal: GoalOutcome, limits: RobotLimits) -> bool:
    """By move_base, and by the truth within the tolerances."""
    return (
        goal.end == "reached"
        and goal.position_error_m <= limits.tolerance_m
        and goal.heading_error_rad <= limits.tolerance_rad
    )


def _time_ratios(
    limits: RobotLimits, tours: Sequence[Tour], runs: Sequence[Outcome]
) -> list[float]:
    """Times of the goals that were reached, over their lower bounds."""
    goals = [goal for run in runs for goal in run.goals]
    bounds = [bound for tour in tours for bound in tour.bounds_s]
    return [
        goal.time_s / bound
        for goal, bound in zip(goals, bounds, strict=True)
        if is_reached(goal, limits) and bound > 0.0
    ]


def _failures(limits: RobotLimits, runs: Sequence[Outcome]) -> list[str]:
    return [
        f"seed {run.seed}, goal {number}: {goal.end}: {goal.text}, off by"
        f" {goal.position_error_m:.3f} m, {goal.heading_error_rad:.3f} rad"
        for run in runs
        for number, goal in enumerate(run.goals, 1)
        if not is_reached(goal, limits)
    ]


def row_of(
    suite: str, driver: Driver, tours: Sequence[Tour], runs: Sequence[Outcome]
) -> dict[str, Any]:
    """What came of all goals of a robot."""
    limits = driver.limits
    goals = [goal for run in runs for goal in run.goals]
    ratios = _time_ratios(limits, tours, runs)
    driven_s = sum(goal.time_s for goal in goals)
    return {
        "suite": suite,
        "robot": driver.robot.name,
        "goals": len(goals),
        "reached": sum(is_reached(goal, limits) for goal in goals),
        "contacts": sum(bool(goal.touched) for goal in goals),
        "touched": sorted({goal.touched for goal in goals if goal.touched}),
        "recoveries": sum(goal.recoveries for goal in goals),
        "time_over_bound": float(np.median(ratios)) if ratios else None,
        "position_error_m": float(np.median([goal.position_error_m for goal in goals])),
        "heading_error_rad": float(np.median([goal.heading_error_rad for goal in goals])),
        "said_reached": sum(goal.end == "reached" for goal in goals),
        "localization_error_m": max(run.localization_error_m for run in runs),
        "cpu_s_per_s": sum(run.cpu_s for run in runs) / driven_s if driven_s else None,
        "failures": _failures(limits, runs),
        "recovery_causes": [text for run in runs for text in run.recoveries],
        "unit": "time_over_bound: 1 (median); cpu_s_per_s: CPU s per simulated s",
    }


def table(rows: Sequence[dict[str, Any]]) -> str:
    """Rows as Markdown; reached: also by the truth, within the tolerances."""
    names = (rows[0]["suite"], "reached", "by move_base", "contacts", "recoveries")
    lines = [
        f"| {' | '.join(names)} | time over lower bound | CPU per s |",
        "|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        ratio = "-" if row["time_over_bound"] is None else f"{row['time_over_bound']:.2f}"
        lines.append(
            f"| {row['robot']} | {row['reached']} of {row['goals']} | {row['said_reached']} |"
            f" {row['contacts']} |"
            f" {row['recoveries']} | {ratio} | {row['cpu_s_per_s']:.3f} s |"
        )
    return "\n".join(lines)


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


def drive_robot(
    course: Course, driver: Driver, building: Building, options: argparse.Namespace
) -> tuple[dict[str, Any], list[Outcome], OccupancyMap]:
    """All tours of a robot.

    Returns:
        The row, the runs and the true map.

    Raises:
        EvalError: a run could not be made.
    """
    seeds = range(1, 1 + (options.seeds or (_QUICK_SEEDS if options.quick else _SEEDS)))
    count = options.goals or (course.quick_goals if options.quick else course.goals)
    limits = driver.limits
    grid = true_map(building.world, driver.heights, course.home)
    places = Places(grid, limits.inscribed_m, limits.circumscribed_m + _SPARE_M)
    tours = [make_tour(places, limits, course.home, seed, count) for seed in seeds]
    tasks = [
        task_of(driver.robot, building, tour, seed, limits)
        for tour, seed in zip(tours, seeds, strict=True)
    ]
    parameters = [*driver.parameters, *options.config]
    outcomes = Trials(driver.robot, parameters, options.jobs).run(tasks, [1], _report)
    runs = [run for one in outcomes for run in one]
    return row_of(course.suite, driver, tours, runs), runs, grid


def _report(task: Task, runs: list[Outcome]) -> None:
    for run in runs:
        reached = sum(goal.end == "reached" for goal in run.goals)
        touched = [goal.touched for goal in run.goals if goal.touched]
        say(
            f"{task.name}: {reached} of {len(run.goals)} reached, contacts {len(touched)},"
            f" recoveries {len(run.recoveries)}, localization off by up to"
            f" {run.localization_error_m:.3f} m"
        )
        for goal in run.goals:
            if goal.end != "reached" or goal.touched:
                x, y, yaw = goal.goal
                say(
                    f"  ({x:.2f}, {y:.2f}, {yaw:.2f}): {goal.end}: {goal.text} {goal.touched},"
                    f" {goal.time_s:.1f} s"
                )
        for text in run.recoveries:
            say(f"  recovery {text}")


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
