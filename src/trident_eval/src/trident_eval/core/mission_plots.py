# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of missions: where platforms were to go and went, and how far off their paths."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from trident_eval.core.missions import Mission, follow
from trident_eval.core.plots import color, saved_figures
from trident_eval.core.tracks import Tracks

_DASHES = {"uav": (0, (1, 2)), "ugv": (0, (5, 2)), "usv": (0, (5, 2, 1, 2))}


def draw_missions(tracks: Tracks, missions: list[Mission], title: str, folder: Path) -> list[Path]:
    """Draw missions.png: a plan view, and each platform's tracking error.

    Args:
        tracks: where everything was.
        missions: what was to be done.
        title: of the run.
        folder: where the file goes; must exist.

    Returns:
        The file.
    """
    return saved_figures({"missions.png": lambda: _draw(tracks, missions, title)}, folder)


def _draw(tracks: Tracks, missions: list[Mission], title: str) -> Any:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11.5, 5.8), layout="constrained")
    figure.suptitle(f"{title}: missions")
    plan, error = figure.subplots(1, 2, width_ratios=(1.0, 1.3))
    for index, mission in enumerate(missions):
        _draw_plan(plan, tracks, mission, color(index))
        outcome = follow(tracks, mission)
        error.plot(outcome.time, outcome.error, color=color(index), label=mission.name)
        if math.isfinite(mission.limit_m):
            line = {"linewidth": 0.7, "linestyle": (0, (2, 3))}
            error.axhline(mission.limit_m, color=color(index), **line)
    plan.set(xlabel="x east [m]", ylabel="y north [m]", aspect="equal", title="plan view")
    plan.margins(0.06)
    error.set(xlabel="simulated time [s]", ylabel="distance to the path [m]", ylim=(0.0, None))
    limited = any(math.isfinite(mission.limit_m) for mission in missions)
    error.set_title("until the last place" + "; dotted: limit of the RMS" * limited)
    figure.legend(*error.get_legend_handles_labels(), loc="lower center", ncols=9)
    figure.get_layout_engine().set(rect=(0.0, 0.06, 1.0, 0.94))
    return figure


def _draw_plan(plan: Any, tracks: Tracks, mission: Mission, shade: str) -> None:
    x, y, _ = tracks.select([mission.name]).position[:, 0].T
    plan.plot(x, y, color=shade)
    path = mission.path
    plan.plot(path[:, 0], path[:, 1], color="black", linewidth=0.8, linestyle=_DASHES[mission.kind])
    plan.plot(*mission.places.T[:2], linestyle="", marker="o", markersize=4, color=shade)
    plan.plot(*path[0, :2], linestyle="", marker="s", markersize=6, color=shade)
