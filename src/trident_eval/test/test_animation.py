# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from trident_eval.core.animation import FRAMES_PER_S, animate, pace
from trident_eval.core.errors import EvalError
from trident_eval.core.scene import Scene
from trident_eval.core.tracks import Array, Tracks

image = pytest.importorskip("PIL.Image")


def scene(duration_s: float = 2.0, vehicles: int = 2) -> Scene:
    """Vehicles side by side that move along x at 1 m/s."""
    time = np.arange(0.0, duration_s + 0.01, 0.05)
    position = np.ones((len(time), vehicles, 3))
    position[:, :, 0] = time[:, None]
    position[:, :, 1] = np.arange(vehicles)
    names = [f"UAV{number}" for number in range(vehicles)]
    return Scene("moving", Tracks(names, time, position), position.copy())


def frames(path: Path) -> list[Array]:
    with image.open(path) as gif:
        pictures = []
        for index in range(gif.n_frames):
            gif.seek(index)
            pictures.append(np.asarray(gif.convert("RGB"), dtype=np.float64))
        return pictures


def column_of(picture: Array, color: tuple[int, int, int]) -> float:
    """Mean column of the pixels of about this color [pixel]."""
    near = np.abs(picture - np.array(color)).max(axis=-1) < 40.0
    assert near.any()
    return float(np.nonzero(near)[1].max())


def test_vehicles_move_to_the_right_over_a_white_ground(tmp_path: Path) -> None:
    pictures = frames(animate(scene(), tmp_path / "a.gif"))
    assert len(pictures) == round(2.0 * FRAMES_PER_S) + 1
    blue = (0, 114, 178)
    columns = [column_of(picture, blue) for picture in pictures]
    assert columns == sorted(columns)
    assert columns[-1] > columns[0] + 200.0
    assert (pictures[0][2, 2] == 255.0).all()


@pytest.mark.parametrize(
    ("duration_s", "faster"), [(3.0, 1.0), (14.0, 1.0), (41.2, 3.0), (600.0, 43.0)]
)
def test_a_long_run_is_shown_faster(duration_s: float, faster: float) -> None:
    time = np.arange(0.0, duration_s + 0.01, 0.05)
    chosen = pace(time)
    assert chosen.faster == faster
    assert chosen.index[0] == 0
    assert chosen.index[-1] == len(time) - 1
    assert (np.diff(chosen.index) >= 1).all()
    assert len(chosen.index) / FRAMES_PER_S <= 14.2


def test_the_same_run_gives_the_same_file(tmp_path: Path) -> None:
    first, second = animate(scene(), tmp_path / "a.gif"), animate(scene(), tmp_path / "b.gif")
    assert first.read_bytes() == second.read_bytes()


def test_a_vehicle_that_comes_late_and_many_vehicles_are_drawn(tmp_path: Path) -> None:
    late = scene(vehicles=20)
    late.tracks.position[:10, 3] = np.nan
    reported: list[tuple[int, int]] = []
    path = animate(late, tmp_path / "a.gif", lambda *count: reported.append(count))
    assert len(frames(path)) == reported[-1][0] == reported[-1][1]


def test_what_does_not_move_cannot_be_animated(tmp_path: Path) -> None:
    still = scene(0.0)
    with pytest.raises(EvalError, match="two recorded instants"):
        animate(still, tmp_path / "a.gif")
    nowhere = scene()
    nowhere.tracks.position[:] = np.nan
    with pytest.raises(EvalError, match="no finite position"):
        animate(nowhere, tmp_path / "a.gif")
    assert not list(tmp_path.iterdir())
