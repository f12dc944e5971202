# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""ROS messages as what rerun shows: one function a type, without state."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import rerun as rr
from trident_eval.core.errors import EvalError

from trident_viewer.to_rerun.clouds import cloud_points, scan_points

_SCAN_COLOR = (220, 60, 40)
_CLOUD_COLOR = (120, 170, 220)
_PATH_COLOR = (40, 160, 60)
_TRAIL_COLOR = (240, 150, 40)
_POINT_M = 0.015
_LINE_M = 0.01
_IMAGE_PLANE_M = 0.5  # how far before a camera its picture stands
_COLOR_MODELS = {
    "rgb8": (rr.ColorModel.RGB, 3),
    "bgr8": (rr.ColorModel.BGR, 3),
    "rgba8": (rr.ColorModel.RGBA, 4),
    "bgra8": (rr.ColorModel.BGRA, 4),
    "mono8": (rr.ColorModel.L, 1),
    "8UC1": (rr.ColorModel.L, 1),
}
_LEVELS = {1: "DEBUG", 2: "INFO", 4: "WARN", 8: "ERROR", 16: "CRITICAL"}  # of rosgraph_msgs/Log
_UNKNOWN, _FREE, _OCCUPIED = 128, 254, 0  # shades of a map, as map_server draws them

Vector = npt.NDArray[np.float64]


def of_pose(pose: Any, axes_m: float = 0.0) -> rr.Transform3D:
    """A geometry_msgs/Pose, with its axes so long [m]."""
    p, q = pose.position, pose.orientation
    return rr.Transform3D(
        translation=[p.x, p.y, p.z],
        quaternion=rr.Quaternion(xyzw=[q.x, q.y, q.z, q.w]),
        axis_length=axes_m,
    )


def of_transform(transform: Any) -> rr.Transform3D:
    """A geometry_msgs/Transform, child in parent."""
    p, q = transform.translation, transform.rotation
    return rr.Transform3D(
        translation=[p.x, p.y, p.z], quaternion=rr.Quaternion(xyzw=[q.x, q.y, q.z, q.w])
    )


def of_scan(scan: Any) -> rr.Points3D:
    """A sensor_msgs/LaserScan."""
    points, colors = scan_points(scan)
    return rr.Points3D(points, colors=_SCAN_COLOR if colors is None else colors, radii=_POINT_M)


def of_cloud(cloud: Any) -> rr.Points3D:
    """A sensor_msgs/PointCloud2.

    Raises:
        EvalError: it has no x, y, z.
    """
    points, colors = cloud_points(cloud)
    return rr.Points3D(points, colors=_CLOUD_COLOR if colors is None else colors, radii=_POINT_M)


def of_image(image: Any) -> rr.Image | rr.DepthImage | rr.SegmentationImage:
    """A sensor_msgs/Image: color; depth (32FC1 [m], 16UC1 [mm]); labels (mono16).

    Raises:
        EvalError: another encoding, or fewer bytes than it says.
    """
    if image.encoding in _COLOR_MODELS:
        model, channels = _COLOR_MODELS[image.encoding]
        return rr.Image(
            bytes=_pixels(image, "u1", channels).tobytes(),
            width=image.width,
            height=image.height,
            color_model=model,
            datatype=rr.ChannelDatatype.U8,
        )
    if image.encoding == "32FC1":
        return rr.DepthImage(_pixels(image, "f4", 1)[..., 0], meter=1.0)
    if image.encoding == "16UC1":
        return rr.DepthImage(_pixels(image, "u2", 1)[..., 0], meter=1000.0)
    if image.encoding == "mono16":
        return rr.SegmentationImage(_pixels(image, "u2", 1)[..., 0])
    legal = ", ".join([*_COLOR_MODELS, "32FC1", "16UC1", "mono16"])
    raise EvalError(f"image of encoding '{image.encoding}', legal: {legal}")


def _pixels(image: Any, kind: str, channels: int) -> npt.NDArray[Any]:
    """Shape (height, width, channels); rows may be padded."""
    dtype = np.dtype((">" if image.is_bigendian else "<") + kind)
    wanted = image.width * channels * dtype.itemsize
    if image.step < wanted or len(image.data) < image.height * image.step:
        raise EvalError(
            f"image of {len(image.data)} bytes, legal: {image.height} rows of {image.step} bytes, "
            f"each at least {wanted}"
        )
    data = np.frombuffer(image.data, np.uint8, image.height * image.step)
    rows = np.ascontiguousarray(data.reshape(image.height, image.step)[:, :wanted])
    native = rows.view(dtype).astype(dtype.newbyteorder("="))
    return native.reshape(image.height, image.width, channels)


