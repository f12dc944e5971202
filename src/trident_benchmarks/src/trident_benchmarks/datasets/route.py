# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A path for a robot through every room of a world, planned on the world's true map."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
from scipy import ndimage
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra
from trident_eval.core.errors import EvalError

if TYPE_CHECKING:
    from trident_sim.occupancy import OccupancyMap

    from trident_sim import LaserScanSample

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]

_COARSE = 2  # cells of the map along the side of one of the planner
_CLEAR_M = 0.3  # about the robot's center
_ROOMY_M = 0.7  # clearance beyond which more is not preferred
_TIGHT_COST = 4.0  # of a metre without any clearance beyond the needed one
_STRAIGHT_M = 0.08  # by which the path may be cut


class Roads:
    """Free places of a map and the paths between them."""

    def __init__(self, grid: OccupancyMap) -> None:
        """Take from a true map where a robot has room.

        Args:
            grid: cut at all heights of the robot.

        Raises:
            EvalError: nowhere.
        """
        from trident_sim.occupancy import FREE

        clear = ndimage.distance_transform_edt(grid.cells == FREE) * grid.resolution
        side = _COARSE * grid.resolution
        clear = clear[::_COARSE, ::_COARSE]
        rows, columns = np.nonzero(clear > _CLEAR_M)
        if not len(rows):
            raise EvalError(f"the map has no place with {_CLEAR_M} m of room")
        cells = np.column_stack((columns, rows))
        self.places = cells * side + grid.resolution / 2 + np.array(grid.origin)
        self._graph = _neighbors(clear, rows, columns, side)

    def tour(self, seed: int, apart_m: float, most: int | None = None) -> Floats:
        """Waypoints that lead by every free place within some distance, and back to the begin.

        Args:
            seed: of where it begins; from there the nearest place not seen yet is always next.
            apart_m: every free place has a waypoint within this distance [m].
            most: of the places that are visited.

        Returns:
            x, y [m, world], shape (n, 2).
        """
        random = np.random.default_rng((seed, 4))
        stops = self._scattered(int(random.integers(len(self.places))), apart_m)
        here, path = stops[0], [stops[0]]
        left = set(stops[1:])
        for _ in range(len(left) if most is None else most):
            length, before = dijkstra(self._graph, indices=here, return_predecessors=True)
            reached = [stop for stop in left if np.isfinite(length[stop])]
            if not reached:
                break
            # Not always the nearest one, so that seeds take different paths.
            nearest = sorted(reached, key=lambda stop: float(length[stop]))[:2]
            here = int(random.choice(nearest))
            left.discard(here)
            path += steps_between(before, path[-1], here)
        _, before = dijkstra(self._graph, indices=here, return_predecessors=True)
        path += steps_between(before, here, stops[0])
        return straightened(self.places[path])

    def _scattered(self, first: int, apart_m: float) -> list[int]:
        """Farthest points, one after the other, of what can be reached from the first one."""
        length = dijkstra(self._graph, indices=first)
        nearest = np.where(np.isfinite(length), np.inf, 0.0)
        stops = [first]
        while True:
            offset = self.places - self.places[stops[-1]]
            nearest = np.minimum(nearest, np.linalg.norm(offset, axis=1))
            farthest = int(np.argmax(nearest))
            if nearest[farthest] < apart_m:
                return stops
            stops.append(farthest)


def _neighbors(clear: Floats, rows: Ints, columns: Ints, side: float) -> csr_array:
    """Costs between the eight neighbours of each place: metres, more where it is tight."""
    number = np.full(clear.shape, -1)
    number[rows, columns] = np.arange(len(rows))
    tight = np.clip((_ROOMY_M - clear) / (_ROOMY_M - _CLEAR_M), 0.0, 1.0)
    begin, end, cost = [], [], []
    for dy, dx in ((0, 1), (1, 0), (1, 1), (1, -1)):
        y, x = rows + dy, columns + dx
        is_inside = (y < clear.shape[0]) & (x >= 0) & (x < clear.shape[1])
        a = np.flatnonzero(is_inside)
        b = number[y[a], x[a]]
        a, b = a[b >= 0], b[b >= 0]
        mean = 0.5 * (tight[rows[a], columns[a]] + tight[rows[b], columns[b]])
        begin.append(a)
        end.append(b)
        cost.append(side * np.hypot(dx, dy) * (1.0 + _TIGHT_COST * mean))
    a, b, c = np.concatenate(begin), np.concatenate(end), np.concatenate(cost)
    size = (len(rows), len(rows))
    return csr_array((np.tile(c, 2), (np.concatenate((a, b)), np.concatenate((b, a)))), shape=size)


