# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A picture of a drive: the map, the track of the robot, its goals."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from trident_benchmarks.nav.goals import Pose, Tried

if TYPE_CHECKING:
    from trident_sim.occupancy import OccupancyMap

    from trident_benchmarks.nav.trials import Outcome

_INCHES = 12.0  # of the longer side
_ARROW = 0.02  # length of a goal's heading, in the longer sides of the map
_REACHED, _MISSED, _TRACK = "#009E73", "#D55E00", "#0072B2"


def draw_drive(
    file: Path, grid: OccupancyMap, track: Sequence[Pose], tried: Sequence[Tried]
) -> None:
    """Write a PNG.

    Args:
        file: where it goes.
        grid: the true map.
        track: of the robot, in time.
        tried: the goals, numbered from 1 in their order, with the time as a multiple of its bound.
    """
    figure, axes, longer_m = _map_axes(grid)
    if track:
        points = np.array(track)
        axes.plot(points[:, 0], points[:, 1], color=_TRACK, linewidth=1.2)
    for number, one in enumerate(tried, start=1):
        _draw_goal(axes, number, one, _ARROW * longer_m)
    reached = sum(one.is_reached for one in tried)
    axes.set(xlabel="x [m]", ylabel="y [m]", title=f"{reached} of {len(tried)} goals reached")
    figure.savefig(file, dpi=110, metadata={"Software": None})


def draw_tours(file: Path, grid: OccupancyMap, runs: Sequence[Outcome]) -> None:
    """Write a PNG: the tracks of all runs, each in its own color, and all goals.

    Args:
        file: where it goes.
        grid: the true map.
        runs: one per seed.
    """
    from matplotlib import colormaps

    figure, axes, longer_m = _map_axes(grid)
    colors = colormaps["viridis"](np.linspace(0.0, 0.9, len(runs)))
    for run, color in zip(runs, colors, strict=True):
        points = np.array(run.track)
        axes.plot(points[:, 0], points[:, 1], color=color, linewidth=0.7)
        _draw_goals(axes, run, _ARROW * longer_m)
    goals = [goal for run in runs for goal in run.goals]
    reached = sum(goal.end == "reached" for goal in goals)
    axes.set(xlabel="x [m]", ylabel="y [m]", title=f"{reached} of {len(goals)} goals reached")
    figure.savefig(file, dpi=110, metadata={"Software": None})


def _draw_goals(axes: Any, run: Outcome, length_m: float) -> None:
    for goal in run.goals:
        mark = _REACHED if goal.end == "reached" and not goal.touched else _MISSED
        _draw_heading(axes, goal.goal, length_m, mark)
        axes.plot([goal.goal[0]], [goal.goal[1]], "o", color=mark, markersize=3)


def _map_axes(grid: OccupancyMap) -> tuple[Any, Any, float]:
    """A figure, its axes with the map, and the map's longer side [m]."""
    from matplotlib.figure import Figure

    rows, columns = grid.cells.shape
    width_m, height_m = columns * grid.resolution, rows * grid.resolution
    longer_m = max(width_m, height_m)
    size = (_INCHES * width_m / longer_m + 1.0, _INCHES * height_m / longer_m + 1.0)
    figure = Figure(figsize=size, layout="constrained")
    axes = figure.add_subplot()
    x, y = grid.origin
    axes.imshow(
        _grays(grid),
        cmap="gray",
        vmin=0.0,
        vmax=1.0,
        origin="lower",
        interpolation="nearest",
        extent=(x, x + width_m, y, y + height_m),
    )
    return figure, axes, longer_m


def _grays(grid: OccupancyMap) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    from trident_sim.occupancy import FREE, OCCUPIED

    return np.select([grid.cells == FREE, grid.cells == OCCUPIED], [1.0, 0.2], 0.85)


def _draw_heading(axes: Any, pose: Pose, length_m: float, color: str) -> None:
    x, y, yaw = pose
    tip = (x + length_m * math.cos(yaw), y + length_m * math.sin(yaw))
    axes.annotate("", tip, (x, y), arrowprops={"arrowstyle": "->", "color": color})


def _draw_goal(axes: Any, number: int, one: Tried, length_m: float) -> None:
    x, y, _ = one.goal
    color = _REACHED if one.is_reached else _MISSED
    ratio = f"{one.time_s / one.bound_s:.2f}" if one.bound_s > 0.0 else "-"
    axes.plot([x], [y], "o", color=color, markersize=6)
    _draw_heading(axes, one.goal, length_m, color)
    axes.annotate(f"{number}: {ratio}", (x, y), (4, 4), textcoords="offset points", fontsize=9)
