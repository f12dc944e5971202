# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The suite tight: places that are hardly wider than the robot, without a map.

Each scene has one kind of place; its seeds draw where the robot stands and where it shall go.
"""

from __future__ import annotations

import argparse
import math
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from trident_benchmarks.nav.box_robot import BOX, LENGTH_M, WIDTH_M, limits_file
from trident_benchmarks.nav.goals import Pose
from trident_benchmarks.nav.limits import RobotLimits
from trident_benchmarks.nav.tours import chosen_robots
from trident_benchmarks.nav.trials import (
    CAR,
    Outcome,
    Robot,
    Task,
    Trials,
    default_parameters,
    failures,
    recoveries,
)
from trident_benchmarks.results import say

Box = tuple[float, float, float, float, float]  # x, y [m], yaw [rad], length, width [m]

_SEEDS, _QUICK_SEEDS = 50, 3
_LIMIT_S = 120.0
_DRIFT_RAD = 0.05  # of odometry's heading at the end
_DOOR_SPARE_M = 0.06
_WALL_M = 0.15
_HALL = (8.0, 4.0)  # about the doors [m]
_DOORS_X = (2.5, 5.0)
_DEAD_END_M = 0.42  # wide; the circumscribed circle of the box has 0.52
_DEAD_END_DEEP_M = 1.2
_CORRIDOR_M = 1.0
_CAR_LENGTH_M, _CAR_WIDTH_M = 0.52, 0.33
_CAR_MIDDLE_M = 0.16  # of its body, ahead of its base
_SLOT = 1.4  # in lengths of the car
_BAY = 1.5  # in widths of the car


@dataclass(frozen=True)
class Scenery:
    """What a seed draws of a scene.

    Attributes:
        boxes: obstacles.
        start: x, y [m], yaw [rad] in the world.
        goal: the same.
    """

    boxes: tuple[Box, ...]
    start: Pose
    goal: Pose


@dataclass(frozen=True)
class Scene:
    """One kind of tight place.

    Attributes:
        name: of the row.
        robot: who drives.
        draw: makes the scenery of a seed.
        needed: share of the seeds that must be reached without contact.
        limits: YAML text over the robot's own limits.
    """

    name: str
    robot: Robot
    draw: Callable[[np.random.Generator], Scenery]
    needed: float = 1.0
    limits: str = ""


def wall(begin: tuple[float, float], end: tuple[float, float]) -> Box:
    """A wall between two points."""
    (x0, y0), (x1, y1) = begin, end
    length = math.dist(begin, end)
    return ((x0 + x1) / 2, (y0 + y1) / 2, math.atan2(y1 - y0, x1 - x0), length, _WALL_M)


def room(x0: float, y0: float, x1: float, y1: float) -> tuple[Box, ...]:
    """Four walls."""
    corners = ((x0, y0), (x1, y0), (x1, y1), (x0, y1))
    return tuple(wall(a, b) for a, b in zip(corners, (*corners[1:], corners[0]), strict=True))


def doors(random: np.random.Generator) -> Scenery:
    """Two doors in a row, each wider than the box by a few centimeters."""
    length, height = _HALL
    gap = WIDTH_M + _DOOR_SPARE_M
    boxes = list(room(0.0, 0.0, length, height))
    for x in _DOORS_X:
        y = float(random.uniform(1.0, height - 1.0))
        boxes += [wall((x, 0.0), (x, y - gap / 2)), wall((x, y + gap / 2), (x, height))]
    y0, y1 = (float(y) for y in random.uniform(1.0, height - 1.0, 2))
    yaw0, yaw1 = (float(a) for a in random.uniform(-math.pi, math.pi, 2))
    return Scenery(tuple(boxes), (1.0, y0, yaw0), (length - 1.0, y1, yaw1))


def dead_end(random: np.random.Generator) -> Scenery:
    """The box stands in a dead end that it cannot turn in."""
    half = 0.5 * _DEAD_END_M + 0.5 * _WALL_M
    depth = _DEAD_END_DEEP_M
    boxes = (
        *room(-3.0, -2.0, depth + 0.2, 2.0),
        wall((0.0, half), (depth, half)),
        wall((0.0, -half), (depth, -half)),
        wall((depth, -half), (depth, half)),
    )
    spare = 0.5 * (_DEAD_END_M - WIDTH_M) - 0.02
    y, yaw = float(random.uniform(-spare, spare)), float(random.uniform(-0.03, 0.03))
    x = depth - 0.5 * _WALL_M - 0.5 * LENGTH_M - float(random.uniform(0.05, 0.3))
    goal = (
        float(random.uniform(-2.2, -1.0)),
        float(random.uniform(-1.2, 1.2)),
        float(random.uniform(-math.pi, math.pi)),
    )
    return Scenery(boxes, (x, y, yaw), goal)


def corridor(random: np.random.Generator) -> Scenery:
    """The goal is behind the box, in a corridor that leaves it little room to turn."""
    half = 0.5 * (_CORRIDOR_M + _WALL_M)
    boxes = room(-4.0, -half, 4.0, half)
    y0, y1 = (float(y) for y in random.uniform(-0.12, 0.12, 2))
    yaw0, yaw1 = (float(a) for a in random.uniform(-0.3, 0.3, 2))
    start = (1.5 + float(random.uniform(-0.5, 0.5)), y0, yaw0)
    return Scenery(boxes, start, (-1.5, y1, math.pi + yaw1))


def _parked(x: float, y: float, yaw: float) -> Box:
    return (x, y, yaw, _CAR_LENGTH_M, _CAR_WIDTH_M)


def parallel(random: np.random.Generator) -> Scenery:
    """Between two parked cars at a curb, in the direction of the lane."""
    slot = _SLOT * _CAR_LENGTH_M
    offset = 0.5 * (slot + _CAR_LENGTH_M)
    boxes = (
        *room(-3.5, -0.4, 3.5, 2.6),
        _parked(-offset, 0.0, 0.0),
        _parked(offset, 0.0, 0.0),
    )
    start = (
        float(random.uniform(-2.6, -1.6)),
        float(random.uniform(0.7, 1.2)),
        float(random.uniform(-0.2, 0.2)),
    )
    return Scenery(boxes, start, (-_CAR_MIDDLE_M, 0.0, 0.0))


def backwards(random: np.random.Generator) -> Scenery:
    """Tail first into a bay between two parked cars."""
    offset = 0.5 * (_BAY + 1.0) * _CAR_WIDTH_M
    boxes = (
        *room(-3.5, -0.5, 3.5, 2.6),
        _parked(-offset, 0.0, 0.5 * math.pi),
        _parked(offset, 0.0, 0.5 * math.pi),
    )
    start = (
        float(random.uniform(-2.6, -1.6)),
        float(random.uniform(0.9, 1.4)),
        float(random.uniform(-0.2, 0.2)),
    )
    return Scenery(boxes, start, (0.0, -_CAR_MIDDLE_M, 0.5 * math.pi))


SCENES = (
    Scene("doors", BOX, doors),
    Scene("dead end", BOX, dead_end),
    Scene("corridor", BOX, corridor, limits="MPPIController: {min_vel_x: 0.0}\n"),
    Scene("parallel parking", CAR, parallel, needed=0.98),
    Scene("backwards parking", CAR, backwards, needed=0.98),
)


def sdf(scenery: Scenery) -> str:
    """A world with a floor, and all boxes as shapes of one static link."""
    shapes = "".join(
        f'<collision name="box_{i}"><pose>{x} {y} 0.25 0 0 {yaw}</pose><geometry><box>'
        f"<size>{length} {width} 0.5</size></box></geometry></collision>"
        for i, (x, y, yaw, length, width) in enumerate(scenery.boxes)
    )
    return (
        '<sdf version="1.6"><world name="tight"><physics type="ode"><max_step_size>0.001'
        '</max_step_size></physics><model name="ground_plane"><static>1</static><link name="link">'
        '<collision name="floor"><geometry><plane><normal>0 0 1</normal><size>100 100</size>'
        "</plane></geometry><surface><friction><ode><mu>100</mu><mu2>50</mu2></ode></friction>"
        '</surface></collision></link></model><model name="obstacles"><static>1</static>'
        f'<link name="link">{shapes}</link></model></world></sdf>'
    )


def task_of(scene: Scene, seed: int) -> tuple[Task, Scenery]:
    """A seed's task."""
    scenery = scene.draw(np.random.default_rng((seed, 13)))
    task = Task(
        name=f"{scene.name.replace(' ', '_')}_{seed}",
        world=sdf(scenery),
        start=scenery.start,
        goal=(0.0, 0.0, 0.0),
        time_limit_s=_LIMIT_S,
        success_radius_m=0.0,
        moved_m=0.0,
        goals=(scenery.goal,),
        extra={"seeds": [seed]},
    )
    return task, scenery


