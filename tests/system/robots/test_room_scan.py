# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a robot's lidar says about a room whose walls are known."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt
import pytest
from harness import Launch, eventually, package, recorder
from sensor_msgs.msg import LaserScan

Array = npt.NDArray[np.float64]
Start = Callable[..., Launch]
SIGMA_M = 0.01
#: Above the floor [m]; the robot stands at the world's origin, its laser on its axis.
LASER_HEIGHT_M = 0.115


def boxes_at(height: float) -> list[tuple[Array, Array]]:
    """Corners in x and y of the room's boxes that a horizontal beam at a height can hit."""
    world = package("trident_bringup") / "worlds" / "room.world"
    found = []
    for model in ElementTree.parse(world).getroot().iter("model"):
        origin = np.array([float(x) for x in (model.findtext("pose") or "0 0 0 0 0 0").split()])
        for collision in model.iter("collision"):
            size_text = collision.findtext("geometry/box/size")
            if size_text is None:
                continue
            place = np.array([float(x) for x in (collision.findtext("pose") or "0 0 0").split()])
            center = origin[:3] + place[:3]
            half = np.array([float(x) for x in size_text.split()]) / 2.0
            if abs(height - center[2]) < half[2]:
                found.append(((center - half)[:2], (center + half)[:2]))
    assert len(found) >= 9, "four walls, an inner wall, four legs"
    return found


def distance(angle: float, boxes: list[tuple[Array, Array]]) -> float:
    """From the origin to the nearest box, by slabs."""
    direction = np.array([math.cos(angle), math.sin(angle)])
    best = math.inf
    with np.errstate(divide="ignore"):
        inverse = 1.0 / direction
    for low, high in boxes:
        near, far = np.sort([low * inverse, high * inverse], axis=0)
        if near.max() <= far.min() and near.max() > 0.0:
            best = min(best, float(near.max()))
    return best


def test_the_lidar_of_a_robot_sees_the_room(launch: Start) -> None:
    run = launch("trident_bringup", "robot_in_room.launch", paused=True).spawned("my_nav_robot")
    with recorder("/scan", LaserScan) as scans:
        run.step(2000)
        eventually(lambda: len(scans.messages) >= 10, "ten scans")
    scan = scans.messages[-1]
    assert scan.header.frame_id == "laser_link"
    assert len(scan.ranges) == 360
    assert scan.range_max == pytest.approx(12.0)
    stamps = [message.header.stamp.to_nsec() for message in scans.messages]
    assert {b - a for a, b in pairwise(stamps)} == {100_000_000}
    boxes = boxes_at(LASER_HEIGHT_M)
    angles = scan.angle_min + np.arange(360) * scan.angle_increment
    expected = np.array([distance(angle, boxes) for angle in angles])
    error = np.array(scan.ranges) - expected
    # A beam along an edge may pass it: the robot stands within a millimetre, not exactly.
    clear = np.abs(error) < 6.0 * SIGMA_M
    assert clear.mean() > 0.97
    assert abs(error[clear].mean()) < 4.0 * SIGMA_M / math.sqrt(360.0) + 2e-3
    assert error[clear].std() == pytest.approx(SIGMA_M, rel=0.25)
