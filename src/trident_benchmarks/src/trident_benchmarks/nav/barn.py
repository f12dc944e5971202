# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The suite barn: fields of cylinders without a map, by the rules of the BARN challenge."""

from __future__ import annotations

import argparse
import itertools
import os
import statistics
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from trident_benchmarks.nav.fields import (
    GOAL_AHEAD_M,
    GOAL_RADIUS_M,
    MOVED_M,
    START,
    TIME_LIMIT_S,
    Field,
    metric,
    read_fields,
)
from trident_benchmarks.nav.launch_files import launch_parameters, node_parameters
from trident_benchmarks.nav.limits import RobotLimits
from trident_benchmarks.nav.trials import (
    JACKAL,
    Outcome,
    Task,
    Trials,
    default_parameters,
    failures,
    recoveries,
)
from trident_benchmarks.results import say

DATA = "TRIDENT_DATA"
_SEEDS, _QUICK_SEEDS = 10, 1
_QUICK_WORLDS = 6

#: Published: 50 worlds, ten runs each; shares, and the mean time of successes [s].
RIVALS = (
    {
        "system": "move_base, TrajectoryPlannerROS 0.5 m/s",
        "metric": 0.159,
        "success": 0.850,
        "collision": 0.056,
        "mean_time_s": 34.1,
        "runs": 500,
    },
    {
        "system": "LiCS-KI, winner of 2024",
        "metric": 0.489,
        "success": 0.980,
        "collision": 0.018,
        "mean_time_s": 7.7,
        "runs": 500,
    },
)


def find_fields(options: argparse.Namespace) -> list[Field]:
    """The worlds that are asked for, or of the data; none where there are no data.

    Raises:
        EvalError: the folder has none, or one cannot be read.
    """
    if options.worlds is not None:
        fields = read_fields(options.worlds)
    else:
        data = os.environ.get(DATA)
        folder = Path(data or "") / "barn"
        if not data or not folder.is_dir():
            say(f"SKIPPED: {DATA} names no folder with barn in it, and there is no --worlds")
            return []
        fields = read_fields(folder)
    # Every so many-th: the higher the number, the harder the world.
    return fields[:: -(-len(fields) // _QUICK_WORLDS)] if options.quick else fields


def task_of(field: Field) -> Task:
    """The challenge's task in a world."""
    return Task(
        name=f"world_{field.number}",
        world=field.sdf(),
        start=START,
        goal=(GOAL_AHEAD_M, 0.0, 0.0),
        time_limit_s=TIME_LIMIT_S,
        success_radius_m=GOAL_RADIUS_M,
        moved_m=MOVED_M,
    )


def world_row(field: Field, runs: Sequence[Outcome]) -> dict[str, Any]:
    """The means over the runs in one world."""
    return {
        "world": field.number,
        "metric": statistics.fmean(metric(field, o.is_success, o.time_s) for o in runs),
        "success": statistics.fmean(o.is_success for o in runs),
        "collision": statistics.fmean(o.end == "collided" for o in runs),
        "times_s": [round(o.time_s, 3) for o in runs],
        "failures": failures(runs),
    }


def row_of(fields: Sequence[Field], outcomes: Sequence[Sequence[Outcome]]) -> dict[str, Any]:
    """The means over worlds of the means over their runs; the time is that of all successes."""
    worlds = [world_row(field, runs) for field, runs in zip(fields, outcomes, strict=True)]
    every = list(itertools.chain.from_iterable(outcomes))
    row: dict[str, Any] = {"suite": "barn", "system": "this one"}
    for key in ("metric", "success", "collision"):
        row[key] = statistics.fmean(world[key] for world in worlds)
    return row | {
        "mean_time_s": _mean([o.time_s for o in every if o.is_success]),
        "runs": len(every),
        "recoveries": recoveries(every),
        "cpu_s_per_s": _cpu_s_per_s(every),
        "unit": "metric, success, collision: 1; mean_time_s: s",
        "worlds": worlds,
    }


def _cpu_s_per_s(runs: Sequence[Outcome]) -> float | None:
    """CPU time per simulated second; None: nothing was driven."""
    driven_s = sum(o.time_s for o in runs)
    return sum(o.cpu_s for o in runs) / driven_s if driven_s else None


def _mean(values: Sequence[float]) -> float | None:
    return statistics.fmean(values) if values else None


def table(rows: Sequence[dict[str, Any]]) -> str:
    """Rows as Markdown."""
    lines = [
        "| BARN | metric (at most 0.5) | success | collided | time of successes | runs |",
        "|---|---|---|---|---|---|",
    ]
    for row in rows:
        time = "-" if row["mean_time_s"] is None else f"{row['mean_time_s']:.1f} s"
        lines.append(
            f"| {row['system']} | {row['metric']:.3f} | {row['success']:.3f} |"
            f" {row['collision']:.3f} | {time} | {row['runs']} |"
        )
    return "\n".join(lines)


def measure(options: argparse.Namespace) -> list[dict[str, Any]]:
    """Drives through all worlds and prints the table.

    Returns:
        This system's row; none where there are no data.

    Raises:
        EvalError: a run could not be made.
    """
    fields = find_fields(options)
    if not fields:
        return []
    with tempfile.TemporaryDirectory(prefix="trident_bench_barn_") as name:
        outcomes = _drive(fields, options, Path(name))
    row = row_of(fields, outcomes) | {"system": _system(options)}
    print(table([row, *RIVALS]))
    if options.picture is not None:
        from trident_benchmarks.nav.pictures.fields import draw_fields

        draw_fields(options.picture, fields, outcomes)
    return [row]


def _drive(
    fields: Sequence[Field], options: argparse.Namespace, folder: Path
) -> Sequence[Sequence[Outcome]]:
    """All runs in all worlds."""
    seeds = range(1, 1 + (options.seeds or (_QUICK_SEEDS if options.quick else _SEEDS)))
    parameters = [*_parameters(options, folder), *options.config]
    if options.ros:
        return _run_over_ros(fields, parameters, seeds)
    trials = Trials(JACKAL, parameters, options.jobs)
    return trials.run([task_of(field) for field in fields], seeds, _report)


def _run_over_ros(
    fields: Sequence[Field], parameters: Sequence[Path], seeds: Sequence[int]
) -> list[list[Outcome]]:
    from trident_benchmarks.nav.barn_ros import run_field

    limits = RobotLimits(default_parameters(JACKAL)[-1])
    outcomes = []
    for field in fields:
        outcomes.append([run_field(field, parameters, limits, seed) for seed in seeds])
        _report(task_of(field), outcomes[-1])
    return outcomes


def _parameters(options: argparse.Namespace, folder: Path) -> list[Path]:
    """The default ones, or those of a launch file."""
    if options.launch is None:
        return default_parameters(JACKAL)
    tree = launch_parameters(options.launch)
    return [node_parameters(tree, "move_base", folder / "move_base.yaml")]


def _system(options: argparse.Namespace) -> str:
    """What the row is of: the default configuration, or what was given."""
    given = [Path(word).name for word in options.launch or () if word.endswith(".launch")]
    given += [file.stem for file in options.config] + (["over ROS"] if options.ros else [])
    return ", ".join(given) or "this one"


def _report(task: Task, runs: list[Outcome]) -> None:
    reached = [o.time_s for o in runs if o.is_success]
    mean = f", {statistics.fmean(reached):.1f} s" if reached else ""
    say(f"{task.name}: {len(reached)} of {len(runs)} reached{mean}")
    for o in runs:
        if not o.is_success:
            say(f"  seed {o.seed}: {o.end}: {o.text}")
