# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from trident_viewer.framing import (
    Lens,
    Sphere,
    Stand,
    all_inside,
    frame,
    hidden,
    place_labels,
    project,
    standing_out,
)

LENS = Lens(800, 500, math.radians(60.0))
FLEET = [Sphere(f"UAV{i}", (0.0, 1.6 * i, 1.0 + 0.2 * i), 0.35) for i in range(6)]


def test_the_target_is_in_the_middle_and_left_is_left() -> None:
    stand = Stand((0.0, 0.0, 0.0), (10.0, 0.0, 0.0))
    pixels, ahead = project(stand, LENS, np.array([[10.0, 0, 0], [10.0, 1, 0], [10.0, 0, 1]]))
    np.testing.assert_allclose(pixels[0], [400, 250])
    assert pixels[1, 0] < 400
    assert pixels[2, 1] < 250
    np.testing.assert_allclose(ahead, 10.0)
    edge = 10.0 * math.tan(math.radians(30.0))
    pixels, _ = project(stand, LENS, np.array([[10.0, edge, 0.0]]))
    assert pixels[0, 0] == pytest.approx(0.0, abs=1e-9)


positions = st.tuples(*(st.floats(-50.0, 50.0) for _ in range(3)))


@given(
    places=st.lists(positions, min_size=1, max_size=8),
    radius=st.floats(0.05, 5.0),
    yaw_deg=st.floats(-180.0, 180.0),
    down_deg=st.floats(5.0, 89.0),
)
def test_everything_is_in_the_picture_whole(
    places: list[tuple[float, float, float]], radius: float, yaw_deg: float, down_deg: float
) -> None:
    spheres = [Sphere("m", place, radius) for place in places]
    stand = frame(spheres, LENS, math.radians(yaw_deg), math.radians(down_deg))
    assert all_inside(stand, LENS, spheres)
    axes = stand.axes()
    for sphere in spheres:
        rim = np.array(sphere.center) + radius * np.concatenate([axes, -axes])
        pixels, ahead = project(stand, LENS, rim)
        assert (ahead > 0.0).all()
        assert (pixels >= 0.0).all()
        assert (pixels <= [LENS.width, LENS.height]).all()


def test_a_lone_vehicle_is_no_dot_and_does_not_fill_the_picture() -> None:
    vehicle = Sphere("firefly", (0.0, 0.0, 1.0), 0.38)
    stand = frame([vehicle], LENS, 1.0, 0.5)
    rim = np.array(vehicle.center) + 0.38 * np.array([stand.axes()[1], -stand.axes()[1]])
    pixels, _ = project(stand, LENS, rim)
    assert 0.15 < (pixels[1, 0] - pixels[0, 0]) / LENS.width < 0.4


def test_the_camera_stays_above_the_ground() -> None:
    stand = frame([Sphere("far", (100.0, 0.0, 0.2), 0.2)], LENS, 0.0, -0.5)
    assert stand.place[2] >= 0.3


def test_what_stands_before_a_vehicle_hides_it() -> None:
    stand = frame(FLEET, LENS, math.radians(30.0), math.radians(30.0))
    free = np.full((LENS.height, LENS.width), np.inf)
    assert hidden(stand, LENS, FLEET, free) == 0
    pixels, ahead = project(stand, LENS, np.array([sphere.center for sphere in FLEET]))
    wall = free.copy()
    column, row = (int(value) for value in pixels[2])
    wall[row - 2 : row + 3, column - 2 : column + 3] = ahead[2] - 1.0
    assert hidden(stand, LENS, FLEET, wall) == 1
    wall[row - 2 : row + 3, column - 2 : column + 3] = ahead[2] - 0.3  # its own shape
    assert hidden(stand, LENS, FLEET, wall) == 0
    away = Stand(stand.target, stand.place)
    assert hidden(away, LENS, FLEET, free) == len(FLEET)


def test_what_stands_out_of_the_ground_is_found_from_above() -> None:
    lens = Lens(60, 60, math.radians(60.0))
    stand = Stand((2.0, -0.01, 10.0), (2.0, 0.0, 0.0))
    depth = np.full((60, 60), 10.0, np.float32)
    depth[10:20, 40:50] = 8.0  # a roof
    depth[50:, :5] = np.nan
    found = standing_out(stand, lens, depth)
    assert len(found) == 100
    np.testing.assert_allclose(found[:, 2], 2.0, atol=0.02)
    assert (found[:, 0] > 2.0).all()  # right is +x where up is +y
    assert (found[:, 1] > 0.0).all()
    assert len(standing_out(stand, lens, np.full((60, 60), np.nan, np.float32))) == 0


def test_names_do_not_cover_each_other() -> None:
    anchors = np.array([[100.0, 200.0], [105.0, 203.0], [110.0, 199.0], [900.0, 10.0], [2.0, 3.0]])
    places = place_labels(anchors, [(60, 20)] * 5, LENS)
    assert places[0] == (70, 180)
    assert places[3] is None
    assert places[4] == (0, 0)
    boxes = [place for place in places if place is not None]
    for i, (left, top) in enumerate(boxes):
        for other_left, other_top in boxes[:i]:
            assert abs(left - other_left) >= 60 or abs(top - other_top) >= 20


def test_a_name_without_room_is_left_out() -> None:
    anchors = np.array([[100.0, 30.0]] * 3)
    assert place_labels(anchors, [(60, 20)] * 3, LENS)[1:] == [None, None]
