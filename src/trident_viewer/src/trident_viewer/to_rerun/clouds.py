# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Points of scans and clouds, as arrays."""

from __future__ import annotations

from typing import Any

import matplotlib as mpl
import numpy as np
import numpy.typing as npt
from trident_eval.core.errors import EvalError

Points = npt.NDArray[np.float32]
Colors = npt.NDArray[np.uint8]

# By the numbers of sensor_msgs/PointField.
_TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}
_MAP = (255.0 * mpl.colormaps["viridis"](np.linspace(0.0, 1.0, 256))[:, :3]).astype(np.uint8)


def shaded(values: npt.NDArray[Any]) -> Colors | None:
    """Colors from the least to the greatest value.

    Args:
        values: shape (N,).

    Returns:
        Red, green, blue, shape (N, 3); None: all values are the same, or none is finite.
    """
    finite = np.isfinite(values)
    if not finite.any():
        return None
    low, high = float(values[finite].min()), float(values[finite].max())
    if low == high:
        return None
    share = (np.where(finite, values, low) - low) / (high - low)
    return _MAP[np.round(255.0 * share).astype(np.uint8)]


def scan_points(scan: Any) -> tuple[Points, Colors | None]:
    """Where the beams of a sensor_msgs/LaserScan ended.

    Returns:
        Points in the frame of the scan [m], shape (N, 3): those within its least and greatest
        range; their colors by intensity, shape (N, 3), if it has any.
    """
    ranges = np.asarray(scan.ranges, np.float64)
    angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
    with np.errstate(invalid="ignore"):
        hit = np.isfinite(ranges) & (ranges >= scan.range_min) & (ranges <= scan.range_max)
    r, a = ranges[hit], angles[hit]
    points = np.stack([r * np.cos(a), r * np.sin(a), np.zeros_like(r)], axis=1)
    intensities = np.asarray(scan.intensities, np.float64)
    colors = shaded(intensities[hit]) if len(intensities) == len(ranges) else None
    return points.astype(np.float32), colors


def cloud_points(cloud: Any) -> tuple[Points, Colors | None]:
    """The points of a sensor_msgs/PointCloud2.

    Returns:
        Points in the frame of the cloud [m], shape (N, 3), without those that are not finite;
        their colors, shape (N, 3), by the field rgb or rgba, or else by intensity.

    Raises:
        EvalError: it has no x, y, z, or is shorter than it says.
    """
    records = _records(cloud)
    names = records.dtype.names or ()
    if not {"x", "y", "z"} <= set(names):
        raise EvalError(f"cloud of fields {', '.join(names) or 'none'}, legal: x, y, z and others")
    points = np.stack([records[name] for name in ("x", "y", "z")], axis=1).astype(np.float32)
    finite = np.isfinite(points).all(axis=1)
    return points[finite], _colors(records[finite])


def _colors(records: npt.NDArray[Any]) -> Colors | None:
    names = records.dtype.names or ()
    for name in ("rgb", "rgba"):
        if name in names:  # 0x00RRGGBB, in the bits of a float for historical reasons
            packed = np.ascontiguousarray(records[name]).view(np.uint32)
            channels = [(packed >> shift) & 255 for shift in (16, 8, 0)]
            return np.stack(channels, axis=1).astype(np.uint8)
    return shaded(records["intensity"].astype(np.float64)) if "intensity" in names else None


def _records(cloud: Any) -> npt.NDArray[Any]:
    """One record a point, shape (height * width,); padding at the ends of rows is skipped."""
    data = np.frombuffer(cloud.data, np.uint8)
    if len(data) < cloud.height * cloud.row_step or cloud.row_step < cloud.width * cloud.point_step:
        raise EvalError(
            f"cloud of {len(data)} bytes, legal: {cloud.height} rows of {cloud.row_step} bytes, "
            f"each of {cloud.width} points of {cloud.point_step} bytes"
        )
    rows = data[: cloud.height * cloud.row_step].reshape(cloud.height, cloud.row_step)
    packed = np.ascontiguousarray(rows[:, : cloud.width * cloud.point_step])
    return packed.reshape(-1).view(_record_type(cloud))


def _record_type(cloud: Any) -> np.dtype[Any]:
    """The fields of a point that are single numbers."""
    order = ">" if cloud.is_bigendian else "<"
    fields = [field for field in cloud.fields if _is_number(field)]
    return np.dtype(
        {
            "names": [field.name for field in fields],
            "formats": [order + _TYPES[field.datatype] for field in fields],
            "offsets": [field.offset for field in fields],
            "itemsize": cloud.point_step,
        }
    )


def _is_number(field: Any) -> bool:
    return field.datatype in _TYPES and field.count == 1
