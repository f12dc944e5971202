# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of a judged trajectory and map."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from trident_eval.core.plots import saved_figures
from trident_eval.core.tracks import Array
from trident_eval.slam.grid import FREE, OCCUPIED, Grid
from trident_eval.slam.map_agreement import surfaces

if TYPE_CHECKING:
    from trident_eval.slam.evaluation import Evaluation

CAPTIONS = {
    "map": "The map and the path of the base; black: occupied, white: free, grey: unknown.",
    "relations": "Share of the hand-checked relations that are kept within an error.",
    "truth": "The trajectory after the rigid motion that fits best, and its error along the path.",
    "map_agreement": "The map over the true surfaces: blue within the tolerance, red beyond it.",
}
_COLORS = ("#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9")
_TRUTH, _GOOD, _BAD = "#999999", "#0072B2", "#B00020"
_ABOVE: dict[str, Any] = {"loc": "lower center", "bbox_to_anchor": (0.5, 1.0)}  # of a legend
_MARGIN_M = 0.5  # around a map, so that its walls do not lie under the axes
_MAX_ROOM_M = 30.0  # beyond it, thin rays through a window would make the rest small


def draw_all(found: Evaluation, folder: Path) -> list[Path]:
    """Draw what there is into an existing folder; returns the files."""
    drawings = {}
    if found.grid is not None or found.trajectories:
        drawings["map.png"] = partial(draw_map, found)
    if found.relations:
        drawings["relations.png"] = partial(_draw_relations, found)
    if found.absolute:
        drawings["truth.png"] = partial(_draw_truth, found)
    if found.agreement is not None:
        drawings["map_agreement.png"] = partial(_draw_agreement, found)
    return saved_figures(drawings, folder)


def _figure(width: float, height: float) -> Any:
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def shades(grid: Grid) -> Array:
    """Grey values of the cells, 0 (black) .. 1, shape (rows, columns)."""
    return np.select([grid.cells == OCCUPIED, grid.cells == FREE], [0.0, 1.0], 0.8)


def show_grid(axes: Any, grid: Grid) -> None:
    """Draw a map into axes in metres, cut to what is known and a margin."""
    rows, columns = np.nonzero(grid.cells >= 0)
    if not len(rows):
        return
    height, width = grid.cells.shape
    x0, y0 = grid.origin[:2]
    edges = (x0, x0 + width * grid.resolution, y0, y0 + height * grid.resolution)
    axes.imshow(shades(grid), cmap="gray", vmin=0, vmax=1, origin="lower", extent=edges, zorder=0.5)
    left, right = x0 + grid.resolution * np.array([columns.min(), columns.max() + 1])
    bottom, top = y0 + grid.resolution * np.array([rows.min(), rows.max() + 1])
    axes.set_xlim(left - _MARGIN_M, right + _MARGIN_M)
    axes.set_ylim(bottom - _MARGIN_M, top + _MARGIN_M)


def draw_map(found: Evaluation) -> Any:
    """The map and the paths, with their names above."""
    figure = _figure(9.0, 8.0)
    axes = figure.add_subplot()
    colored = list(zip(_COLORS, found.trajectories.items(), strict=False))
    for color, (name, trajectory) in reversed(colored):
        axes.plot(*trajectory.p[:, :2].T, color=color, linewidth=0.7, label=name)
    if found.grid is not None:
        show_grid(axes, found.grid)
        if found.trajectories:
            _frame_room(axes, np.concatenate([t.p[:, :2] for t in found.trajectories.values()]))
    axes.grid(visible=False)
    axes.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
    axes.set_title("map and path", pad=28)
    if found.trajectories:
        axes.legend(**_ABOVE, ncols=3)
    return figure


def _frame_room(axes: Any, points: Array) -> None:
    low, high = points.min(0) - _MAX_ROOM_M, points.max(0) + _MAX_ROOM_M
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    axes.set_xlim(max(left, low[0]), min(right, high[0]))
    axes.set_ylim(max(bottom, low[1]), min(top, high[1]))


def _draw_relations(found: Evaluation) -> Any:
    figure = _figure(10.0, 4.2)
    for place, unit in ((1, "m"), (2, "deg")):
        axes = figure.add_subplot(1, 2, place)
        for color, (name, errors) in zip(_COLORS, found.relations.items(), strict=False):
            values = errors.translation_m if unit == "m" else np.degrees(errors.rotation_rad)
            ordered = np.maximum(np.sort(values), 1e-6)  # for the logarithm
            share = np.arange(1, len(ordered) + 1) / len(ordered)
            axes.plot(ordered, share, color=color, label=f"{name}: mean {values.mean():.4g} {unit}")
        axes.set_xscale("log")
        axes.set(
            xlabel=f"{'translation' if unit == 'm' else 'rotation'} error [{unit}]",
            ylabel="share of relations",
            ylim=(0, 1.01),
        )
        axes.legend(loc="upper left", fontsize=9)
    return figure


def _draw_truth(found: Evaluation) -> Any:
    figure = _figure(11.0, 5.0)
    plan, error = figure.subplots(1, 2, width_ratios=(1.1, 1.0))
    for color, (name, errors) in zip(_COLORS, found.absolute.items(), strict=False):
        if not plan.lines:
            plan.plot(*errors.truth.p[:, :2].T, color=_TRUTH, linewidth=3, label="truth")
        plan.plot(*errors.aligned.p[:, :2].T, color=color, linewidth=1, label=name)
        rmse = np.sqrt(np.mean(errors.translation_m**2))
        error.plot(
            errors.stamp - errors.stamp[0],
            100 * errors.translation_m,
            color=color,
            linewidth=0.9,
            label=f"{name}: RMSE {100 * rmse:.2f} cm",
        )
    plan.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
    plan.set_title("plan view", pad=28)
    error.set(xlabel="time [s]", ylabel="position error [cm]", title="error", ylim=(0, None))
    plan.legend(**_ABOVE, ncols=3)
    error.legend(loc="best")
    return figure


def _draw_agreement(found: Evaluation) -> Any:
    if found.grid is None or found.true_grid is None or found.agreement is None:
        return None
    figure = _fitting_figure(surfaces(found.true_grid))
    axes = figure.add_subplot()
    T = found.agreement.T_truth_map
    walls = found.grid.centers(OCCUPIED) @ T[:2, :2].T + T[:2, 2]
    is_good = found.agreement.wall_error_m <= found.agreement.tolerance_m
    axes.plot(*surfaces(found.true_grid).T, "s", color="#CCCCCC", markersize=2.5, label="truth")
    axes.plot(*walls[is_good].T, ".", color=_GOOD, markersize=1.5, label="map")
    axes.plot(*walls[~is_good].T, ".", color=_BAD, markersize=2.5, label="map, wrong")
    axes.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
    axes.set_title("map over true surfaces", pad=28)
    axes.legend(**_ABOVE, ncols=3, markerscale=4)
    return figure


def _fitting_figure(corners: Array) -> Any:
    """A figure whose axes, in metres, are as wide and high as points (N, 2) need."""
    width, height = np.ptp(corners, axis=0)
    return _figure(9.0, float(np.clip(8.0 * height / max(width, 1e-6) + 2.0, 4.0, 11.0)))
