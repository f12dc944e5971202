# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Where a UAV may be: above a polygon, between two heights."""

from __future__ import annotations

import heapq
import math
from dataclasses import dataclass

import numpy as np

from trident_fleet.core.errors import FormationError
from trident_fleet.core.quintic import Array

_LEGAL = "3 or more corners [x, y] of a polygon whose sides do not cross"
_SMALLEST_M2 = 1.0
_TURN_RADII = (1.6, 2.5)  # of the margin, at which paths turn around a corner
_THIN_M = 0.05
_PUSHES = 8
_ROUNDING_M = 1e-9


@dataclass(frozen=True)
class Fence:
    """A polygon times a range of heights.

    Attributes:
        corners: of the polygon, in either direction [m, world], shape (K, 2).
        lowest_m: height [m, world].
        highest_m: height [m, world].
    """

    corners: Array
    lowest_m: float
    highest_m: float

    def validate(self) -> None:
        """Raise FormationError if it is no polygon, or has no height."""
        if not self._is_polygon():
            raise FormationError(f"fence: {self.corners.tolist()}; legal: {_LEGAL}")
        if not math.isfinite(self.highest_m - self.lowest_m) or self.highest_m <= self.lowest_m:
            raise FormationError(
                f"highest: {self.highest_m:g} m; legal: above lowest, {self.lowest_m:g} m"
            )

    def _is_polygon(self) -> bool:
        """Whether there are three finite corners or more, around an area, with no side crossed."""
        shape = self.corners.shape
        if len(shape) != 2 or shape[1] != 2 or shape[0] < 3 or not np.isfinite(self.corners).all():
            return False
        too_small = abs(self._doubled_area()) < 2.0 * _SMALLEST_M2
        return not too_small and not self._crosses_itself()

    def _doubled_area(self) -> float:
        x, y = self.corners.T
        return float(x @ np.roll(y, -1) - y @ np.roll(x, -1))

    def _crosses_itself(self) -> bool:
        begin, end = self._sides()
        count = len(begin)
        for i in range(count):
            for j in range(i + 2, count):
                if i == 0 and j == count - 1:
                    continue  # neighbours
                if _segment_distance(begin[i], end[i], begin[j : j + 1], end[j : j + 1])[0] == 0.0:
                    return True
        return False

    def clearance(self, points: Array) -> Array:
        """Distance of points [m, world], shape (N, 3), to the fence's faces [m], shape (N,).

        Negative outside: how far, in the horizontal or in height, at least.
        """
        flat = np.asarray(points, dtype=np.float64)
        side = _distances(flat[:, :2], *self._sides())
        across = np.where(self._is_above(flat[:, :2]), 1.0, -1.0) * side.min(axis=1)
        height = np.minimum(flat[:, 2] - self.lowest_m, self.highest_m - flat[:, 2])
        return np.asarray(np.minimum(across, height))

    def _sides(self) -> tuple[Array, Array]:
        """Begin and end of each side, shape (K, 2)."""
        return self.corners, np.roll(self.corners, -1, axis=0)

    def _is_above(self, points: Array) -> Array:
        """Whether points, shape (N, 2), lie in the polygon (crossings of a ray along x)."""
        begin, end = self._sides()
        x, y = points[:, :1], points[:, 1:]
        rise = end[:, 1] - begin[:, 1]
        share = (y - begin[:, 1]) / np.where(rise == 0.0, 1.0, rise)
        straddles = (begin[:, 1] > y) != (end[:, 1] > y)
        is_left = x < begin[:, 0] + share * (end[:, 0] - begin[:, 0])
        return np.asarray((straddles & is_left).sum(axis=1) % 2 == 1)

    def path_clearance(self, points: Array) -> float:
        """Smallest distance of a polyline, shape (N, 3), to the fence's faces; negative: leaves it.

        What lies within the convex hull of three points whose polyline, closed, keeps a distance
        keeps it, too: a polygon has no holes.
        """
        least = float(self.clearance(points).min())
        if least <= 0.0 or len(points) < 2:
            return least
        begin, end = self._sides()
        for a, b in zip(points[:-1, :2], points[1:, :2], strict=True):
            nearest = float(_segment_distance(a, b, begin, end).min())
            if nearest == 0.0:
                return -_THIN_M  # It crosses a side, and comes back.
            least = min(least, nearest)
        return least

    def nearest_inside(self, point: Array, margin_m: float) -> Array | None:
        """A place near a point over the polygon, shape (3,), that keeps a margin [m, world].

        None: no such place is near enough.
        """
        low, high = self.lowest_m + margin_m, self.highest_m - margin_m
        place = np.array([*point[:2], np.clip(point[2], low, high)])
        begin, end = self._sides()
        for _ in range(_PUSHES):
            if self.clearance(place[None])[0] >= margin_m - _ROUNDING_M:
                return place
            foot = _feet(place[None, :2], begin, end)[0]
            away = place[:2] - foot
            distance = np.hypot(*away.T)
            nearest = int(np.argmin(distance))
            if distance[nearest] == 0.0:
                return None
            place[:2] = foot[nearest] + away[nearest] * (margin_m / distance[nearest])
        return None

    def route(self, start: Array, goal: Array, margin_m: float) -> Array | None:
        """The shortest polyline from start to goal that keeps a distance to the fence's faces.

        Args:
            start: [m, world], shape (3,).
            goal: [m, world], shape (3,).
            margin_m: to be kept.

        Returns:
            Its points after the start, shape (N, 3), of which the last is the goal; None: no
            path leads there.
        """
        ends = np.stack([start, goal])
        if self.path_clearance(ends) >= margin_m:
            return ends[1:]
        if float(self.clearance(ends).min()) < margin_m:
            return None
        return self._around(ends, margin_m)

    def _around(self, ends: Array, margin_m: float) -> Array | None:
        """Dijkstra over the ends and the turns, those that see each other being neighbours."""
        turns = self._turns(margin_m)
        nodes = np.concatenate([ends[:, :2], turns])
        before, cost, reached = {0: 0}, {0: 0.0}, set()
        queue = [(0.0, 0)]
        while queue:
            length, node = heapq.heappop(queue)
            if node == 1:
                return self._lifted(nodes, before, ends)
            if node in reached:
                continue
            reached.add(node)
            for other in set(range(1, len(nodes))) - reached:
                longer = length + float(np.linalg.norm(nodes[other] - nodes[node]))
                if longer < cost.get(other, math.inf) and self._sees(nodes, node, other, margin_m):
                    cost[other], before[other] = longer, node
                    heapq.heappush(queue, (longer, other))
        return None

    def _sees(self, nodes: Array, one: int, other: int, margin_m: float) -> bool:
        middle = 0.5 * (self.lowest_m + self.highest_m)
        line = np.column_stack([nodes[[one, other]], [middle, middle]])
        half = 0.5 * (self.highest_m - self.lowest_m)
        return self.path_clearance(line) >= min(margin_m, half)

    def _turns(self, margin_m: float) -> Array:
        """Points near the corners around which a path may have to turn, shape (N, 2)."""
        back = _unit(np.roll(self.corners, 1, axis=0) - self.corners)
        ahead = _unit(np.roll(self.corners, -1, axis=0) - self.corners)
        across = ahead[:, 0] * back[:, 1] - ahead[:, 1] * back[:, 0]
        is_reflex = across * math.copysign(1.0, self._doubled_area()) < 0.0
        inward = _unit(-(back + ahead)[is_reflex])
        radii = [factor * max(margin_m, _THIN_M) for factor in _TURN_RADII]
        points = [self.corners[is_reflex] + radius * inward for radius in radii]
        return np.concatenate(points)

    @staticmethod
    def _lifted(nodes: Array, before: dict[int, int], ends: Array) -> Array:
        """The path to node 1 as points; the height changes evenly along it."""
        order = [1]
        while order[-1] != 0:
            order.append(before[order[-1]])
        flat = nodes[order[::-1]]
        along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(flat, axis=0), axis=1))])
        height = np.interp(along, [0.0, along[-1]], ends[:, 2])
        return np.column_stack([flat, height])[1:]


