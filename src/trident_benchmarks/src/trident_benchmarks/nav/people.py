# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The suite people: a robot crosses a hall in which ten people walk, who do not see it."""

from __future__ import annotations

import argparse
import statistics
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from trident_benchmarks.nav.scene_runs import (
    job_count,
    robot_keys,
    run_documents,
    shares,
)
from trident_benchmarks.nav.trials import JACKAL, default_parameters
from trident_benchmarks.results import say

HALL = (12.0, 8.0)  # inner width and height [m]
START = (-5.2, 0.0, 0.0)  # x, y [m], yaw [rad]
GOAL = (10.4, 0.0, 0.0)  # from the start
WALKER_RADIUS_M = 0.25
_WALKERS = 10
_SEEDS, _QUICK_SEEDS = 40, 4
_TIME_LIMIT_S = 100.0
_FRAME_PERIOD_S = 0.1
ARRIVED_LIMIT = 0.95
SPEED_LIMIT_M_S = 0.05  # of the robot, towards whom it touches
_THICK = 0.2  # of the walls [m]

_BLIND = "moving_obstacles: {enabled: false}\n"


def hall_sdf() -> str:
    """A floor and four walls around the hall."""
    x, y = HALL[0] / 2 + _THICK / 2, HALL[1] / 2 + _THICK / 2
    walls = "".join(
        f'<collision name="wall_{i}"><pose>{px} {py} 0.5 0 0 0</pose><geometry><box>'
        f"<size>{sx} {sy} 1</size></box></geometry></collision>"
        for i, (px, py, sx, sy) in enumerate(
            (
                (0.0, y, 2 * x, _THICK),
                (0.0, -y, 2 * x, _THICK),
                (x, 0.0, _THICK, 2 * y),
                (-x, 0.0, _THICK, 2 * y),
            )
        )
    )
    return (
        '<sdf version="1.6"><world name="hall"><physics type="ode"><max_step_size>0.001'
        '</max_step_size></physics><model name="ground_plane"><static>1</static>'
        '<link name="link"><collision name="floor"><geometry><plane><normal>0 0 1</normal>'
        "<size>100 100</size></plane></geometry><surface><friction><ode><mu>100</mu>"
        "<mu2>50</mu2></ode></friction></surface></collision></link></model>"
        f'<model name="walls"><static>1</static><link name="link">{walls}</link></model>'
        "</world></sdf>"
    )


def crossings(
    folder: Path, seeds: Sequence[int], parameters: Sequence[Path], jobs: int | None, frames: bool
) -> list[dict[str, Any]]:
    """One crossing for each seed, in their order.

    Args:
        folder: for files of the runs.
        seeds: of walkers and noise.
        parameters: files of move_base's; later ones win.
        jobs: processes at a time.
        frames: whether all that moves is recorded.

    Raises:
        EvalError: a run could not be made.
    """
    world = folder / "hall.world"
    world.write_text(hall_sdf(), encoding="utf-8")
    keys = robot_keys(folder, JACKAL)
    trial = keys | {
        "world": str(world),
        "parameters": [str(file.resolve()) for file in parameters],
        "start": START,
        "goal": GOAL,
        "time_limit_s": _TIME_LIMIT_S,
    }
    walkers = {"count": _WALKERS, "radius": WALKER_RADIUS_M, "hall": HALL}
    documents = [
        {
            "trial": trial | {"seeds": share},
            "walkers": walkers,
            "frame_period_s": _FRAME_PERIOD_S if frames else 0.0,
        }
        for share in shares(seeds, job_count(jobs))
    ]
    done = run_documents("trident_benchmarks", "nav_people", documents, jobs)
    return sorted((run for runs in done for run in runs), key=lambda run: int(run["seed"]))


