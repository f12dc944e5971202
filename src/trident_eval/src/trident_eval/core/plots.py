# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of a run: paths, formation error, separation, tracking error."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from trident_eval.core.scene import Scene
from trident_eval.core.tracks import Array

# Okabe and Ito's colors, which color-blind readers distinguish too.
_COLORS = ("#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#8C6D00", "#555555")
_LIMIT = "#B00020"
_OUTSIDE = "#F0F0F0"
_SNAPSHOTS, _SNAPSHOTS_OF_MANY = 7, 3
# More are not distinguished by eight colors, nor read as a ring of neighbours.
MANY = 12
#: What moves less up and down than this stays level [m].
LEVEL_M = 0.01
_STYLE: dict[str, Any] = {
    "figure.dpi": 110,
    "savefig.dpi": 150,
    "font.size": 10,
    "axes.titlesize": 11,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "grid.color": "#DDDDDD",
    "grid.linewidth": 0.7,
    "legend.frameon": False,
    "lines.linewidth": 1.4,
}


def draw_all(scene: Scene, folder: Path) -> list[Path]:
    """Draw every picture that the scene has data for.

    Args:
        scene: what to show.
        folder: where the PNG files go; must exist.

    Returns:
        The files that were written.
    """
    drawings = {
        "paths.png": draw_paths,
        "height.png": _draw_height,
        "formation_error.png": draw_formation_error,
        "separation.png": _draw_separation,
        "tracking_error.png": _draw_tracking_error,
    }
    return saved_figures({name: partial(draw, scene) for name, draw in drawings.items()}, folder)


def saved_figures(drawings: Mapping[str, Callable[[], Any]], folder: Path) -> list[Path]:
    """Draw figures in the style of all of them.

    Args:
        drawings: by file name, what makes a figure, or None where there is nothing to show.
        folder: where the PNG files go; must exist.

    Returns:
        The files that were written.
    """
    import matplotlib

    matplotlib.use("Agg")
    written = []
    with matplotlib.rc_context(_STYLE):
        for name, draw in drawings.items():
            figure = draw()
            if figure is not None:
                # No creation date in the file: the same run gives the same bytes.
                figure.savefig(folder / name, metadata={"Software": None})
                written.append(folder / name)
    return written


def _new_figure(width: float, height: float) -> Any:
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def draw_paths(scene: Scene) -> Any:
    """A view in space and one from above; of robots on level ground the latter alone."""
    figure = _new_figure(11.5, 5.4)
    figure.suptitle(f"{scene.title}: paths")
    if height_range(scene.tracks.position) < LEVEL_M:
        spaces, plan = [], figure.add_subplot()
    else:
        grid = figure.add_gridspec(1, 2, width_ratios=(1.0, 1.15))
        spaces = [figure.add_subplot(grid[0], projection="3d")]
        plan = figure.add_subplot(grid[1])
    _draw_tracks(scene, spaces, plan)
    _mark_formations(scene, spaces, plan)
    for space in spaces:
        _label_space(space, scene)
    plan.set(xlabel="x [m]", ylabel="y [m]", title="plan view", aspect="equal")
    plan.margins(0.06)
    figure.legend(*plan.get_legend_handles_labels(), loc="lower center", ncols=8, fontsize=9)
    figure.get_layout_engine().set(rect=(0.0, 0.07, 1.0, 0.93), wspace=0.1)
    return figure


def height_range(position: Array) -> float:
    """How far apart the highest and the lowest of positions (..., 3) are [m]; 0.0 without any."""
    z = position[..., 2]
    z = z[np.isfinite(z)]
    return float(z.max() - z.min()) if len(z) else 0.0


def _draw_tracks(scene: Scene, spaces: list[Any], plan: Any) -> None:
    for index, name in enumerate(scene.tracks.names):
        x, y, z = scene.tracks.position[:, index].T
        for space in spaces:
            space.plot(x, y, z, color=color(index))
        plan.plot(x, y, color=color(index), label=label(scene, name))
        if scene.commanded is not None:
            cx, cy, _ = scene.commanded[:, index].T
            plan.plot(cx, cy, color="black", linewidth=0.6, linestyle=(0, (4, 3)), zorder=3)
    if scene.commanded is not None:
        plan.plot([], [], color="black", linewidth=0.6, linestyle=(0, (4, 3)), label="command")


