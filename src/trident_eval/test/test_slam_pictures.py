# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from trident_eval.slam.evaluation import Task, evaluate
from trident_eval.slam.grid import UNKNOWN, Grid
from trident_eval.slam.pictures import draw_map, show_grid


def test_a_map_has_half_a_meter_around_it() -> None:
    cells = np.full((40, 60), UNKNOWN, np.int8)
    cells[10:20, 20:50] = 0
    axes = Figure().add_subplot()
    show_grid(axes, Grid(cells, 0.1, np.array([-1.0, 2.0, 0.0])))
    np.testing.assert_allclose(axes.get_xlim(), (0.5, 4.5))
    np.testing.assert_allclose(axes.get_ylim(), (2.5, 4.5))


def test_the_legend_of_a_map_lies_outside(tmp_path: Path) -> None:
    path = tmp_path / "trajectory.tum"
    path.write_text("0 0 0 0 0 0 0 1\n1 1 1 0 0 0 0 1\n")
    figure = draw_map(evaluate(Task({"final": path})))
    figure.canvas.draw()
    axes = figure.axes[0]
    assert axes.get_legend().get_window_extent().y0 >= axes.get_window_extent().y1
