# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A picture of fields of cylinders with the tracks of all runs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from trident_benchmarks.nav.fields import GOAL_AHEAD_M, GOAL_RADIUS_M, START, Field
from trident_benchmarks.nav.trials import Outcome

_COLUMNS = 10
_TILE_IN = (1.3, 2.9)  # width and height of a world's picture [inches]
_REACHED, _FAILED, _OBSTACLE, _GOAL = "#0072B2", "#D55E00", "#444444", "#009E73"


def draw_fields(file: Path, fields: Sequence[Field], outcomes: Sequence[Sequence[Outcome]]) -> None:
    """Write a PNG: a tile for each world, successes blue, failures red with a cross at their end.

    Args:
        file: where it goes.
        fields: the worlds.
        outcomes: the runs of each.
    """
    from matplotlib.figure import Figure

    columns = min(_COLUMNS, len(fields))
    rows = -(-len(fields) // columns)
    size = (columns * _TILE_IN[0], rows * _TILE_IN[1])
    figure = Figure(figsize=size, layout="constrained")
    tiles = list(figure.subplots(rows, columns, squeeze=False).flat)
    for axes in tiles:
        axes.set_axis_off()
    for axes, field, runs in zip(tiles, fields, outcomes, strict=False):
        _draw_field(axes, field, runs)
    figure.savefig(file, dpi=110, metadata={"Software": None})


def _draw_run(axes: Any, run: Outcome) -> None:
    color = _REACHED if run.is_success else _FAILED
    axes.plot([x for x, _, _ in run.track], [y for _, y, _ in run.track], color, linewidth=0.6)
    if not run.is_success:
        axes.plot(*run.track[-1][:2], "x", color=_FAILED, markersize=5)


def _draw_field(axes: Any, field: Field, runs: Sequence[Outcome]) -> None:
    from matplotlib.collections import PatchCollection
    from matplotlib.patches import Circle

    discs = [Circle((x, y), radius) for x, y, radius in field.cylinders]
    axes.add_collection(PatchCollection(discs, color=_OBSTACLE, linewidth=0.0))
    goal = (
        START[0] + GOAL_AHEAD_M * math.cos(START[2]),
        START[1] + GOAL_AHEAD_M * math.sin(START[2]),
    )
    axes.add_patch(Circle(goal, GOAL_RADIUS_M, color=_GOAL, alpha=0.3, linewidth=0.0))
    for run in runs:
        _draw_run(axes, run)
    reached = sum(run.is_success for run in runs)
    axes.set_title(f"{field.number}: {reached}/{len(runs)}", fontsize=7)
    axes.set_aspect("equal")
    axes.autoscale_view()