def _unit(vectors: Array) -> Array:
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12))


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def _distances(points: Array, begin: Array, end: Array) -> Array:
    """Of points, shape (N, 2), to segments, shape (K, 2) each [m], shape (N, K)."""
    away = points[:, None] - _feet(points, begin, end)
    return np.asarray(np.hypot(away[..., 0], away[..., 1]))


def _feet(points: Array, begin: Array, end: Array) -> Array:
    """The nearest place of each segment to each point, shape (N, K, 2)."""
    along = end - begin
    length2 = np.maximum((along * along).sum(axis=1), 1e-18)
    share = ((points[:, None] - begin) * along).sum(axis=-1) / length2
    return np.asarray(begin + np.clip(share, 0.0, 1.0)[..., None] * along)


def _segment_distance(a: Array, b: Array, begin: Array, end: Array) -> Array:
    """Of the segment from a to b to segments, shape (K, 2) each [m], shape (K,); 0: they cross."""
    own, theirs = b - a, end - begin
    sides = _cross(own, begin - a) * _cross(own, end - a)
    others = _cross(theirs, a - begin) * _cross(theirs, b - begin)
    own_ends = _distances(np.stack([a, b]), begin, end).min(axis=0)
    their_ends = _distances(np.concatenate([begin, end]), a[None], b[None])
    nearest = np.minimum(own_ends, their_ends.reshape(2, -1).min(axis=0))
    return np.asarray(np.where((sides < 0.0) & (others < 0.0), 0.0, nearest))
