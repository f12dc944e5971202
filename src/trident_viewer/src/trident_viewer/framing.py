# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Where a camera has to stand so that everything of interest is in its picture."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from trident_eval.core.tracks import Array

_MARGIN = 1.12  # of the picture around what is shown
_MIN_WIDTH_M = 3.2  # that the picture shows
_MIN_WIDTH_RADII = 8.0
_GROUND_M = 0.1  # is no more uneven than this, for what stands out of it
_LOWEST_M = 0.3  # of the camera above the lowest thing shown


@dataclass(frozen=True)
class Sphere:
    """Something of interest.

    Attributes:
        name: of the model.
        center: p_world [m].
        radius_m: of a sphere that holds it.
        moves: whether it is no part of the scenery.
        has_joints: whether it has moving parts, as robots do.
    """

    name: str
    center: tuple[float, float, float]
    radius_m: float
    moves: bool = True
    has_joints: bool = False


@dataclass(frozen=True)
class Lens:
    """A pinhole camera: pixels and horizontal field of view [rad]."""

    width: int
    height: int
    fov_rad: float

    @property
    def tangents(self) -> tuple[float, float]:
        """Half the width and half the height of the picture, a metre in front of the camera."""
        across = math.tan(self.fov_rad / 2.0)
        return across, across * self.height / self.width


@dataclass(frozen=True)
class Stand:
    """A camera's place and what it looks at [m, world]; upright."""

    place: tuple[float, float, float]
    target: tuple[float, float, float]

    def axes(self) -> Array:
        """Rows: ahead, left and up of the camera in the world, shape (3, 3)."""
        ahead = np.subtract(self.target, self.place)
        ahead = ahead / np.linalg.norm(ahead)
        left = np.cross([0.0, 0.0, 1.0], ahead)
        left = left / np.linalg.norm(left)
        return np.array([ahead, left, np.cross(ahead, left)])

    @property
    def yaw_pitch_rad(self) -> tuple[float, float]:
        """Heading, and how far it looks down [rad]."""
        dx, dy, dz = np.subtract(self.target, self.place)
        return math.atan2(dy, dx), math.atan2(-dz, math.hypot(dx, dy))


def project(stand: Stand, lens: Lens, points: Array) -> tuple[Array, Array]:
    """Where points are in the picture.

    Args:
        stand: of the camera.
        lens: of the camera.
        points: p_world, shape (N, 3) [m].

    Returns:
        Column and row of each, shape (N, 2) [pixels], and how far ahead of the camera it lies,
        shape (N,) [m]; behind the camera that is negative, and the pixel means nothing.
    """
    seen = (points - np.array(stand.place)) @ stand.axes().T
    ahead = np.where(np.abs(seen[:, 0]) > 1e-9, seen[:, 0], 1e-9)
    scale = lens.width / 2.0 / lens.tangents[0]
    column = lens.width / 2.0 - scale * seen[:, 1] / ahead
    row = lens.height / 2.0 - scale * seen[:, 2] / ahead
    return np.column_stack([column, row]), np.asarray(seen[:, 0])


def frame(spheres: Sequence[Sphere], lens: Lens, yaw_rad: float, down_rad: float) -> Stand:
    """The nearest place from which all of some spheres are in the picture.

    Args:
        spheres: one or more.
        lens: of the camera.
        yaw_rad: heading of the camera.
        down_rad: how far it looks down, less than a right angle.
    """
    centers = np.array([sphere.center for sphere in spheres])
    radii = np.array([sphere.radius_m for sphere in spheres])
    low, high = (centers - radii[:, None]).min(axis=0), (centers + radii[:, None]).max(axis=0)
    target = (low + high) / 2.0
    ahead = np.array(
        [
            math.cos(yaw_rad) * math.cos(down_rad),
            math.sin(yaw_rad) * math.cos(down_rad),
            -math.sin(down_rad),
        ]
    )
    axes = Stand(tuple((-ahead).tolist()), (0.0, 0.0, 0.0)).axes()
    seen = (centers - target) @ axes.T
    away = 0.0
    for side, tangent in zip((1, 2), lens.tangents, strict=True):
        # A sphere touches the edge of the picture at its radius by the cosine of the half angle.
        reach = np.abs(seen[:, side]) + radii * math.hypot(1.0, tangent)
        away = max(away, float((_MARGIN * reach / tangent - seen[:, 0]).max()))
    least_width_m = max(_MIN_WIDTH_M, _MIN_WIDTH_RADII * float(radii.max()))
    away = max(away, least_width_m / 2.0 / lens.tangents[0])
    place = target - away * ahead
    place[2] = max(place[2], low[2] + _LOWEST_M)
    return Stand(tuple(place.tolist()), tuple(target.tolist()))


