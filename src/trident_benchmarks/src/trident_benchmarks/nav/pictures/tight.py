# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A picture of tight places with the tracks of runs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from trident_benchmarks.nav.trials import Outcome

if TYPE_CHECKING:
    from trident_benchmarks.nav.tight import Scene, Scenery

_SHOWN = 3  # runs of a scene
_SIDE_IN = 3.4  # of a tile [inches]
_REACHED, _FAILED, _OBSTACLE, _GOAL = "#0072B2", "#D55E00", "#444444", "#009E73"

Drawn = tuple["Scene", Sequence["Scenery"], Sequence[Outcome]]


def draw_scenes(file: Path, scenes: Sequence[Drawn]) -> None:
    """Write a PNG: a row for each scene with its first runs; failures come first.

    Args:
        file: where it goes.
        scenes: each with the scenery and the run of each seed.
    """
    from matplotlib.figure import Figure

    size = (_SHOWN * _SIDE_IN, len(scenes) * 0.75 * _SIDE_IN)
    figure = Figure(figsize=size, layout="constrained")
    tiles = figure.subplots(len(scenes), _SHOWN, squeeze=False)
    for axes in tiles.flat:
        axes.set_axis_off()
    for row, (scene, sceneries, runs) in zip(tiles, scenes, strict=True):
        shown = sorted(
            zip(sceneries, runs, strict=True), key=lambda one: (one[1].is_success, one[1].seed)
        )
        for axes, (scenery, run) in zip(row, shown, strict=False):
            _draw_run(axes, scene.name, scenery, run)
    figure.savefig(file, dpi=110, metadata={"Software": None})


def _draw_run(axes: Any, name: str, scenery: Scenery, run: Outcome) -> None:
    from matplotlib.patches import Rectangle

    for x, y, yaw, length, width in scenery.boxes:
        corner = (x - length / 2, y - width / 2)
        patch = Rectangle(
            corner, length, width, angle=math.degrees(yaw), rotation_point="center", color=_OBSTACLE
        )
        axes.add_patch(patch)
    color = _REACHED if run.is_success else _FAILED
    axes.plot([x for x, _, _ in run.track], [y for _, y, _ in run.track], color, linewidth=0.9)
    axes.plot(*scenery.goal[:2], "o", color=_GOAL, markersize=4)
    axes.set_title(f"{name}, seed {run.seed}: {run.end}, {run.time_s:.1f} s", fontsize=7)
    axes.set_aspect("equal")
    axes.autoscale_view()
