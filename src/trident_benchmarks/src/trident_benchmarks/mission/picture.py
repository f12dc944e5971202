# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Coverage over time of all modes, with bands over the coasts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from trident_eval.core.sweep.rows import DONE, RunRow


def draw_coverage(path: Path, modes: Mapping[str, Sequence[RunRow]]) -> None:
    """Mean of each mode, and the range from the tenth to the ninetieth percentile.

    Args:
        path: of the PNG.
        modes: runs by mode.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(figsize=(9.0, 5.0), layout="constrained")
    minutes = np.arange(16)
    for mode, rows in modes.items():
        curves = np.array(
            [
                [0.0, *(row.metrics[f"curve_{60 * step}"] for step in range(1, 16))]
                for row in rows
                if row.status == DONE
            ]
        )
        if not len(curves):
            continue
        (drawn,) = axes.plot(minutes, 100.0 * curves.mean(axis=0), label=mode)
        low, high = np.percentile(100.0 * curves, (10, 90), axis=0)
        axes.fill_between(minutes, low, high, color=drawn.get_color(), alpha=0.2, linewidth=0)
    axes.axhline(97.0, color="0.6", linewidth=0.8)
    axes.set(xlabel="time [min]", ylabel="cells covered [%]", xlim=(0, 15), ylim=(0, 100))
    axes.legend(loc="lower right")
    axes.grid(alpha=0.3)
    figure.savefig(path, dpi=110)
    plt.close(figure)