def judged(run: Outcome, limits: RobotLimits) -> Outcome:
    """A run that ended farther from its goal than tolerance and drift allow is missed."""
    goal = run.goals[-1]
    off_m, off_rad = goal.position_error_m, goal.heading_error_rad
    is_near = off_m <= limits.tolerance_m + run.odometry_error_m
    if not run.is_success or (is_near and off_rad <= limits.tolerance_rad + _DRIFT_RAD):
        return run
    return replace(run, end="missed", text=f"off by {off_m:.3f} m, {off_rad:.3f} rad")


def row_of(scene: Scene, runs: Sequence[Outcome]) -> dict[str, Any]:
    """What came of all seeds of a scene."""
    times_s = [run.time_s for run in runs if run.is_success]
    return {
        "suite": "tight",
        "scene": scene.name,
        "robot": scene.robot.name,
        "reached": len(times_s),
        "runs": len(runs),
        "needed": math.ceil(scene.needed * len(runs) - 1e-9),
        "contacts": sum(run.end == "collided" for run in runs),
        "recoveries": recoveries(runs),
        "mean_time_s": float(np.mean(times_s)) if times_s else None,
        "least_speed_m_s": min(run.least_speed_m_s for run in runs),
        "failures": failures(runs),
        "unit": "mean_time_s: s, of successes",
    }


