# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from trident_eval.core.plots import (
    LEVEL_M,
    MANY,
    draw_all,
    draw_formation_error,
    draw_paths,
    height_range,
    label,
    outline_of,
)
from trident_eval.core.scene import Scene
from trident_eval.core.tracks import Array, Tracks


def grid(side: int) -> Array:
    """Points of a square, row by row, shape (side^2, 3) [m]."""
    x, y = np.meshgrid(np.arange(side), np.arange(side))
    return np.stack([x.ravel(), y.ravel(), np.ones(side * side)], axis=1).astype(np.float64)


def area(line: Array) -> float:
    """What a closed line encloses in plan [m^2]."""
    x, y = line[:, 0], line[:, 1]
    return float(0.5 * abs((x[:-1] * y[1:] - x[1:] * y[:-1]).sum()))


def test_few_are_joined_with_their_neighbors() -> None:
    angle = np.array([0.0, 4.0, 2.0, 3.0, 1.0, 5.0]) * np.pi / 3.0
    hexagon = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    line = outline_of(hexagon)
    assert len(line) == 7
    np.testing.assert_array_equal(line[0], line[-1])
    np.testing.assert_allclose(np.linalg.norm(np.diff(line, axis=0), axis=1), 1.0)


def test_a_row_is_a_line_from_end_to_end() -> None:
    row = np.array([[0.0, 3.0, 1.0], [0.0, 0.0, 1.0], [0.0, 1.0, 1.0]])
    assert outline_of(row)[:, 1].tolist() in ([0.0, 1.0, 3.0], [3.0, 1.0, 0.0])


def test_many_have_their_hull_around_them() -> None:
    line = outline_of(grid(5))
    assert area(line) == pytest.approx(16.0)
    assert {tuple(point) for point in line[:, :2]} == {(0, 0), (4, 0), (4, 4), (0, 4)}
    np.testing.assert_array_equal(line[0], line[-1])


@pytest.mark.parametrize("side", [1, 3, 4])
def test_pictures_of_few_and_many(tmp_path: Path, side: int) -> None:
    time = np.linspace(0.0, 4.0, 30)
    position = grid(side)[None] + time[:, None, None] * np.array([0.2, 0.1, 0.0])
    names = [f"UAV{number}" for number in range(side * side)]
    scene = Scene("s", Tracks(names, time, position), position + 0.01)
    drawn = {path.stem for path in draw_all(scene, tmp_path)}
    assert drawn >= {"paths", "height", "tracking_error"}
    assert (label(scene, "UAV0") == "UAV0") == (side * side <= MANY)


def test_a_robot_on_the_ground_has_no_height_to_be_drawn() -> None:
    level = grid(3)
    assert height_range(level) < LEVEL_M
    level[0, 2] = np.nan
    level[1, 2] += 0.5
    assert height_range(level) == pytest.approx(0.5)
    assert height_range(np.full((4, 3), np.nan)) == 0.0


def flown() -> Scene:
    """Four vehicles that fly in step, with a limit."""
    time = np.linspace(0.0, 4.0, 30)
    position = grid(2)[None] + time[:, None, None] * np.array([0.2, 0.1, 0.0])
    names = [f"UAV{number}" for number in range(4)]
    tracks = Tracks(names, time, position)
    return Scene("s", tracks, position + 0.01, formation_limit_m=0.05)


def test_the_outlines_of_a_formation_are_in_the_legend_once() -> None:
    texts = [text.get_text() for text in draw_paths(flown()).legends[0].get_texts()]
    assert texts == ["UAV0", "UAV1", "UAV2", "UAV3", "command", "formation at moments"]


def test_the_limit_of_the_formation_error_is_that_of_its_rms() -> None:
    legend = draw_formation_error(flown()).axes[0].get_legend()
    assert "limit of the RMS over time 0.05 m" in [text.get_text() for text in legend.get_texts()]