def _label_space(space: Any, scene: Scene) -> None:
    from matplotlib.ticker import MaxNLocator

    space.set(xlabel="x [m]", ylabel="y [m]", zlabel="z [m]", title="3D")
    points = scene.tracks.position.reshape(-1, 3)
    points = points[np.isfinite(points).all(axis=1)]
    if len(points):
        low, high = points.min(axis=0), points.max(axis=0)
        low[2] = min(low[2], 0.0)
        # Equal scales, but a flat flight keeps some height.
        extent = np.maximum(high - low, 0.2 * max(float((high - low).max()), 1.0))
        space.set(xlim=_span(low[0], extent[0]), ylim=_span(low[1], extent[1]))
        space.set_zlim(low[2], low[2] + extent[2])
        space.set_box_aspect(extent, zoom=0.95)
    space.view_init(elev=30, azim=-62)
    for axis, bins in ((space.xaxis, 6), (space.yaxis, 5), (space.zaxis, 3)):
        axis.set_pane_color((1.0, 1.0, 1.0, 0.0))
        axis.set_major_locator(MaxNLocator(bins))
        axis.labelpad = 5


def _span(low: float, extent: float) -> tuple[float, float]:
    return low - 0.02 * extent, low + 1.02 * extent


def _mark_formations(scene: Scene, spaces: list[Any], plan: Any) -> None:
    """The shape at some instants: a closed line around the vehicles, and a dot for each."""
    time = scene.tracks.time
    begin, end = scene.counted_s or (time[0], time[-1])
    many = len(scene.tracks.names) > MANY
    label = "formation at moments"
    for instant in np.linspace(begin, end, _SNAPSHOTS_OF_MANY if many else _SNAPSHOTS):
        points = scene.tracks.position[int(np.argmin(np.abs(time - instant)))]
        points = points[np.isfinite(points).all(axis=1)]
        if len(points) < 2:
            continue
        outline = outline_of(points)
        x, y = outline[:, 0], outline[:, 1]
        plan.plot(x, y, color="#777777", linewidth=0.9, zorder=4, label=label)
        label = "_nolegend_"  # once is enough
        plan.plot(points[:, 0], points[:, 1], "o", color="#333333", markersize=3.5, zorder=5)
        for space in spaces:
            space.plot(*outline.T, color="#777777", linewidth=0.9)


def outline_of(points: Array) -> Array:
    """A line that shows the shape of some points, shape (N, 3) -> (K, 3).

    Few are joined with their neighbours around the center (along the line if they are on one), of
    many it is the convex hull in plan; closed.
    """
    flat = points[:, :2] - points[:, :2].mean(axis=0)
    u, singular, _ = np.linalg.svd(flat, full_matrices=False)
    if singular[-1] < 0.05 * max(singular[0], 1e-9):
        return points[np.argsort(u[:, 0])]
    if len(points) > MANY:
        return points[_hull(flat)]
    order = np.argsort(np.arctan2(flat[:, 1], flat[:, 0]))
    return points[np.append(order, order[0])]


def _hull(flat: Array) -> list[int]:
    """Indices of the convex hull of points in a plane, closed (Andrew's monotone chain)."""
    order = np.lexsort((flat[:, 1], flat[:, 0])).tolist()
    ring: list[int] = []
    for chain in (order, order[::-1]):
        half: list[int] = []
        for index in chain:
            while len(half) > 1 and _turn(flat[half[-2]], flat[half[-1]], flat[index]) <= 0.0:
                half.pop()
            half.append(index)
        ring += half[:-1]
    return [*ring, ring[0]]


def _turn(a: Array, b: Array, c: Array) -> float:
    """Twice the area of a triangle in a plane, positive if it turns left [m^2]."""
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def _draw_height(scene: Scene) -> Any:
    figure, axes = _time_figure(scene, "height", "z in the world [m]")
    for index, name in enumerate(scene.tracks.names):
        z = scene.tracks.position[:, index, 2]
        axes.plot(scene.tracks.time, z, color=color(index), label=label(scene, name))
    low, high = axes.get_ylim()
    axes.set_ylim(min(0.0, low), max(high, LEVEL_M))
    _finish(axes)
    return figure


