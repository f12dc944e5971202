# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Picture: where a team was, where it was believed to be, and how surely."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

_NAMES = ("uav", "ugv", "usv")
_ELLIPSE_PERIOD_S = 10.0
_OUTAGE_S = 30.0


def ellipse(covariance: Sequence[float]) -> tuple[float, float, float]:
    """Of two standard deviations: full width and height [m], angle [deg].

    Args:
        covariance: xx, xy, yy [m^2].
    """
    xx, xy, yy = covariance
    values, vectors = np.linalg.eigh(np.array([[xx, xy], [xy, yy]]))
    width, height = 4.0 * np.sqrt(values)
    return float(width), float(height), math.degrees(math.atan2(vectors[1, 0], vectors[0, 0]))


def _draw_tracks(axes: Any, points: Sequence[dict[str, Any]], colors: Sequence[str]) -> None:
    for robot, name in enumerate(_NAMES):
        own = [point for point in points if point["robot"] == robot]
        axes.plot(*np.array([point["truth"] for point in own]).T, color="0.6", linewidth=1.0)
        axes.plot(*np.array([point["p"] for point in own]).T, color=colors[robot], label=name)
        _draw_ellipses(axes, own, colors[robot])
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    axes.grid(True, alpha=0.3)
    axes.legend(fontsize=7)


def _draw_ellipses(axes: Any, points: Sequence[dict[str, Any]], color: str) -> None:
    """Two standard deviations, now and then."""
    from matplotlib.patches import Ellipse

    for point in points:
        if point["t"] % _ELLIPSE_PERIOD_S > 1e-6:
            continue
        width, height, angle = ellipse(point["covariance"])
        axes.add_patch(Ellipse(point["p"], width, height, angle=angle, fill=False, color=color))


def _draw_errors(axes: Any, points: Sequence[dict[str, Any]], label: str) -> None:
    own = [point for point in points if point["robot"] == 1]
    error = [math.dist(point["p"], point["truth"]) for point in own]
    sigma = [2.0 * math.sqrt(point["covariance"][0] + point["covariance"][2]) for point in own]
    (drawn,) = axes.plot([point["t"] for point in own], error, label=f"error, {label}")
    axes.plot(
        [point["t"] for point in own],
        sigma,
        linestyle="--",
        color=drawn.get_color(),
        label=f"two standard deviations, {label}",
    )


def draw(path: Path, points: Sequence[dict[str, Any]]) -> None:
    """Tracks with the UGV seen and unseen, and the UGV's error over time.

    Args:
        path: of the PNG.
        points: positions and covariances, as the program prints them.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(1, 3, figsize=(16.0, 5.0), layout="constrained")
    colors = plt.rcParams["axes.prop_cycle"].by_key()["color"]
    for column, (is_seen, label) in enumerate(((True, "seen by the UAV"), (False, "unseen"))):
        own = [point for point in points if point["seen"] is is_seen]
        _draw_tracks(axes[column], own, colors)
        axes[column].set_title(f"UGV {label}; gray: the truth")
        _draw_errors(axes[2], own, label)
    axes[2].axvline(_OUTAGE_S, color="0.5", linewidth=0.8)
    axes[2].set_title("the UGV, without GNSS from 30 s on")
    axes[2].set_xlabel("t [s]")
    axes[2].set_ylabel("horizontally [m]")
    axes[2].grid(True, alpha=0.3)
    axes[2].legend(fontsize=7)
    figure.savefig(path, dpi=90)
    plt.close(figure)