def grid_graph(rows: Ints, columns: Ints, shape: tuple[int, ...], side: float) -> csr_array:
    """Distances between the eight neighbours of each place.

    Args:
        rows: of the places in a grid.
        columns: of the places.
        shape: rows and columns of the grid.
        side: of its cells [m].
    """
    number = np.full(shape, -1)
    number[rows, columns] = np.arange(len(rows))
    begin, end, cost = [], [], []
    for dy, dx in ((0, 1), (1, 0), (1, 1), (1, -1)):
        y, x = rows + dy, columns + dx
        a = np.flatnonzero((y < shape[0]) & (x >= 0) & (x < shape[1]))
        b = number[y[a], x[a]]
        a, b = a[b >= 0], b[b >= 0]
        begin.append(a)
        end.append(b)
        cost.append(np.full(len(a), side * np.hypot(dx, dy)))
    a, b, c = np.concatenate(begin), np.concatenate(end), np.concatenate(cost)
    size = (len(rows), len(rows))
    return csr_array((np.tile(c, 2), (np.concatenate((a, b)), np.concatenate((b, a)))), shape=size)


def steps_between(before: npt.NDArray[np.int32], begin: int, end: int) -> list[int]:
    """From behind `begin` up to `end`."""
    path = []
    while end != begin:
        path.append(end)
        end = int(before[end])
    return path[::-1]


def straightened(points: Floats, tolerance_m: float = _STRAIGHT_M) -> Floats:
    """Fewer points of a path that no part is farther from than a tolerance.

    D. Douglas and T. Peucker, "Algorithms for the reduction of the number of points required to
    represent a digitized line or its caricature", Cartographica 10, 1973.
    """
    kept = np.zeros(len(points), bool)
    kept[[0, -1]] = True
    parts = [(0, len(points) - 1)]
    while parts:
        first, last = parts.pop()
        if last - first < 2:
            continue
        along = points[last] - points[first]
        offset = points[first + 1 : last] - points[first]
        share = np.clip(offset @ along / max(float(along @ along), 1e-12), 0.0, 1.0)
        away = np.linalg.norm(offset - share[:, None] * along, axis=1)
        worst = first + 1 + int(np.argmax(away))
        if away[worst - first - 1] > tolerance_m:
            kept[worst] = True
            parts += [(first, worst), (worst, last)]
    return points[kept]


class RoutePilot:
    """Drives along waypoints by the true pose: a tour is the same whatever sensors say."""

    _PERIOD_S = 0.05

    def __init__(self, waypoints: Sequence[Sequence[float]] | Floats, speed: float = 0.5) -> None:
        """Begin at the first waypoint.

        Args:
            waypoints: x, y [m, world], shape (n, 2).
            speed: on straights [m/s].
        """
        from trident_nav.core.waypoints import FollowerConfig, WaypointFollower

        config = FollowerConfig(speed=speed, tolerance=0.1)
        self._follower = WaypointFollower(np.asarray(waypoints).tolist(), config)
        self._next_s = 0.0

    @property
    def is_done(self) -> bool:
        """The last waypoint has been reached."""
        return self._follower.is_done

    def command(
        self, time_s: float, pose: Floats, scan: LaserScanSample | None
    ) -> tuple[float, float] | None:
        """As Pilot says."""
        del scan
        if time_s < self._next_s:
            return None
        self._next_s = time_s + self._PERIOD_S
        v, w = self._follower.command(time_s, (float(pose[0]), float(pose[1]), float(pose[2])))
        return v, w
