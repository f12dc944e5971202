# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Picture: how far above its yardstick each method ends."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any


def _panels(rows: Sequence[dict[str, Any]]) -> dict[str, list[dict[str, Any]]]:
    """The rows with gaps by what they are compared with."""
    panels: dict[str, list[dict[str, Any]]] = {}
    for row in rows:
        if "gaps" in row:
            panels.setdefault(row["row"], []).append(row)
    return panels


def _draw_panel(ax: Any, rows: Sequence[dict[str, Any]]) -> None:
    for place, row in enumerate(rows, start=1):
        _draw_method(ax, place, row)
    ax.set_xticks(range(1, len(rows) + 1), [row["method"] for row in rows], rotation=20)
    ax.set_yscale("symlog", linthresh=1.0)
    ax.grid(True, axis="y", alpha=0.3)


def _draw_method(ax: Any, place: int, row: dict[str, Any]) -> None:
    percent = [100.0 * gap for gap in row["gaps"]]
    ax.boxplot([percent], positions=[place], widths=0.6, showfliers=False)
    spread = [place - 0.2 + 0.4 * (i % 9) / 8.0 for i in range(len(percent))]
    ax.plot(spread, percent, ".", markersize=4, alpha=0.5)
    for limit in row["limits"].values():
        ax.axhline(100.0 * limit, color="tab:red", linewidth=0.8, linestyle="--")


def draw_gaps(path: Path, rows: Sequence[dict[str, Any]]) -> None:
    """A panel for each yardstick, a box for each method, a dot for each instance.

    Args:
        path: of the PNG.
        rows: of the benchmark; those without gaps are left out.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    panels = _panels(rows) or {"no gaps were measured": []}
    figure, axes = plt.subplots(
        1, len(panels), figsize=(4.5 * len(panels), 5.0), layout="constrained", squeeze=False
    )
    for ax, (what, shown) in zip(axes[0], panels.items(), strict=True):
        _draw_panel(ax, shown)
        ax.set_title(what, fontsize=9)
    axes[0, 0].set_ylabel("above the yardstick [%]; dashed: limits")
    figure.savefig(path, dpi=110)
    plt.close(figure)
