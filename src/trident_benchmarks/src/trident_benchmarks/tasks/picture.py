# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Picture: how far above its yardstick each method ends."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any


def draw_gaps(path: Path, rows: Sequence[dict[str, Any]]) -> None:
    """A panel for each yardstick, a box for each method, a dot for each instance.

    Args:
        path: of the PNG.
        rows: of the benchmark; those without gaps are left out.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    rows = [row for row in rows if "gaps" in row]
    panels = list(dict.fromkeys(row["row"] for row in rows)) or ["no gaps were measured"]
    figure, axes = plt.subplots(
        1, len(panels), figsize=(4.5 * len(panels), 5.0), layout="constrained", squeeze=False
    )
    for ax, what in zip(axes[0], panels, strict=True):
        shown = [row for row in rows if row["row"] == what]
        for place, row in enumerate(shown, start=1):
            percent = [100.0 * gap for gap in row["gaps"]]
            ax.boxplot([percent], positions=[place], widths=0.6, showfliers=False)
            spread = [place - 0.2 + 0.4 * (i % 9) / 8.0 for i in range(len(percent))]
            ax.plot(spread, percent, ".", markersize=4, alpha=0.5)
            for limit in row["limits"].values():
                ax.axhline(100.0 * limit, color="tab:red", linewidth=0.8, linestyle="--")
        ax.set_xticks(range(1, len(shown) + 1), [row["method"] for row in shown], rotation=20)
        ax.set_yscale("symlog", linthresh=1.0)
        ax.set_title(what, fontsize=9)
        ax.grid(True, axis="y", alpha=0.3)
    axes[0, 0].set_ylabel("above the yardstick [%]; dashed: limits")
    figure.savefig(path, dpi=110)
    plt.close(figure)
