# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest
from trident_eval.core.errors import EvalError

pytest.importorskip("rospy", reason="ROS is not installed")

from sensor_msgs.msg import Image
from trident_viewer.observer_camera import View, WaitingPictures, pixels_of

from trident_viewer import observer


@pytest.mark.parametrize(
    ("place", "target"),
    [((5, 0, 2), (0, 0, 2)), ((1, 2, 3), (4, -1, 0)), ((0, 0, 9), (0, 0.001, 0))],
)
def test_it_looks_at_its_target_upright(
    place: tuple[float, float, float], target: tuple[float, float, float]
) -> None:
    x, y, z, w = View(place, target).orientation()
    ahead = np.array([1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)])
    left = np.array([2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)])
    wanted = np.subtract(target, place) / math.dist(place, target)
    np.testing.assert_allclose(ahead, wanted, atol=1e-12)
    assert left[2] == pytest.approx(0.0, abs=1e-12)
    assert x * x + y * y + z * z + w * w == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("view", "what"),
    [
        (View(width=0), "--size: width 0 pixels, legal: 16 to 4096"),
        (View(fov_rad=math.pi), "--fov: 180 deg, legal: 6 to 150 deg"),
        (View((1, 2, 3), (1, 2, 3)), "--at: legal: another place"),
        (View((math.nan, 0, 0)), "legal: finite numbers"),
    ],
)
def test_bad_views_are_refused(view: View, what: str) -> None:
    with pytest.raises(EvalError, match=what):
        view.validate()


def test_rows_of_an_image_may_be_padded() -> None:
    wanted = np.arange(2 * 3 * 3, dtype=np.uint8).reshape(2, 3, 3)
    rows = np.zeros((2, 12), np.uint8)
    rows[:, :9] = wanted.reshape(2, 9)
    message = Image(height=2, width=3, step=12, encoding="rgb8", data=rows.tobytes())
    np.testing.assert_array_equal(pixels_of(message), wanted)
    message.encoding = "mono8"
    with pytest.raises(EvalError, match="encoding 'mono8', legal: rgb8"):
        pixels_of(message)


def test_pictures_wait_until_their_bytes_are_too_many() -> None:
    waiting = WaitingPictures(100)
    with pytest.raises(IndexError):
        waiting.take()
    for number in range(1000):
        waiting.put(Image(height=number, data=b""))
    assert [waiting.take().height for _ in range(1000)] == list(range(1000)), "however many"
    for number in range(4):
        waiting.put(Image(height=number, data=bytes(40)))
    assert [waiting.take().height for _ in range(len(waiting))] == [2, 3], "the oldest are dropped"
    waiting.put(Image(height=7, data=bytes(1000)))
    assert waiting.take().height == 7, "one always fits"
    waiting.put(Image(data=bytes(60)))
    waiting.put(Image(data=bytes(40)))
    assert len(waiting) == 2, "what was taken does not count any more"


def test_the_camera_is_of_the_asked_size() -> None:
    text = View(width=320, height=200).sdf("eye")
    assert "<width>320</width><height>200</height>" in text
    assert observer._size("320x200") == (320, 200)
    with pytest.raises(EvalError, match="--size: 'big', legal: WIDTHxHEIGHT"):
        observer._size("big")


def test_a_followed_model_carries_the_camera() -> None:
    view = View((-1.5, 0, 0.25), (0, 0, 0), rate_hz=25, followed="a & b")
    text = view.sdf("eye")
    assert "<followed>a &amp; b</followed><offset>-1.5 0 0.25</offset>" in text
    assert "<update_rate>25</update_rate>" in text
    assert "libtrident_follow.so" not in View().sdf("eye")


@pytest.mark.parametrize(
    ("words", "what"),
    [
        (["--out", "film.avi"], "--out film.avi: suffix '.avi', legal: .png, .mp4"),
        (["--seconds", "0"], "--seconds 0 s, legal: more than 0"),
        (["--every", "nan"], "--every nan s, legal: more than 0"),
        (["--count", "0"], "--count 0, legal: 1 or more"),
        (["--out", "no/such/folder/film.mp4"], "its folder does not exist"),
    ],
)
def test_bad_options_are_refused(words: list[str], what: str) -> None:
    with pytest.raises(EvalError, match=what):
        observer._check(observer._parser().parse_args(words))