def of_camera_info(info: Any) -> rr.Pinhole | None:
    """A sensor_msgs/CameraInfo without its distortion; None: it is not calibrated (K is 0)."""
    K = np.asarray(info.K, np.float64).reshape(3, 3)
    if K[0, 0] <= 0.0 or K[1, 1] <= 0.0:
        return None
    return rr.Pinhole(
        image_from_camera=K,
        resolution=[info.width, info.height],
        camera_xyz=rr.ViewCoordinates.RDF,  # of an optical frame
        image_plane_distance=_IMAGE_PLANE_M,
    )


def of_grid(grid: Any) -> rr.Mesh3D:
    """A nav_msgs/OccupancyGrid as a picture that lies in its frame.

    Raises:
        EvalError: it has no cell, or another number of them than it says.
    """
    rows, columns = grid.info.height, grid.info.width
    cells = np.asarray(grid.data, np.int16)
    if rows * columns == 0 or len(cells) != rows * columns:
        raise EvalError(f"map of {len(cells)} cells, legal: {rows} x {columns}, at least one")
    corners = np.array([[0, 0, 0], [columns, 0, 0], [columns, rows, 0], [0, rows, 0]], np.float64)
    p, q = grid.info.origin.position, grid.info.origin.orientation
    placed = _rotated(np.array([q.x, q.y, q.z, q.w]), corners * grid.info.resolution)
    # The first row of a picture is its top, that of a map the one nearest to the origin.
    return rr.Mesh3D(
        vertex_positions=placed + np.array([p.x, p.y, p.z]),
        triangle_indices=[[0, 1, 2], [0, 2, 3]],
        vertex_texcoords=[[0, 1], [1, 1], [1, 0], [0, 0]],
        albedo_texture=map_picture(cells.reshape(rows, columns)),
    )


def map_picture(cells: npt.NDArray[np.int16]) -> npt.NDArray[np.uint8]:
    """Shades of a map, its last row on top.

    Args:
        cells: -1: unknown; else 0 to 100 % occupied, shape (rows, columns).

    Returns:
        Red, green, blue, shape (rows, columns, 3).
    """
    share = np.clip(cells, 0, 100) / 100.0
    shades = np.where(cells < 0, _UNKNOWN, np.round(_FREE + (_OCCUPIED - _FREE) * share))
    return np.repeat(shades.astype(np.uint8)[::-1, :, None], 3, axis=2)


def _rotated(q_xyzw: Vector, points: Vector) -> Vector:
    """Points turned by a quaternion, shape (N, 3); one of zeros turns nothing."""
    axis, w = q_xyzw[:3], q_xyzw[3]
    n = float(q_xyzw @ q_xyzw)
    if n == 0.0:
        return points
    across = 2.0 * np.cross(np.broadcast_to(axis, points.shape), points) / n
    return points + w * across + np.cross(np.broadcast_to(axis, points.shape), across)


def of_path(path: Any) -> rr.LineStrips3D:
    """A nav_msgs/Path."""
    places = [pose.pose.position for pose in path.poses]
    return _line(np.array([[p.x, p.y, p.z] for p in places]).reshape(-1, 3), _PATH_COLOR)


def of_trail(places: Vector) -> rr.LineStrips3D:
    """Where something has been [m], shape (N, 3)."""
    return _line(places, _TRAIL_COLOR)


def _line(places: Vector, color: tuple[int, int, int]) -> rr.LineStrips3D:
    return rr.LineStrips3D([places] if len(places) > 1 else [], colors=color, radii=_LINE_M)


def of_boxes(message: Any) -> rr.Boxes2D:
    """A trident_msgs/BoundingBoxes; both outermost pixels are inside."""
    boxes = message.boxes
    mins = np.array([[box.x_min, box.y_min] for box in boxes], np.float64).reshape(-1, 2)
    maxs = np.array([[box.x_max + 1, box.y_max + 1] for box in boxes], np.float64).reshape(-1, 2)
    return rr.Boxes2D(
        mins=mins,
        sizes=maxs - mins,
        labels=[box.name for box in boxes],
        class_ids=[box.label for box in boxes],
    )


def of_log(log: Any) -> rr.TextLog:
    """A rosgraph_msgs/Log."""
    return rr.TextLog(log.msg, level=_LEVELS.get(log.level, "INFO"))
