# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Goodput over distance as a picture."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any


def draw_goodput(path: Path, rows: Sequence[dict[str, Any]]) -> None:
    """Each fixed rate, and the adaptive one.

    Args:
        path: of the PNG.
        rows: of the suite adaptive.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(figsize=(9.0, 5.0), layout="constrained")
    distances = [row["distance_m"] for row in rows]
    modes = len(rows[0]["fixed_mbit_s"])
    for mcs in range(modes):
        shade = plt.get_cmap("viridis")(mcs / (modes - 1))
        values = [row["fixed_mbit_s"][mcs] for row in rows]
        axes.plot(distances, values, color=shade, linewidth=1.0, label=f"MCS {mcs}")
    adaptive = [row["mbit_s"] for row in rows]
    axes.plot(distances, adaptive, "ko", markersize=4, label="adaptive")
    axes.set_xscale("log")
    axes.set_xlabel("distance [m]")
    axes.set_ylabel("goodput [Mbit/s]")
    axes.set_title("802.11ac, 20 MHz, free space, 20 dBm, UDP with 1472 bytes, A-MPDU")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend(ncol=2, fontsize=8)
    figure.savefig(path, dpi=120)
    plt.close(figure)
