# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A moving plan view of a crossing: robot, walkers, their tracks, the robot's commands."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from trident_benchmarks.nav.people import GOAL, HALL, START, WALKER_RADIUS_M

_ROBOT, _WALKER, _TRACK, _COMMAND, _GOAL = "#0072B2", "#444444", "#D55E00", "#56B4E9", "#009E73"
_FAN = 10  # commands of the latest periods
_FAN_S = 0.8  # how far their arcs lead
_AHEAD_S = 1.0  # how far the arrows of tracks lead
_TRAIL = 200  # frames
_STRIP = 6  # frames of a PNG
_FRAME_MS = 100
_ROBOT_M = (0.458, 0.378)  # of all that collides


def draw_crossing(file: Path, run: dict[str, Any]) -> None:
    """Write a GIF that moves, or, for any other suffix, a strip of frames.

    Args:
        file: where it goes.
        run: a crossing with frames.
    """
    frames = run["frames"]
    if file.suffix.lower() == ".gif":
        _write_gif(file, frames)
    else:
        _write_strip(file, frames)


def _write_gif(file: Path, frames: Sequence[dict[str, Any]]) -> None:
    import numpy as np
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from PIL import Image

    images = []
    for number in range(len(frames)):
        figure = Figure(figsize=(6.4, 4.4), dpi=80, layout="constrained")
        canvas = FigureCanvasAgg(figure)
        draw_frame(figure.subplots(), frames, number)
        canvas.draw()
        image = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
        images.append(image.quantize(colors=32))
    images[0].save(
        file, save_all=True, append_images=images[1:], duration=_FRAME_MS, loop=0, optimize=True
    )


def _write_strip(file: Path, frames: Sequence[dict[str, Any]]) -> None:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13.0, 6.0), layout="constrained")
    tiles = list(figure.subplots(2, _STRIP // 2, squeeze=False).flat)
    last = len(frames) - 1
    for i, axes in enumerate(tiles):
        draw_frame(axes, frames, round(i * last / (len(tiles) - 1)))
    figure.savefig(file, dpi=90, metadata={"Software": None})


def _draw_walkers(axes: Any, frame: dict[str, Any]) -> None:
    """Who walks, and the tracks with their velocities."""
    from matplotlib.patches import Circle

    for x, y in frame["walkers"]:
        axes.add_patch(Circle((x, y), WALKER_RADIUS_M, color=_WALKER, linewidth=0.0))
    for x, y, vx, vy, radius in frame["tracks"]:
        axes.add_patch(Circle((x, y), radius, fill=False, edgecolor=_TRACK))
        axes.plot([x, x + _AHEAD_S * vx], [y, y + _AHEAD_S * vy], color=_TRACK, linewidth=1.2)


def draw_frame(axes: Any, frames: Sequence[dict[str, Any]], number: int) -> None:
    """One moment: who walks gray, tracks red, the robot blue with its latest commands as arcs."""
    from matplotlib.patches import Rectangle
    from matplotlib.transforms import Affine2D

    frame = frames[number]
    _draw_walkers(axes, frame)
    trail = [f["robot"] for f in frames[max(0, number - _TRAIL) : number + 1]]
    axes.plot([p[0] for p in trail], [p[1] for p in trail], color=_ROBOT, linewidth=0.8)
    for past in frames[max(0, number - _FAN + 1) : number + 1]:
        axes.plot(*_arc(frame["robot"], past["command"]), color=_COMMAND, linewidth=0.7)
    x, y, yaw = frame["robot"]
    length, width = _ROBOT_M
    body = Rectangle((-length / 2, -width / 2), length, width, color=_ROBOT)
    body.set_transform(Affine2D().rotate(yaw).translate(x, y) + axes.transData)
    axes.add_patch(body)
    axes.plot([START[0] + GOAL[0]], [START[1] + GOAL[1]], "*", color=_GOAL, markersize=10)
    axes.set_xlim(-HALL[0] / 2, HALL[0] / 2)
    axes.set_ylim(-HALL[1] / 2, HALL[1] / 2)
    axes.set_aspect("equal")
    axes.set_title(f"{frame['time_s']:.1f} s", fontsize=8)
    axes.tick_params(labelsize=7)


def _arc(pose: Sequence[float], command: Sequence[float]) -> tuple[list[float], list[float]]:
    x, y, yaw = pose
    xs, ys = [x], [y]
    steps = 16
    for _ in range(steps):
        dt = _FAN_S / steps
        yaw += 0.5 * command[2] * dt
        x += (command[0] * math.cos(yaw) - command[1] * math.sin(yaw)) * dt
        y += (command[0] * math.sin(yaw) + command[1] * math.cos(yaw)) * dt
        yaw += 0.5 * command[2] * dt
        xs.append(x)
        ys.append(y)
    return xs, ys