def draw_formation_error(scene: Scene) -> Any:
    """The error of the shape over time; None of a single vehicle, or without a command."""
    error = scene.formation_error()
    if error is None:
        return None
    figure, axes = _time_figure(scene, "formation error", "RMS after rigid alignment [m]")
    axes.plot(scene.tracks.time, error, color=_COLORS[0], label="all vehicles")
    limit = scene.formation_limit_m
    if limit is not None:
        _limit(axes, limit, f"limit of the RMS over time {limit:g} m")
    _fit(axes, scene, error, limit)
    _finish(axes)
    return figure


def _draw_separation(scene: Scene) -> Any:
    separation = scene.separation()
    if separation is None:
        return None
    figure, axes = _time_figure(scene, "smallest separation", "distance of the closest pair [m]")
    axes.plot(scene.tracks.time, separation, color=_COLORS[2], label="flown")
    if scene.file_separation_m is not None:
        label = f"minimum of the file {scene.file_separation_m:.3f} m"
        axes.axhline(scene.file_separation_m, color="#777777", linestyle=":", label=label)
    if scene.separation_limit_m is not None:
        _limit(axes, scene.separation_limit_m, f"limit {scene.separation_limit_m:.3f} m")
    axes.set_ylim(bottom=0.0)
    _finish(axes)
    return figure


def _draw_tracking_error(scene: Scene) -> Any:
    error = scene.tracking_error()
    if error is None:
        return None
    figure, axes = _time_figure(scene, "tracking error", "distance to the command [m]")
    for index, name in enumerate(scene.tracks.names):
        values = error[:, index]
        axes.plot(scene.tracks.time, values, color=color(index), label=label(scene, name))
    _fit(axes, scene, error, None)
    _finish(axes)
    return figure


def _time_figure(scene: Scene, what: str, unit: str) -> tuple[Any, Any]:
    figure = _new_figure(9.0, 3.8)
    axes = figure.add_subplot()
    axes.set(title=f"{scene.title}: {what}", xlabel="simulated time [s]", ylabel=unit)
    time = scene.tracks.time
    axes.set_xlim(time[0], max(time[-1], time[0] + 1e-3))
    if scene.counted_s:
        begin, end = scene.counted_s
        axes.axvspan(time[0], begin, color=_OUTSIDE, zorder=0, label="not counted")
        axes.axvspan(end, time[-1], color=_OUTSIDE, zorder=0)
    return figure, axes


def _fit(axes: Any, scene: Scene, values: Array, limit: float | None) -> None:
    """Scale to what counts: the take-off may be far off, and must not flatten the rest."""
    counted = values
    if scene.counted_s:
        begin, end = scene.counted_s
        inside = (scene.tracks.time >= begin) & (scene.tracks.time <= end)
        counted = values[inside] if inside.any() else values
    finite = counted[np.isfinite(counted)]
    top = max(float(finite.max()) if len(finite) else 0.0, limit or 0.0, 1e-3)
    axes.set_ylim(0.0, 1.15 * top)


def _limit(axes: Any, value: float, label: str) -> None:
    axes.axhline(value, color=_LIMIT, linestyle="--", linewidth=1.1, label=label)


def _finish(axes: Any) -> None:
    _legend_below(axes, -0.17)


def _legend_below(axes: Any, offset: float) -> None:
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, offset), ncols=8, fontsize=9)


def color(index: int) -> str:
    """Colour of a vehicle, in the order of the scene."""
    return _COLORS[index % len(_COLORS)]


def dashes(index: int) -> str:
    """Kind of line of what has color(index): another one where the colors begin again."""
    return ("-", "-.")[index // len(_COLORS) % 2]


def label(scene: Scene, name: str) -> str:
    """What a legend says of a vehicle; nothing where there are too many for one."""
    return name if len(scene.tracks.names) <= MANY else "_nolegend_"
