# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Random goals in the free places of a world, and what a drive to each is judged by."""

from __future__ import annotations

import itertools
import math
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
from scipy import ndimage
from scipy.sparse.csgraph import dijkstra
from trident_eval.core.errors import EvalError

from trident_benchmarks.datasets.route import grid_graph, steps_between
from trident_benchmarks.nav.limits import RobotLimits

if TYPE_CHECKING:
    from trident_sim.occupancy import OccupancyMap

Floats = npt.NDArray[np.float64]
Pose = tuple[float, float, float]  # x, y [m, world], yaw [rad]


@dataclass(frozen=True)
class Route:
    """A shortest path between two places.

    Attributes:
        length_m: of it.
        leaves_rad: the direction in which it begins.
        arrives_rad: the direction in which it ends.
    """

    length_m: float
    leaves_rad: float
    arrives_rad: float


class Places:
    """Where a robot of a size has room in a true map."""

    def __init__(self, grid: OccupancyMap, inscribed_m: float, circumscribed_m: float) -> None:
        """Find them.

        Args:
            grid: cut at the heights of the robot.
            inscribed_m: radius of what fits wherever the robot passes.
            circumscribed_m: radius of what must be free about a goal.

        Raises:
            EvalError: there is no such place.
        """
        from trident_sim.occupancy import FREE

        self._grid = grid
        self._inscribed_m = inscribed_m
        cells, self._obstacles = ndimage.distance_transform_edt(
            grid.cells == FREE, return_indices=True
        )
        self._clear_m = cells * grid.resolution
        rows, columns = np.nonzero(self._clear_m > inscribed_m)
        if not len(rows):
            raise EvalError(f"the map has no place with {inscribed_m:g} m of room")
        self._points = (np.column_stack((columns, rows)) + 0.5) * grid.resolution + grid.origin
        self._roomy = np.flatnonzero(self._clear_m[rows, columns] > circumscribed_m)
        self._graph = grid_graph(rows, columns, self._clear_m.shape, grid.resolution)

    def clearance(self, x: float, y: float) -> float:
        """From a point to the nearest cell that is not free [m]; 0 in such a cell and outside."""
        at = (np.array([x, y]) - self._grid.origin) / self._grid.resolution
        column, row = (math.floor(value) for value in at)
        rows, columns = self._clear_m.shape
        if not (0 <= row < rows and 0 <= column < columns):
            return 0.0
        lowest = self._obstacles[::-1, row, column]  # column and row of that cell
        offset = at - np.clip(at, lowest, lowest + 1.0)
        return float(np.hypot(*offset)) * self._grid.resolution

    def goal(self, random: np.random.Generator, start: Pose, least_m: float) -> tuple[Pose, Route]:
        """A random goal that can be reached, and the shortest path to it.

        Args:
            random: of the choice.
            start: where the robot is.
            least_m: of the path from cell to cell [m].

        Returns:
            The goal, and the path there.

        Raises:
            EvalError: no place is that far away.
        """
        nearest = int(np.argmin(np.linalg.norm(self._points - start[:2], axis=1)))
        lengths, before = dijkstra(self._graph, indices=nearest, return_predecessors=True)
        length = lengths[self._roomy]
        choice = np.flatnonzero(np.isfinite(length) & (length >= least_m))
        if not len(choice):
            raise EvalError(f"no free place can be reached that is {least_m:g} m away")
        chosen = int(self._roomy[int(random.choice(choice))])
        x, y = self._points[chosen]
        yaw = float(random.uniform(-math.pi, math.pi))
        stops = [nearest, *steps_between(before, nearest, chosen)]
        return (float(x), float(y), yaw), self._route(self._points[stops])

    def _route(self, points: Floats) -> Route:
        """A path from cell to cell, pulled tight from both ends."""
        points = self._pulled(self._pulled(points)[::-1])[::-1]
        legs = np.diff(points, axis=0)
        first, last = (float(np.arctan2(leg[1], leg[0])) for leg in (legs[0], legs[-1]))
        return Route(float(np.linalg.norm(legs, axis=1).sum()), first, last)

    def _pulled(self, points: Floats) -> Floats:
        """From each point on straight to the farthest one that is seen from there."""
        fine = _densified(points, self._grid.resolution)
        kept = [0]
        while kept[-1] < len(fine) - 1:
            seen = kept[-1] + 1
            while seen + 1 < len(fine) and self._is_open(fine[kept[-1]], fine[seen + 1]):
                seen += 1
            kept.append(seen)
        return fine[kept]

    def _is_open(self, begin: Floats, end: Floats) -> bool:
        """Whether the inscribed circle passes straight from one point to another."""
        count = 2 + int(np.linalg.norm(end - begin) / (0.5 * self._grid.resolution))
        on_line = begin + np.linspace(0.0, 1.0, count)[:, None] * (end - begin)
        cells = np.floor((on_line - self._grid.origin) / self._grid.resolution).astype(int)
        return bool(np.all(self._clear_m[cells[:, 1], cells[:, 0]] > self._inscribed_m))


def _densified(points: Floats, apart_m: float) -> Floats:
    """The same path with more points on its legs."""
    parts = [points[:1]]
    for begin, end in itertools.pairwise(points):
        count = 1 + int(np.linalg.norm(end - begin) / apart_m)
        parts.append(begin + np.linspace(0.0, 1.0, count + 1)[1:, None] * (end - begin))
    return np.concatenate(parts)


@dataclass(frozen=True)
class Tried:
    """One goal and what came of it."""

    goal: Pose
    is_reached: bool
    text: str
    time_s: float
    bound_s: float
    position_error_m: float
    heading_error_rad: float
    nearest_m: float  # of the robot's center to obstacles


@dataclass
class Verdict:
    """Of all goals."""

    tried: list[Tried] = field(default_factory=list)
    recoveries: int = 0
    cpu_s_per_s: float = math.nan

    def record(self) -> dict[str, object]:
        """As JSON has it."""
        return {
            "goals": [asdict(one) for one in self.tried],
            "reached": sum(one.is_reached for one in self.tried),
            "recoveries": self.recoveries,
            "cpu_s_per_s": self.cpu_s_per_s,
        }

    def lines(self, inscribed_m: float) -> list[str]:
        """As words.

        Args:
            inscribed_m: nearer than this the robot's center cannot be without contact.
        """
        reached = [one for one in self.tried if one.is_reached]
        ratios = [one.time_s / one.bound_s for one in reached if one.bound_s > 0.0]
        nearest = min((one.nearest_m for one in self.tried), default=math.nan)
        contacts = sum(one.nearest_m < inscribed_m for one in self.tried)
        return [
            f"reached {len(reached)} of {len(self.tried)} goals",
            f"contacts {contacts}, nearest approach of the center {nearest:.2f} m",
            f"time over the lower bound: median {np.median(ratios) if ratios else math.nan:.2f}",
            f"recoveries {self.recoveries}, CPU {self.cpu_s_per_s:.3f} s per simulated second",
        ]


def lower_bound_s(route: Route, start: Pose, goal: Pose, limits: RobotLimits) -> float:
    """The shortest path of the inscribed circle at full speed, and the turns at its ends.

    Turns that a robot makes while it drives take no time of their own; those of one that cannot
    turn on the spot do not, either.
    """
    turns = (
        math.remainder(route.leaves_rad - start[2], 2.0 * math.pi),
        math.remainder(goal[2] - route.arrives_rad, 2.0 * math.pi),
    )
    turning = abs(turns[0]) + abs(turns[1]) if limits.drives_straight else 0.0
    return route.length_m / limits.speed + turning / limits.turning_rate
