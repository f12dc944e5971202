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
    from matplotlib.figure import Figure

    rows, columns = grid.cells.shape
    width_m, height_m = columns * grid.resolution, rows * grid.resolution
    longer_m = max(width_m, height_m)
    size = (_INCHES * width_m / longer_m + 1.0, _INCHES * height_m / longer_m + 1.0)
    axes = (figure := Figure(figsize=size, layout="constrained")).add_subplot()
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
    if track:
        points = np.array(track)
        axes.plot(points[:, 0], points[:, 1], color=_TRACK, linewidth=1.2)
    for number, one in enumerate(tried, start=1):
        _draw_goal(axes, number, one, _ARROW * longer_m)
    reached = sum(one.is_reached for one in tried)
    axes.set(xlabel="x [m]", ylabel="y [m]", title=f"{reached} of {len(tried)} goals reached")
    figure.savefig(file, dpi=110, metadata={"Software": None})


def _grays(grid: OccupancyMap) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    from trident_sim.occupancy import FREE, OCCUPIED

    return np.select([grid.cells == FREE, grid.cells == OCCUPIED], [1.0, 0.2], 0.85)


def _draw_goal(axes: Any, number: int, one: Tried, length_m: float) -> None:
    x, y, yaw = one.goal
    color = _REACHED if one.is_reached else _MISSED
    tip = (x + length_m * math.cos(yaw), y + length_m * math.sin(yaw))
    ratio = f"{one.time_s / one.bound_s:.2f}" if one.bound_s > 0.0 else "-"
    axes.plot([x], [y], "o", color=color, markersize=6)
    axes.annotate("", tip, (x, y), arrowprops={"arrowstyle": "->", "color": color})
    axes.annotate(f"{number}: {ratio}", (x, y), (4, 4), textcoords="offset points", fontsize=9)
