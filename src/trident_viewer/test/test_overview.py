# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest
from trident_eval.core.errors import EvalError
from trident_viewer.framing import Lens, Sphere, frame

pytest.importorskip("rospy", reason="ROS is not installed")

from PIL import Image as Picture
from sensor_msgs.msg import Image
from trident_viewer.census import Body, radius_of
from trident_viewer.names import write_names
from trident_viewer.overview import what_to_show
from trident_viewer.scout import depth_problem

LENS = Lens(400, 250, math.radians(60.0))


def test_the_size_of_a_vehicle_follows_from_its_links() -> None:
    body = Body(0.0, 1.5, (0.0348, 0.0459, 0.0977))
    rotor = Body(0.215, 0.05, (1e-6, 4e-5, 4e-5))
    sensor = Body(0.0, 1e-5, (1e-5, 1e-5, 1e-5))  # as RotorS gives its sensors
    assert 0.25 < radius_of([body, rotor, sensor]) < 0.45
    assert radius_of([body, sensor]) == radius_of([body])


@pytest.mark.parametrize("bodies", [[], [Body(0.0, 0.0, (0.0, 0.0, 0.0))]])
def test_what_has_no_size_is_small(bodies: list[Body]) -> None:
    assert radius_of(bodies) == pytest.approx(0.12)


def test_a_boat_is_as_large_as_its_hull() -> None:
    x, y, z, mass = 5.0, 2.4, 1.3, 180.0
    moments = (
        mass / 12 * (y * y + z * z),
        mass / 12 * (x * x + z * z),
        mass / 12 * (x * x + y * y),
    )
    assert 1.5 < radius_of([Body(0.0, mass, moments)]) < 3.0


def test_robots_come_before_what_floats_and_that_before_the_scenery() -> None:
    robot = Sphere("robot", (0.0, 0.0, 0.0), 0.3, has_joints=True)
    lost = Sphere("lost", (0.0, 0.0, -1e6), 0.3, has_joints=True)
    other = Sphere("other", (1.0, 0.0, 0.0), 0.3, has_joints=True)
    buoy = Sphere("buoy", (40.0, 0.0, 0.0), 0.3)
    house = Sphere("house", (5.0, 0.0, 0.0), 1.0, moves=False)
    assert what_to_show([robot, other, lost, buoy, house]) == [robot, other]
    assert what_to_show([buoy, house]) == [buoy]
    assert what_to_show([house]) == [house]
    with pytest.raises(EvalError, match="the world is empty"):
        what_to_show([])


def test_names_are_written_above_what_is_in_the_picture() -> None:
    fleet = [Sphere(f"UAV{i}", (0.0, 2.0 * i, 1.0), 0.3) for i in range(3)]
    stand = frame(fleet, LENS, 0.0, 0.3)
    behind = Sphere(
        "behind", tuple(2 * p - t for p, t in zip(stand.place, stand.target, strict=True)), 0.3
    )
    picture = Picture.new("RGB", (LENS.width, LENS.height), (60, 60, 60))
    assert write_names(picture, stand, LENS, [*fleet, behind]) == ["UAV0", "UAV1", "UAV2"]
    pixels = np.asarray(picture)
    assert (pixels > 150).all(axis=-1).mean() > 0.01, "paper"
    assert (pixels < 40).all(axis=-1).any(), "ink"
    assert write_names(picture, stand, LENS, []) == []


def depths(**fields: object) -> Image:
    image = Image(encoding="32FC1", width=4, height=3, step=16, data=b"\0" * 48)
    for name, value in fields.items():
        setattr(image, name, value)
    return image


def test_depths_of_a_camera_are_taken() -> None:
    assert depth_problem(depths(), Lens(4, 3, 1.0)) == ""
    assert depth_problem(depths(step=20, data=b"\0" * 60), Lens(4, 3, 1.0)) == ""


@pytest.mark.parametrize(
    "fields",
    [
        {"encoding": "rgb8"},
        {"is_bigendian": 1},
        {"width": 2**32 - 1},
        {"height": 0},
        {"step": 17, "data": b"\0" * 51},
        {"step": 0},
        {"data": b""},
        {"data": b"\0" * 47},
    ],
)
def test_what_is_no_depths_of_that_camera_is_refused(fields: dict[str, object]) -> None:
    assert "legal: " in depth_problem(depths(**fields), Lens(4, 3, 1.0))
