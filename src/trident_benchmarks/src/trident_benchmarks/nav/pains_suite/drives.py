# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""P1, P2 and P11: a simulated robot whose lidar falls silent, near goals, among people."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from trident_benchmarks.nav import people
from trident_benchmarks.nav.pains_suite.rows import pain
from trident_benchmarks.nav.scene_runs import robot_keys, run_documents
from trident_benchmarks.nav.trials import JACKAL, default_parameters

_SPEED, _BRAKING = 2.0, 5.0  # of jackal's file [m/s], [m/s^2]
_AGE_LIMIT_S = 0.3  # of a lidar of 40 Hz
_PERIOD_S, _DELAY_S = 0.05, 0.02  # of the controller; until a command acts
_STANDS_M = 0.01  # no more than this while the lidar is silent
_GOALS, _QUICK_GOALS = 200, 20
_PROCESSES = 4  # that share the goals
# A window that holds the hall: what is planned in is no part of these scenes.
_WINDOW = "global_costmap: {width: 24.0, height: 24.0, resolution: 0.05}\n"


def _documents(
    folder: Path, config: Sequence[Path], goals: int, seeds: Sequence[Sequence[int]]
) -> list[dict[str, Any]]:
    world = folder / "hall.world"
    world.write_text(people.hall_sdf(), encoding="utf-8")
    window = folder / "window.yaml"
    window.write_text(_WINDOW, encoding="utf-8")
    parameters = [*default_parameters(JACKAL), window, *config]
    trial = robot_keys(folder, JACKAL) | {
        "world": str(world),
        "parameters": [str(file.resolve()) for file in parameters],
        "time_limit_s": 60.0,
    }
    start, goal = people.START, people.GOAL
    near = [0.0, 0.0, 0.0]
    return [
        {
            "trial": trial
            | {
                "seeds": list(share),
                "start": near if goals > 1 else start,
                "goal": near if goals > 1 else goal,
            },
            "goals": goals,
        }
        for share in seeds
    ]


def silence(config: Sequence[Path], jobs: int | None) -> list[dict[str, Any]]:
    """P1: at full speed the lidar falls silent.

    Raises:
        EvalError: it could not be driven.
    """
    with tempfile.TemporaryDirectory(prefix="trident_pains_") as temporary:
        documents = _documents(Path(temporary), config, 1, [[1]])
        done = run_documents("trident_benchmarks", "nav_drive_pains", documents, jobs, "silence")
    run = done[0][0]
    rival = "navigation2#6547, #2180"
    # The limit begins at the last scan; then a period and the delay pass, then it brakes.
    limit_s = _AGE_LIMIT_S + _PERIOD_S + _DELAY_S
    speed = run["speed_m_s"]
    limit_m = speed * limit_s + speed**2 / (2.0 * _BRAKING)
    named = "front/scan" in run["waiting"] or "scan" in run["waiting"]
    return [
        pain(
            "P1",
            rival,
            f"lidar silent at {speed:.2f} m/s: distance until the robot stands",
            run["traveled_m"],
            limit_m,
            "m",
            note=run["waiting"],
        ),
        pain(
            "P1",
            rival,
            "the same: distance moved later, still in silence",
            run["moved_later_m"],
            _STANDS_M,
            "m",
        ),
        pain(
            "P1",
            rival,
            "the same: source named, and goal reached once scans come again",
            float(named and run["has_continued"]),
            1.0,
            "1",
            is_least=True,
        ),
    ]


def _driven_goals(config: Sequence[Path], jobs: int | None, goals: int) -> list[dict[str, Any]]:
    """So many goals of each process."""
    seeds = [[seed] for seed in range(1, 1 + _PROCESSES)]
    with tempfile.TemporaryDirectory(prefix="trident_pains_") as temporary:
        documents = _documents(Path(temporary), config, goals, seeds)
        done = run_documents("trident_benchmarks", "nav_drive_pains", documents, jobs, "near_goals")
    return [goal for runs in done for run in runs for goal in run["goals"]]


def _text(goal: dict[str, Any]) -> str:
    return goal["text"] or f"{goal}"


def near_goals(config: Sequence[Path], jobs: int | None, quick: bool) -> list[dict[str, Any]]:
    """P2: goals 0.05 to 1 m away in any direction, with any heading.

    Raises:
        EvalError: they could not be driven.
    """
    every = _driven_goals(config, jobs, (_QUICK_GOALS if quick else _GOALS) // _PROCESSES)
    missed = [goal for goal in every if not goal["is_reached"]]
    what = f"{len(every)} goals 0.05 to 1 m away, any heading"
    rival = "navigation#215, #147, kobuki-x#33"
    return [
        pain(
            "P2",
            rival,
            f"{what}: not reached",
            float(len(missed)),
            0.0,
            "goals",
            note="; ".join(map(_text, missed[:3])),
        ),
        pain(
            "P2",
            "navigation2#2439, #1683",
            "the same: recoveries",
            float(sum(goal["recoveries"] for goal in every)),
            0.0,
            "recoveries",
        ),
        pain(
            "P2",
            "navigation2#6160",
            "the same: farthest beyond the tolerance after being within",
            max(goal["overshoot_m"] for goal in every),
            0.0,
            "m",
        ),
    ]


def walkers(config: Sequence[Path], jobs: int | None, quick: bool) -> list[dict[str, Any]]:
    """P11: the hall of the suite people.

    Raises:
        EvalError: it could not be crossed.
    """
    seeds = range(1, 3 if quick else 11)
    with tempfile.TemporaryDirectory(prefix="trident_pains_") as temporary:
        parameters = [*default_parameters(JACKAL), *config]
        runs = people.crossings(Path(temporary), seeds, parameters, jobs, frames=False)
    row = people.row_of("MPPI", runs)
    what = f"{len(runs)} crossings of a hall with ten walkers"
    rival = "navigation2#1597, #3695"
    return [
        pain(
            "P11",
            rival,
            f"{what}: part that arrives",
            row["arrived"],
            people.ARRIVED_LIMIT,
            "1",
            is_least=True,
            note="; ".join(row["failures"]),
        ),
        pain(
            "P11",
            rival,
            "the same: the robot's speed towards whom it touches",
            row["fastest_own_m_s"],
            people.SPEED_LIMIT_M_S,
            "m/s",
        ),
    ]
