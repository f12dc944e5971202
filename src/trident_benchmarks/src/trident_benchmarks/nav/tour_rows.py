# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Tours of goals in a building: what they are, and how their drives are judged and reported."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from trident_benchmarks.nav.goals import Pose
from trident_benchmarks.nav.limits import RobotLimits
from trident_benchmarks.nav.trials import GoalOutcome, Outcome, Robot, Task
from trident_benchmarks.results import say


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

    def since(self, number: int) -> Tour:
        """The same from a goal on, for the robot that has reached the one before it.

        Args:
            number: of the goal, the first one is 1.
        """
        if number == 1:
            return self
        rest = slice(number - 1, None)
        return Tour(self.goals[number - 2], self.goals[rest], self.bounds_s[rest])


def is_reached(goal: GoalOutcome, limits: RobotLimits) -> bool:
    """By move_base, and by the truth within the tolerances."""
    return (
        goal.end == "reached"
        and goal.position_error_m <= limits.tolerance_m
        and goal.heading_error_rad <= limits.tolerance_rad
    )


def _goals(runs: Sequence[Outcome]) -> list[GoalOutcome]:
    return [goal for run in runs for goal in run.goals]


def _time_ratios(
    limits: RobotLimits, tours: Sequence[Tour], runs: Sequence[Outcome]
) -> list[float]:
    """Times of the goals that were reached, over their lower bounds."""
    goals = _goals(runs)
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
    limits, goals = driver.limits, _goals(runs)
    ratios = _time_ratios(limits, tours, runs)
    return {
        "suite": suite,
        "robot": driver.robot.name,
        **_counts(goals, limits),
        "time_over_bound": float(np.median(ratios)) if ratios else None,
        **_goal_errors(goals),
        "localization_error_m": max(run.localization_error_m for run in runs),
        "cpu_s_per_s": _cpu_s_per_s(runs),
        "failures": _failures(limits, runs),
        "recovery_causes": [text for run in runs for text in run.recoveries],
        "unit": "time_over_bound: 1 (median); cpu_s_per_s: CPU s per simulated s",
    }


def _counts(goals: Sequence[GoalOutcome], limits: RobotLimits) -> dict[str, Any]:
    return {
        "goals": len(goals),
        "reached": sum(is_reached(goal, limits) for goal in goals),
        "contacts": sum(bool(goal.touched) for goal in goals),
        "touched": sorted({goal.touched for goal in goals if goal.touched}),
        "recoveries": sum(goal.recoveries for goal in goals),
    }


def _goal_errors(goals: Sequence[GoalOutcome]) -> dict[str, Any]:
    """How far from its goals the robot stands, and how often move_base says that it is there."""
    return {
        "position_error_m": float(np.median([goal.position_error_m for goal in goals])),
        "heading_error_rad": float(np.median([goal.heading_error_rad for goal in goals])),
        "said_reached": sum(goal.end == "reached" for goal in goals),
    }


def _cpu_s_per_s(runs: Sequence[Outcome]) -> float | None:
    """CPU time per simulated second; None: nothing was driven."""
    driven_s = sum(goal.time_s for goal in _goals(runs))
    return sum(run.cpu_s for run in runs) / driven_s if driven_s else None


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


def report(limits: RobotLimits, task: Task, runs: list[Outcome]) -> None:
    """Print what came of a task.

    Args:
        limits: of the robot.
        task: which one.
        runs: of it.
    """
    for run in runs:
        reached = sum(is_reached(goal, limits) for goal in run.goals)
        touched = [goal.touched for goal in run.goals if goal.touched]
        say(
            f"{task.name}: {reached} of {len(run.goals)} reached, contacts {len(touched)},"
            f" recoveries {len(run.recoveries)}, localization off by up to"
            f" {run.localization_error_m:.3f} m"
        )
        _say_failures(limits, run)
        for text in run.recoveries:
            say(f"  recovery {text}")


def _say_failures(limits: RobotLimits, run: Outcome) -> None:
    for number, goal in enumerate(run.goals, 1):
        if not is_reached(goal, limits) or goal.touched:
            say(f"  goal {number}: {_words(goal)}")


def _words(goal: GoalOutcome) -> str:
    x, y, yaw = goal.goal
    return (
        f"({x:.2f}, {y:.2f}, {yaw:.2f}): {goal.end}: {goal.text} {goal.touched},"
        f" {goal.time_s:.1f} s, off by {goal.position_error_m:.3f} m,"
        f" {goal.heading_error_rad:.3f} rad"
    )