def all_inside(stand: Stand, lens: Lens, spheres: Sequence[Sphere]) -> bool:
    """Whether the centers of all spheres are in the picture."""
    pixels, ahead = project(stand, lens, np.array([sphere.center for sphere in spheres]))
    inside = (pixels >= 0.0).all(axis=1) & (pixels < [lens.width, lens.height]).all(axis=1)
    return bool((inside & (ahead > 0.0)).all())


def hidden(stand: Stand, lens: Lens, spheres: Sequence[Sphere], depth: Array) -> int:
    """How many spheres something stands in front of.

    Args:
        stand: of the camera.
        lens: of the camera; that of `depth`.
        spheres: looked for.
        depth: how far ahead of the camera each pixel is, shape (height, width) [m]; not finite
            where there is nothing.
    """
    pixels, ahead = project(stand, lens, np.array([sphere.center for sphere in spheres]))
    count = 0
    for sphere, (column, row), distance in zip(spheres, pixels, ahead, strict=True):
        x, y = int(column), int(row)
        if not (0 <= x < lens.width and 0 <= y < lens.height):
            count += 1
            continue
        around = depth[max(y - 1, 0) : y + 2, max(x - 1, 0) : x + 2]
        hits = around[np.isfinite(around)]
        count += bool(len(hits) and hits.max() < distance - 1.5 * sphere.radius_m)
    return count


def standing_out(stand: Stand, lens: Lens, depth: Array) -> Array:
    """What a camera that looks down sees above or below the ground, the most common height.

    Args:
        stand: of the camera.
        lens: of the camera.
        depth: how far ahead each pixel is, shape (height, width) [m]; not finite: nothing there.

    Returns:
        p_world of the pixels that are not ground, shape (N, 3) [m].
    """
    rows, columns = np.nonzero(np.isfinite(depth))
    if not len(rows):
        return np.empty((0, 3))
    ahead = depth[rows, columns].astype(np.float64)
    scale = lens.tangents[0] / (lens.width / 2.0)
    left = -(columns + 0.5 - lens.width / 2.0) * scale * ahead
    up = -(rows + 0.5 - lens.height / 2.0) * scale * ahead
    points = np.column_stack([ahead, left, up]) @ stand.axes() + np.array(stand.place)
    heights = points[:, 2]
    edges = np.arange(heights.min(), heights.max() + 2.0 * _GROUND_M, _GROUND_M)
    counts, _ = np.histogram(heights, edges)
    ground = edges[int(np.argmax(counts))] + 0.5 * _GROUND_M
    return np.asarray(points[np.abs(heights - ground) > _GROUND_M])


def place_labels(
    anchors: Array, sizes: Sequence[tuple[int, int]], lens: Lens
) -> list[tuple[int, int] | None]:
    """Where names go: above their anchors, moved up until they cover no other.

    Args:
        anchors: column and row that a name belongs to, shape (N, 2) [pixels], by importance.
        sizes: width and height of each name [pixels].
        lens: of the picture.

    Returns:
        Left and top of each [pixels]; None where there is no room, or nothing to be named.
    """
    taken: list[tuple[int, int, int, int]] = []
    places: list[tuple[int, int] | None] = []
    for (column, row), size in zip(anchors, sizes, strict=True):
        is_seen = 0 <= column < lens.width and 0 <= row < lens.height
        place = _free_place((column, row), size, lens, taken) if is_seen else None
        places.append(place)
        if place is not None:
            taken.append((*place, *size))
    return places


def _free_place(
    anchor: tuple[float, float],
    size: tuple[int, int],
    lens: Lens,
    taken: Sequence[tuple[int, int, int, int]],
) -> tuple[int, int] | None:
    (column, row), (width, height) = anchor, size
    left = min(max(round(column - width / 2), 0), lens.width - width)
    top = max(round(row) - height, 0)
    while top >= 0 and any(_overlap((left, top, width, height), box) for box in taken):
        top -= max(height // 2, 1)
    return (left, top) if top >= 0 else None


def _overlap(a: tuple[int, int, int, int], b: tuple[int, int, int, int]) -> bool:
    return all(a[i] < b[i] + b[i + 2] and b[i] < a[i] + a[i + 2] for i in (0, 1))
