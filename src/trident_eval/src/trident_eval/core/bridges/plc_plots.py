# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of a vessel that is driven through the registers of its PLC."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from trident_eval.core.bridges.plc import PROPELLERS, PlcLog
from trident_eval.core.plots import color, saved_figures
from trident_eval.core.tracks import Tracks


def draw_plc(tracks: Tracks, log: PlcLog, title: str, folder: Path) -> list[Path]:
    """Draw plc.png: commands at both ends, thrusts at both ends, and the path.

    Args:
        tracks: where everything was.
        log: what was said.
        title: of the run.
        folder: where the file goes; must exist.

    Returns:
        The file.
    """
    return saved_figures({"plc.png": lambda: _draw(tracks, log, title)}, folder)


def _draw(tracks: Tracks, log: PlcLog, title: str) -> Any:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11.5, 6.2), layout="constrained")
    figure.suptitle(f"{title}: {log.vessel} through its PLC")
    left, plan = figure.subfigures(1, 2, width_ratios=(1.9, 1.0))
    commands, thrusts = left.subplots(2, 1, sharex=True)
    for index, side in enumerate(PROPELLERS):
        said = log.of("pilot", f"{side}_command")
        legal = log.is_legal(said.value)
        shade = color(index)
        commands.plot(said.time[legal], said.value[legal], ".", ms=3, color=shade, alpha=0.5)
        commands.plot(said.time[~legal], said.value[~legal], "x", ms=4, color=shade)
        heard = log.of("vessel", f"{side}_command")
        commands.step(heard.time, heard.value, where="post", color=shade, label=side)
        measured, read = log.of("vessel", f"{side}_thrust"), log.of("client", f"{side}_thrust")
        thrusts.plot(measured.time, measured.value, color=shade, label=side)
        thrusts.plot(read.time, read.value, ".", ms=3, color="black")
    for limit in log.limits:
        commands.axhline(limit, color="#B00020", ls="--", lw=0.8)
    commands.set(ylabel="shaft speed [rad/s]")
    commands.set_title("dots: pilot (crosses: not legal); line: at the vessel; dashed: limits")
    commands.legend()
    thrusts.set(xlabel="simulated time [s]", ylabel="thrust [N]")
    thrusts.set_title("line: at the vessel; dots: read from registers")
    _draw_path(plan.subplots(), tracks, log.vessel)
    return figure


def _draw_path(axes: Any, tracks: Tracks, vessel: str) -> None:
    path = tracks.select([vessel]).position[:, 0]
    path = path[np.isfinite(path).all(axis=1)]
    axes.plot(*path[:, :2].T, color="#555555")
    if len(path):
        axes.plot(*path[0, :2], "s", ms=6, color="#555555")
    axes.set(xlabel="x east [m]", ylabel="y north [m]", aspect="equal", title="path")
