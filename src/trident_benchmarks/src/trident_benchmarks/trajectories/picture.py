# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Picture: teams from above, and in space and time."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np


def draw(path: Path, cases: Sequence[dict[str, Any]]) -> None:
    """A row for each case: from above, and with time upwards.

    Args:
        path: of the PNG.
        cases: with the robots' points (t [s], x, y, z [m]), as the trial's picture prints them.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure = plt.figure(figsize=(11.0, 5.0 * len(cases)), layout="constrained")
    for row, case in enumerate(cases):
        above = figure.add_subplot(len(cases), 2, 2 * row + 1)
        over_time = figure.add_subplot(len(cases), 2, 2 * row + 2, projection="3d")
        for robot in case["robots"]:
            t, x, y, _ = np.array(robot["points"]).T
            (drawn,) = above.plot(x, y, label=f"{robot['name']} ({robot['kind']})")
            above.plot(x[-1], y[-1], "o", color=drawn.get_color(), markersize=5)
            over_time.plot(x, y, t, color=drawn.get_color())
        above.set_aspect("equal")
        above.set_title(f"{case['case']}: from above")
        above.set_xlabel("x [m]")
        above.set_ylabel("y [m]")
        above.grid(True, alpha=0.3)
        above.legend(fontsize=7)
        over_time.set_title("in space and time")
        over_time.set_xlabel("x [m]")
        over_time.set_ylabel("y [m]")
        over_time.set_zlabel("t [s]")
    figure.savefig(path, dpi=110)
    plt.close(figure)
