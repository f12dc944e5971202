# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of latencies: histograms of a topic and of a bare one."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from trident_eval.core.plots import color, saved_figures
from trident_eval.core.tracks import Array

_BINS = 80


def draw_latencies(latencies_ms: Mapping[str, Array], title: str, file: Path) -> None:
    """Draw histograms over a logarithmic axis, with medians.

    Args:
        latencies_ms: of each line of the legend [ms], shape (N,), N >= 1.
        title: of the picture.
        file: .png; its folder must exist.
    """
    saved_figures({file.name: lambda: _draw(latencies_ms, title)}, file.parent)


def _draw(latencies_ms: Mapping[str, Array], title: str) -> object:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9.0, 5.0), layout="constrained")
    axes = figure.subplots()
    # Simulated times may be equal: there is no logarithm of zero.
    floor = 1e-3
    values = {name: np.maximum(data, floor) for name, data in latencies_ms.items()}
    low = min(float(data.min()) for data in values.values())
    high = max(float(data.max()) for data in values.values())
    edges = np.geomspace(0.9 * low, 1.1 * high, _BINS)
    for index, (name, data) in enumerate(values.items()):
        label = f"{name}: median {np.median(data):.3f} ms, 99 % {np.percentile(data, 99):.3f} ms"
        axes.hist(data, bins=list(edges), histtype="step", color=color(index), label=label)
        axes.axvline(float(np.median(data)), color=color(index), linestyle="--", linewidth=1.0)
    axes.set(xscale="log", xlabel="latency [ms]", ylabel="messages", title=title)
    axes.legend(loc="upper right")
    axes.grid(True, which="both", alpha=0.3)
    return figure
