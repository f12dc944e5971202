# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Points of scans and clouds."""

from __future__ import annotations

import math
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from trident_eval.core.errors import EvalError
from trident_viewer.to_rerun.clouds import cloud_points, scan_points, shaded

pytest.importorskip("rospy", reason="ROS is not installed")

from sensor_msgs.msg import LaserScan, PointCloud2, PointField

NAN, INF = math.nan, math.inf


def scan(ranges: list[float], intensities: list[float] | None = None) -> LaserScan:
    return LaserScan(
        angle_min=-math.pi / 2,
        angle_increment=math.pi / 2,
        range_min=0.1,
        range_max=10.0,
        ranges=ranges,
        intensities=intensities or [],
    )


def cloud(points: list[tuple[float, ...]], names: str, *, order: str = "<") -> PointCloud2:
    """Of float32 fields, 4 bytes apart, rows padded by 8 bytes."""
    step = 4 * len(names)
    data = b"".join(struct.pack(f"{order}{len(names)}f", *point) for point in points)
    return PointCloud2(
        height=1,
        width=len(points),
        fields=[PointField(name, 4 * i, 7, 1) for i, name in enumerate(names)],
        is_bigendian=order == ">",
        point_step=step,
        row_step=len(data) + 8,
        data=data + b"\xff" * 8,
    )


def test_beams_end_where_they_hit_something() -> None:
    points, colors = scan_points(scan([1.0, 2.0, 3.0]))
    np.testing.assert_allclose(points, [[0, -1, 0], [2, 0, 0], [0, 3, 0]], atol=1e-6)
    assert colors is None


@pytest.mark.parametrize("nothing", [NAN, INF, -INF, 0.05, 10.1])
def test_beams_that_hit_nothing_are_dropped(nothing: float) -> None:
    points, colors = scan_points(scan([1.0, nothing, 3.0], [1.0, 500.0, 3.0]))
    np.testing.assert_allclose(points, [[0, -1, 0], [0, 3, 0]], atol=1e-6)
    assert colors is not None
    np.testing.assert_array_equal(colors, shaded(np.array([0.0, 1.0])), "of those that are left")


def test_the_least_intensity_is_dark_and_the_greatest_is_bright() -> None:
    colors = shaded(np.array([5.0, 9.0, 7.0, NAN]))
    assert colors is not None
    brightness = colors.astype(int).sum(axis=1)
    assert brightness[0] < brightness[2] < brightness[1]
    assert brightness[3] == brightness[0]
    assert shaded(np.array([2.0, 2.0])) is None
    assert shaded(np.array([NAN, INF])) is None
    assert shaded(np.array([])) is None


@given(st.lists(st.floats(width=32), min_size=1, max_size=40))
def test_no_scan_gives_a_point_that_is_not_finite(ranges: list[float]) -> None:
    points, _ = scan_points(scan(ranges))
    assert np.isfinite(points).all()
    assert len(points) == sum(0.1 <= r <= 10.0 for r in ranges)


@pytest.mark.parametrize("order", ["<", ">"])
def test_points_of_a_cloud(order: str) -> None:
    points, colors = cloud_points(
        cloud([(1, 2, 3, 10), (NAN, 0, 0, 50), (4, 5, 6, 20), (0, 0, INF, 90)], "xyzi", order=order)
    )
    np.testing.assert_array_equal(points, [[1, 2, 3], [4, 5, 6]])
    assert colors is None, "a field i is no intensity"


def test_a_cloud_is_colored_by_its_intensity() -> None:
    message = cloud([(1, 2, 3, 10), (NAN, 0, 0, 50), (4, 5, 6, 20)], "xyzi")
    message.fields[3].name = "intensity"
    points, colors = cloud_points(message)
    assert len(points) == 2
    np.testing.assert_array_equal(colors, shaded(np.array([0.0, 1.0])))


def test_a_cloud_with_colors_keeps_them() -> None:
    packed = struct.unpack("<f", bytes([30, 20, 10, 0]))[0]  # blue, green, red
    message = cloud([(1, 2, 3, packed)], "xyzc")
    message.fields[3].name = "rgb"
    _, colors = cloud_points(message)
    np.testing.assert_array_equal(colors, [[10, 20, 30]])


def test_a_cloud_that_contradicts_itself_is_refused() -> None:
    with pytest.raises(EvalError, match="cloud of fields x, y, legal: x, y, z and others"):
        cloud_points(cloud([(1, 2)], "xy"))
    message = cloud([(1, 2, 3)], "xyz")
    message.width = 9
    with pytest.raises(EvalError, match="cloud of 20 bytes, legal: 1 rows of 20 bytes, each of 9"):
        cloud_points(message)
    assert len(cloud_points(cloud([], "xyz"))[0]) == 0
