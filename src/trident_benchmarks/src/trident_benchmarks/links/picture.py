# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures: goodput over distance, and how well a coast is covered."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from trident_eval.ros_paths import package_folder

import trident_sim

_RADIO = """<sdf version="1.6"><model name="radio"><link name="base"><gravity>0</gravity></link>
<plugin name="radio" filename="libtrident_radio.so"><tx_power>10</tx_power><height>0</height>
</plugin></model></sdf>"""
_SENDERS = {
    "a mast on the shore": (0.0, 60.0, 6.0),
    "a UAV at 25 m": (10.0, 0.0, 25.0),
}
_ANTENNA_M = 1.5  # above ground or water
_HALF_M = 100.0  # of the picture's sides


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


def draw_losses(path: Path, rows: Sequence[dict[str, Any]]) -> None:
    """Loss over the ratio of signal to noise: counted, and ns-3's.

    Args:
        path: of the PNG.
        rows: of the suite per.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    widths = sorted({row["width"] for row in rows})
    figure, panels = plt.subplots(
        len(widths), 1, figsize=(10.0, 3.0 * len(widths)), layout="constrained", squeeze=False
    )
    for axes, width in zip(panels[:, 0], widths, strict=True):
        _draw_losses_of(axes, [row for row in rows if row["width"] == width])
        axes.set_ylim(5e-3, 1.1)
        axes.set_xlim(-3.0, 28.0)
        axes.set_ylabel(f"loss, {width} MHz")
        axes.grid(True, which="both", alpha=0.3)
    handles, labels = panels[-1, 0].get_legend_handles_labels()
    panels[0, 0].legend(handles, labels, fontsize=8, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    panels[0, 0].set_title(
        "lines: ns-3, by table; marks: counted here; solid, dots: 1500 bytes; dashed, crosses: 100"
    )
    panels[-1, 0].set_xlabel("signal over noise [dB]")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def _draw_losses_of(axes: Any, rows: Sequence[dict[str, Any]]) -> None:
    """The curves of one width of the channel."""
    from matplotlib import pyplot as plt

    marks = {1500: ("-", "o"), 100: ("--", "x")}
    for row in rows:
        style, mark = marks[row["bytes"]]
        shade = plt.get_cmap("turbo")(row["mcs"] / 9.0)
        label = f"MCS {row['mcs']}" if row["bytes"] == 1500 else None
        axes.semilogy(*np.array(row["ns3_curve"]).T, style, color=shade, linewidth=1.0)
        axes.semilogy(*np.array(row["curve"]).T, mark, color=shade, markersize=4, label=label)


def coast_coverage(cells: int) -> dict[str, npt.NDArray[np.float64]]:
    """How well a radio 1.5 m above the coast's ground or water hears some senders of 10 dBm.

    Args:
        cells: along each side of a square of 200 m about the harbor.

    Returns:
        By sender: signal over noise [dB], shape (cells, cells), rows along y.
    """
    file = package_folder("trident_bringup") / "worlds" / "coast.world"
    air = '<plugin name="air" filename="libtrident_radio_medium.so"/></world>'
    world = trident_sim.World(file.read_text(encoding="utf-8").replace("</world>", air), seed=1)
    axis = np.linspace(-_HALF_M, _HALF_M, cells)
    places = np.stack(np.meshgrid(axis, axis), axis=-1).reshape(-1, 2)
    above = np.column_stack([places, np.full(len(places), 200.0)])
    down = np.tile([0.0, 0.0, -1.0], (len(places), 1))
    ground = 200.0 - world.cast_rays(above, down).distance
    heights = np.maximum(ground, 0.0) + _ANTENNA_M
    for name, place in _SENDERS.items():
        world.spawn(name, sdf=_RADIO, pose=place)
    probe = world.spawn("probe", sdf=_RADIO)
    snr = {name: np.empty(len(places)) for name in _SENDERS}
    for i, ((x, y), z) in enumerate(zip(places, heights, strict=True)):
        probe.set_pose((x, y, z))
        for link in world.radio.links():
            if link.destination == "probe":
                snr[link.source][i] = link.snr
    return {name: values.reshape(cells, cells) for name, values in snr.items()}


def draw_coast(path: Path, cells: int = 120) -> None:
    """The coast as its senders cover it, side by side.

    Args:
        path: of the PNG.
        cells: along each side.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    coverage = coast_coverage(cells)
    figure, axes = plt.subplots(
        1, len(coverage), figsize=(12.0, 5.0), layout="constrained", sharey=True
    )
    extent = (-_HALF_M, _HALF_M, -_HALF_M, _HALF_M)
    for ax, (name, values) in zip(axes, coverage.items(), strict=True):
        image = ax.imshow(values, origin="lower", extent=extent, vmin=0.0, vmax=50.0)
        x, y, _ = _SENDERS[name]
        ax.plot(x, y, "r^", markersize=9)
        ax.set_title(f"from {name}")
        ax.set_xlabel("x east [m]")
    axes[0].set_ylabel("y north [m]")
    figure.colorbar(image, ax=axes, label="signal over noise 1.5 m above ground or water [dB]")
    figure.savefig(path, dpi=110)
    plt.close(figure)
