# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Films in simulated time, read back with ffmpeg."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pytest
from trident_eval.core.errors import EvalError
from trident_viewer.film import Film, Pace, Pixels

WIDTH, HEIGHT = 64, 48


def plain(level: int) -> Pixels:
    return np.full((HEIGHT, WIDTH, 3), level, np.uint8)


def decoded(path: Path) -> Pixels:
    """Frames of a film, shape (N, height, width, 3)."""
    command = ["ffmpeg", "-loglevel", "error", "-i", str(path), "-f", "rawvideo"]
    raw = subprocess.run([*command, "-pix_fmt", "rgb24", "-"], capture_output=True, check=True)
    return np.frombuffer(raw.stdout, np.uint8).reshape(-1, HEIGHT, WIDTH, 3)


def fill(film: Film) -> None:
    """More frames than fit into a pipe."""
    with film:
        for frame in range(200):
            film.add(plain(frame), frame / 25.0)


def test_a_film_runs_in_simulated_time() -> None:
    pace = Pace(25.0)
    stamps = [7.0, 7.04, 7.0801, 7.2, 7.2, 7.21, 7.24]
    assert [pace.frames_until(stamp) for stamp in stamps] == [1, 1, 1, 3, 0, 0, 1]
    assert pace.written == 7


def test_at_thirty_a_second_pictures_come_every_33_or_34_steps() -> None:
    pace = Pace(30.0)
    assert [pace.frames_until(np.ceil(k * 1000 / 30) / 1000) for k in range(300)] == [1] * 300


def test_a_film_continues_after_a_reset() -> None:
    pace = Pace(10.0)
    assert [pace.frames_until(stamp) for stamp in (5.0, 5.1, 0.1, 0.2, 0.3)] == [1] * 5


def test_frames_are_what_was_shown(tmp_path: Path) -> None:
    path = tmp_path / "film.mp4"
    with Film(path, WIDTH, HEIGHT, 20.0) as film:
        for level, stamp in ((40, 3.0), (90, 3.05), (140, 3.2), (190, 3.25)):
            film.add(plain(level), stamp)
        assert film.seconds == pytest.approx(6 / 20)
    assert film.missing == 2
    frames = decoded(path)
    levels = frames.mean(axis=(1, 2, 3))
    np.testing.assert_allclose(levels, [40, 90, 90, 90, 140, 190], atol=4)
    asked = ["-v", "error", "-select_streams", "v", "-show_entries", "stream=r_frame_rate"]
    command = ["ffprobe", *asked, "-of", "csv=p=0", str(path)]
    rate = subprocess.run(command, capture_output=True, text=True, check=True)
    assert rate.stdout.strip() == "20/1"


def test_a_film_is_no_longer_than_asked_whatever_is_missing(tmp_path: Path) -> None:
    path = tmp_path / "film.mp4"
    with Film(path, WIDTH, HEIGHT, 20.0, 0.25) as film:
        film.add(plain(40), 1.0)
        film.add(plain(90), 1.05)
        assert not film.is_full
        film.add(plain(200), 9.0)
        assert film.is_full
        film.add(plain(200), 9.05)
        assert film.seconds == pytest.approx(0.25)
    assert film.missing == 3
    np.testing.assert_allclose(decoded(path).mean(axis=(1, 2, 3)), [40, 90, 90, 90, 90], atol=4)


@pytest.mark.parametrize(("length_s", "frames"), [(0.001, 1), (0.8, 20), (0.81, 20), (0.83, 21)])
def test_the_length_is_that_of_whole_frames(tmp_path: Path, length_s: float, frames: int) -> None:
    with Film(tmp_path / "film.mp4", WIDTH, HEIGHT, 25.0, length_s) as film:
        for frame in range(frames):
            assert not film.is_full
            film.add(plain(0), 0.04 * frame)
        assert film.is_full


def test_what_cannot_be_filmed_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "film.mp4"
    with pytest.raises(EvalError, match="--size: width 63 pixels, legal for a film: an even"):
        Film(path, 63, HEIGHT, 25.0)
    with pytest.raises(EvalError, match="--fps 0, legal: 1 to 240"):
        Film(path, WIDTH, HEIGHT, 0.0)
    with (
        pytest.raises(EvalError, match=r"picture of shape \(2, 2, 3\)"),
        Film(path, WIDTH, HEIGHT, 25.0) as film,
    ):
        film.add(np.zeros((2, 2, 3), np.uint8), 0.0)
    lost = Film(tmp_path / "none" / "film.mp4", WIDTH, HEIGHT, 25.0)
    with pytest.raises(EvalError, match=r"film.mp4: ffmpeg ended with exit code \d+: .*No such"):
        fill(lost)


def test_a_machine_without_ffmpeg_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    with pytest.raises(EvalError, match=r"film.mp4: films need ffmpeg, which is not installed"):
        Film(Path("film.mp4"), WIDTH, HEIGHT, 25.0)