def row_of(system: str, runs: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """What the crossings of one configuration came to."""
    arrived = [run for run in runs if run["has_arrived"] and not run["wall"]]
    times_s = [run["time_s"] for run in arrived]
    share = len(arrived) / len(runs)
    touches = _touch_figures(runs)
    return {
        "suite": "people",
        "system": system,
        "crossings": len(runs),
        "arrived": share,
        "arrived_limit": ARRIVED_LIMIT,
        **touches,
        "mean_time_s": statistics.fmean(times_s) if times_s else None,
        "recoveries": _sum(runs, "recoveries"),
        "cpu_s_per_s": _sum(runs, "navigation_cpu_s") / _sum(runs, "time_s"),
        "unit": "arrived: 1; fastest_own: m/s towards whom it touches; mean_time: s",
        "passed": share >= ARRIVED_LIMIT and touches["fastest_own_m_s"] <= SPEED_LIMIT_M_S,
        "failures": _failures(runs, arrived),
    }


def _failures(runs: Sequence[dict[str, Any]], arrived: Sequence[dict[str, Any]]) -> list[Any]:
    return [_failure(run) for run in runs if run not in arrived]


def _sum(runs: Sequence[dict[str, Any]], key: str) -> Any:
    return sum(run[key] for run in runs)


def _own_speeds(touches: Sequence[dict[str, Any]], is_pushed: bool) -> list[float]:
    return [touch["own_speed_m_s"] for touch in touches if bool(touch["is_pushed"]) is is_pushed]


def _touch_figures(runs: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """How often walkers were touched, and how fast the robot drove then."""
    touches = [touch for run in runs for touch in run["touches"]]
    # What somebody pushes is not driving by itself.
    speeds, pushed = _own_speeds(touches, False), _own_speeds(touches, True)
    return {
        "touches": len(touches),
        "touches_while_pushed": len(pushed),
        "fastest_while_pushed_m_s": max(pushed, default=0.0),
        "fastest_own_m_s": max(speeds, default=0.0),
        "own_limit_m_s": SPEED_LIMIT_M_S,
        "touches_beyond_limit": sum(speed > SPEED_LIMIT_M_S for speed in speeds),
    }


def _failure(run: dict[str, Any]) -> str:
    return f"seed {run['seed']}: {run['wall'] or run['text'] or 'time is over'}"


def table(rows: Sequence[dict[str, Any]]) -> str:
    """Rows as Markdown."""
    lines = [
        f"| {_WALKERS} walkers | arrived (>= {ARRIVED_LIMIT}) | touches |"
        f" own speed at a touch (<= {SPEED_LIMIT_M_S} m/s) | time | crossings |",
        "|---|---|---|---|---|---|",
    ]
    for row in rows:
        time = "-" if row["mean_time_s"] is None else f"{row['mean_time_s']:.1f} s"
        lines.append(
            f"| {row['system']} | {row['arrived']:.3f} | {row['touches']} |"
            f" {row['fastest_own_m_s']:.3f} m/s at most, {row['touches_beyond_limit']} beyond |"
            f" {time} | {row['crossings']} |"
        )
    return "\n".join(lines)


def measure(options: argparse.Namespace) -> list[dict[str, Any]]:
    """Crosses the hall, with and without tracks of what moves, and prints the table.

    Returns:
        A row for each.

    Raises:
        EvalError: a run could not be made.
    """
    seeds = range(1, 1 + (options.seeds or (_QUICK_SEEDS if options.quick else _SEEDS)))
    parameters = [*default_parameters(JACKAL), *options.config]
    rows = []
    with tempfile.TemporaryDirectory(prefix="trident_people_") as temporary:
        folder = Path(temporary)
        blind = folder / "blind.yaml"
        blind.write_text(_BLIND, encoding="utf-8")
        for system, files in (("MPPI", parameters), ("MPPI without tracks", [*parameters, blind])):
            runs = crossings(folder, seeds, files, options.jobs, frames=False)
            rows.append(row_of(system, runs))
            for failure in rows[-1]["failures"]:
                say(f"{system}: {failure}")
        if options.picture is not None:
            from trident_benchmarks.nav.pictures.people import draw_crossing

            run = crossings(folder, seeds[:1], parameters, options.jobs, frames=True)[0]
            draw_crossing(options.picture, run)
    print(table(rows))
    return rows
