# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A pose graph before and after, side by side."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from trident_eval.pose_graph.g2o import Layout

_BEFORE, _AFTER, _ODOMETRY, _OUTLIER = "#8A8A8A", "#0072B2", "#222222", "#D55E00"
_FIRST = "#009E73"
_FEW = 200


def draw(panels: list[tuple[str, Layout]], outliers: list[list[int]], file: Path) -> None:
    """Write a PNG of up to two panels (title, graph); rejected edges are red in the last one."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4 * len(panels), 6.2), layout="constrained")
    figure.get_layout_engine().set(rect=(0.0, 0.05, 1.0, 0.95))  # room for the legend
    for number, (title, layout) in enumerate(panels, 1):
        is_last = number == len(panels)
        kind = {"projection": "3d"} if layout.is_3d else {}
        axes = figure.add_subplot(1, len(panels), number, **kind)
        axes.set_title(title, fontsize=10)
        _draw_graph(axes, layout, _AFTER if is_last else _BEFORE, outliers if is_last else [])
    figure.legend(*axes.get_legend_handles_labels(), loc="lower center", ncol=4, fontsize=8)
    # No creation date in the file: the same graph gives the same bytes.
    figure.savefig(file, dpi=110, metadata={"Software": None})


def _draw_graph(axes: Any, layout: Layout, color: str, outliers: list[list[int]]) -> None:
    chain = _ODOMETRY if color == _AFTER else color
    _draw_edges(axes, layout, color, chain, outliers)
    # Few vertices are lost among their lines; the first is where the others are seen from.
    size = 9.0 if len(layout.ids) <= _FEW else 0.0
    axes.scatter(*layout.positions.T, s=size, color=chain, linewidths=0)
    axes.scatter(*layout.positions[:1].T, s=18, color=_FIRST, linewidths=0, label="first vertex")
    _set_frame(axes, layout)


def _draw_edges(
    axes: Any, layout: Layout, color: str, chain: str, outliers: list[list[int]]
) -> None:
    follows = layout.edges[:, 1] - layout.edges[:, 0] == 1
    rejected = {(a, b) for a, b in outliers}
    kept = np.array([tuple(edge) not in rejected for edge in layout.edges], dtype=bool)
    for label, edges, shade, width, alpha in (
        ("other edges", layout.edges[~follows & kept], color, 0.5, 0.45),
        ("from one vertex to the next", layout.edges[follows & kept], chain, 0.7, 0.9),
        ("rejected", layout.edges[~kept], _OUTLIER, 0.7, 0.5),
    ):
        if len(edges):
            named = f"{label} ({len(edges)})"
            _add_lines(axes, layout, edges, color=shade, linewidth=width, alpha=alpha, label=named)
            axes.collections[-1].set_zorder(1.9 if shade == _OUTLIER else 2.0)  # beneath the graph


def _set_frame(axes: Any, layout: Layout) -> None:
    low, high = layout.positions.min(axis=0), layout.positions.max(axis=0)
    margin = 0.03 * float((high - low).max()) + 1e-9
    axes.set(xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin))
    axes.set(xlabel="x [m]", ylabel="y [m]")
    axes.tick_params(labelsize=7 if layout.is_3d else 8)
    if layout.is_3d:
        axes.set(zlim=(low[2] - margin, high[2] + margin), zlabel="z [m]")
        sides = np.maximum(high - low, 0.15 * float((high - low).max())) + 2.0 * margin
        axes.set_box_aspect(sides, zoom=0.84)
        axes.view_init(elev=28.0, azim=-55.0)
        for axis, side in zip((axes.xaxis, axes.yaxis, axes.zaxis), sides, strict=True):
            # Ticks no nearer than they can be read, the name of the axis beyond them.
            axis.set_major_locator(_ticks(6.0 * float(side / sides.max())))
            axis.labelpad = 6.0
    else:
        axes.set_aspect("equal")
        axes.grid(color="#E4E4E4", linewidth=0.6)
        axes.set_axisbelow(True)


def _ticks(most: float) -> Any:
    from matplotlib.ticker import MaxNLocator

    return MaxNLocator(nbins=max(2, round(most)))


def _add_lines(axes: Any, layout: Layout, edges: Any, **style: Any) -> None:
    from matplotlib.collections import LineCollection
    from mpl_toolkits.mplot3d.art3d import Line3DCollection

    segments = layout.segments(edges)
    if layout.is_3d:
        axes.add_collection3d(Line3DCollection(segments, **style))
    else:
        axes.add_collection(LineCollection(segments, **style))