def table(rows: Sequence[dict[str, Any]]) -> str:
    """Rows as Markdown."""
    lines = [
        "| tight | robot | reached | contacts | recoveries | time of successes |",
        "|---|---|---|---|---|---|",
    ]
    for row in rows:
        time = "-" if row["mean_time_s"] is None else f"{row['mean_time_s']:.1f} s"
        lines.append(
            f"| {row['scene']} | {row['robot']} | {row['reached']} of {row['runs']} |"
            f" {row['contacts']} | {row['recoveries']} | {time} |"
        )
    return "\n".join(lines)


def drive_scene(
    scene: Scene, seeds: Sequence[int], options: argparse.Namespace, folder: Path
) -> tuple[list[Outcome], list[Scenery]]:
    """All seeds of a scene.

    Raises:
        EvalError: a run could not be made.
    """
    drawn = [task_of(scene, seed) for seed in seeds]
    own, over = _parameters(scene, folder)
    limits, parameters = RobotLimits(own[-1]), [*own, *over]
    trials = Trials(scene.robot, [*parameters, *options.config], options.jobs)
    outcomes = trials.run([task for task, _ in drawn], [1], _report)
    runs = [judged(run, limits) for one in outcomes for run in one]
    return runs, [scenery for _, scenery in drawn]


def _parameters(scene: Scene, folder: Path) -> tuple[list[Path], list[Path]]:
    """Files of the robot, the last one with its limits; and those that the scene has instead."""
    own, over = default_parameters(scene.robot), list[Path]()
    if scene.robot is BOX:
        own[-1] = limits_file(folder)
    if scene.limits:
        over = [folder / "limits.yaml"]
        over[0].write_text(scene.limits, encoding="utf-8")
    return own, over


def _report(task: Task, runs: list[Outcome]) -> None:
    for run in runs:
        off_m = run.goals[-1].position_error_m
        say(f"{task.name}: {run.end} {run.time_s:.1f} s, off by {off_m:.3f} m {run.text}")
        for text in run.recoveries:
            say(f"  recovery {text}")


def _chosen_scenes(options: argparse.Namespace) -> list[Scene]:
    asked = chosen_robots(options.robot, [(scene.robot, scene) for scene in SCENES])
    return [scene for _, scene in asked if not options.scene or scene.name in options.scene]


def measure(options: argparse.Namespace) -> list[dict[str, Any]]:
    """Drives through all scenes and prints the table.

    Returns:
        A row per scene.

    Raises:
        EvalError: a run could not be made.
    """
    seeds = range(1, 1 + (options.seeds or (_QUICK_SEEDS if options.quick else _SEEDS)))
    rows, drawn = [], []
    asked = _chosen_scenes(options)
    with tempfile.TemporaryDirectory(prefix="trident_bench_tight_") as name:
        for scene in asked:
            runs, sceneries = drive_scene(scene, seeds, options, Path(name))
            rows.append(row_of(scene, runs))
            drawn.append((scene, sceneries, runs))
    if options.picture is not None:
        from trident_benchmarks.nav.pictures.tight import draw_scenes

        draw_scenes(options.picture, drawn)
    print(table(rows))
    return rows
