# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of checks: the simulator's curves over their references and tolerances."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from trident_benchmarks.vessels.check import Check, Panel

# Okabe and Ito's colors, which color-blind readers distinguish too.
_COLORS = ("#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9")
_LEGAL = "#D9E8D0"
_STYLE: dict[str, Any] = {
    "savefig.dpi": 110,
    "font.size": 9,
    "axes.titlesize": 10,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "grid.color": "#E4E4E4",
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "lines.linewidth": 1.6,
}


def draw(check: Check, file: Path) -> None:
    """Write a check's panels side by side into a PNG file."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib.figure import Figure

    with matplotlib.rc_context(_STYLE):
        count = len(check.panels)
        picture = Figure(figsize=(1.2 + 4.2 * count, 4.5), layout="constrained")
        picture.suptitle(check.title)
        for axes, panel in zip(
            picture.subplots(1, count, squeeze=False)[0], check.panels, strict=True
        ):
            _draw_panel(axes, panel)
        # No creation date in the file: the same run gives the same bytes.
        picture.savefig(file, metadata={"Software": None})


def _draw_curves(axes: Any, panel: Panel) -> None:
    """What was measured in colors, references in black."""
    for color, curve in zip(_COLORS, panel.measured, strict=False):
        line, marker = ("none", "o") if curve.dots else ("-", None)
        axes.plot(curve.x, curve.y, color=color, linestyle=line, marker=marker, label=curve.label)
    for style, curve in zip(("--", ":", "-.", (0, (1, 3))), panel.reference, strict=False):
        axes.plot(curve.x, curve.y, color="black", linestyle=style, lw=1.0, label=curve.label)


def _draw_panel(axes: Any, panel: Panel) -> None:
    for i, (x, lower, upper) in enumerate(panel.bands):
        label = "legal" if i == 0 else None
        axes.fill_between(x, lower, upper, color=_LEGAL, linewidth=0.0, label=label)
    _draw_curves(axes, panel)
    axes.set(title=panel.title, xlabel=panel.x_label, ylabel=panel.y_label)
    if panel.log:
        axes.set_yscale("log")
    if panel.equal:
        axes.set_aspect("equal", adjustable="datalim")
    axes.locator_params(axis="x", nbins=6)
    axes.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=3)
