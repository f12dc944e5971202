# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""An area divided between robots of different speed and reach, so that all are done together.

DARP (A. Kapoutsis, S. Chatzichristofis, E. Kosmatopoulos, DARP: divide areas algorithm for optimal
multi-robot coverage path planning, J. Intelligent and Robotic Systems 86, 2017) gives equal areas
to equal robots. Here what is balanced is time: each robot has the seconds that it needs for each
cell, infinite where it does not get to. A cell goes to the robot from whose site the path to it,
less a handicap, is shortest (an additively weighted Voronoi diagram, whose parts are connected).
Handicaps are raised for those that are done early, single cells change hands along the borders, and
sites move to the middles of the shares (Lloyd's method).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import label
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import dijkstra

from trident_fleet.core.search.area import Array, Index, Mask, SearchError

TOLERANCE = 0.05
_ROUNDS, _MOVES = 80, 6
_STEPS = ((0, 1), (1, 0), (1, 1), (1, -1))


@dataclass(frozen=True)
class Searcher:
    """A robot that takes a share.

    Attributes:
        name: of it.
        start: row and column at which it is.
        seconds: that it needs for each cell [s], infinite where it does not get to, shape
            (rows, columns).
        ready_s: when it begins [s].
    """

    name: str
    start: tuple[int, int]
    seconds: Array
    ready_s: float = 0.0


@dataclass(frozen=True)
class Shares:
    """Who covers what.

    Attributes:
        owner: index of the robot by cell, -1 where nobody gets to, shape (rows, columns).
        finish_s: when each robot is done [s], shape (robots,).
    """

    owner: Index
    finish_s: Array

    @property
    def imbalance(self) -> float:
        """How much earlier than the last one the first one is done, as a share, 0 ... 1."""
        last = float(self.finish_s.max())
        return 1.0 - float(self.finish_s.min()) / last if last > 0.0 else 0.0


def balanced_shares(robots: Sequence[Searcher], tolerance: float = TOLERANCE) -> Shares:
    """Divide all cells that somebody gets to.

    Args:
        robots: at least one, of grids of one shape.
        tolerance: imbalance that is good enough, 0 ... 1.

    Returns:
        The best shares found; where reach does not allow balance, those that can do no more are
        done early. Those of robots that get to least are one piece each; a robot that gets across
        the shares of others may have several pieces.

    Raises:
        SearchError: names field, value and legal range.
    """
    _check(robots, tolerance)
    problem = _Problem.of(robots)
    sites = _spread(problem)
    handicap = np.zeros(len(robots))
    best: Shares | None = None
    for _ in range(_MOVES):
        paths = problem.path_lengths(sites)
        shares, handicap = _balanced(problem, paths, handicap, 0.5 * tolerance)
        shares = _Exchange(shares, problem, paths).run(0.5 * tolerance)
        if best is None or shares.finish_s.max() < best.finish_s.max():
            best = shares
        if best.imbalance <= tolerance:
            break
        sites = _centers(shares.owner, sites, problem)
    assert best is not None
    return best


def _check(robots: Sequence[Searcher], tolerance: float) -> None:
    if not robots:
        raise SearchError("shares: there is no robot, legal: one or more")
    if not 0.0 < tolerance < 1.0:
        raise SearchError(f"shares: tolerance is {tolerance}, legal: 0 ... 1")
    for robot in robots:
        _check_searcher(robot, robots[0].seconds.shape)


def _check_searcher(robot: Searcher, shape: tuple[int, ...]) -> None:
    if robot.seconds.shape != shape:
        raise SearchError(
            f"shares: seconds of {robot.name} have shape {robot.seconds.shape}, legal: {shape}"
        )
    row, column = robot.start
    if not (0 <= row < shape[0] and 0 <= column < shape[1]):
        raise SearchError(f"shares: start of {robot.name} is {robot.start}, legal: on the grid")
    if not math.isfinite(robot.seconds[row, column]):
        raise SearchError(
            f"shares: start of {robot.name} is {robot.start}, legal: a cell that it gets to"
        )
    if not (robot.seconds > 0.0).all():
        raise SearchError(f"shares: seconds of {robot.name}, legal: all above 0")


@dataclass(frozen=True)
class _Problem:
    """Of R robots: seconds and what they get to from their starts, shape (R, rows, columns)."""

    seconds: Array
    reach: Mask
    ready: Array

    @staticmethod
    def of(robots: Sequence[Searcher]) -> _Problem:
        seconds = np.stack([robot.seconds for robot in robots])
        near = []
        for robot in robots:
            labels, _ = label(np.isfinite(robot.seconds), np.ones((3, 3)))
            near.append((labels == labels[robot.start]) & np.isfinite(robot.seconds))
        return _Problem(seconds, np.stack(near), np.array([robot.ready_s for robot in robots]))

    def finish(self, owner: Index) -> Array:
        """When each robot is done [s]."""
        work = [self.seconds[i][owner == i].sum() for i in range(len(self.ready))]
        return self.ready + np.array(work)

    def path_lengths(self, sites: Sequence[tuple[int, int]]) -> Array:
        """From each robot's site, shape (R, rows, columns)."""
        return np.stack(
            [_path_lengths(self.reach[index], site) for index, site in enumerate(sites)]
        )


def _path_lengths(free: Mask, site: tuple[int, int]) -> Array:
    """From a cell over free ones, in cells; infinite: there is no path; shape (rows, columns)."""
    shape = free.shape
    number = np.arange(free.size).reshape(shape)
    edges, lengths = [], []
    for down, right in _STEPS:
        rows = slice(0, shape[0] - down), slice(down, shape[0])
        left, width = max(-right, 0), shape[1] - abs(right)
        columns = slice(left, left + width), slice(left + right, left + right + width)
        both = free[rows[0], columns[0]] & free[rows[1], columns[1]]
        one, other = number[rows[0], columns[0]][both], number[rows[1], columns[1]][both]
        edges.append(np.column_stack([one, other]))
        lengths.append(np.full(len(one), math.hypot(down, right)))
    pairs, length = np.concatenate(edges), np.concatenate(lengths)
    graph = csr_matrix((length, (pairs[:, 0], pairs[:, 1])), shape=(free.size, free.size))
    paths = dijkstra(graph, directed=False, indices=int(number[site]))
    # Octile lengths are equal over whole areas; the straight line decides there.
    row, column = np.indices(shape)
    straight = np.hypot(row - site[0], column - site[1])
    return np.asarray(paths.reshape(shape) + 0.02 * straight)


def _spread(problem: _Problem) -> list[tuple[int, int]]:
    """A cell for each robot, far from each other; robots that get to little choose first."""
    sites: dict[int, tuple[int, int]] = {}
    for index in np.argsort([reach.sum() for reach in problem.reach], kind="stable"):
        cells = np.argwhere(problem.reach[index])
        middle = cells[np.argmin(np.linalg.norm(cells - cells.mean(axis=0), axis=1))]
        if sites:
            others = np.array(list(sites.values()))
            away = np.linalg.norm(cells[:, None] - others[None], axis=2).min(axis=1)
            middle = cells[np.argmax(away)]
        sites[int(index)] = (int(middle[0]), int(middle[1]))
    return [sites[index] for index in range(len(problem.reach))]


def _centers(
    owner: Index, sites: Sequence[tuple[int, int]], problem: _Problem
) -> list[tuple[int, int]]:
    """The cell of each share that is nearest to its middle (a step of Lloyd's method)."""
    moved = []
    for index, site in enumerate(sites):
        cells = np.argwhere((owner == index) & problem.reach[index])
        if len(cells):
            nearest = np.argmin(np.linalg.norm(cells - cells.mean(axis=0), axis=1))
            site = (int(cells[nearest][0]), int(cells[nearest][1]))
        moved.append(site)
    return moved


def _balanced(
    problem: _Problem, paths: Array, handicap: Array, tolerance: float
) -> tuple[Shares, Array]:
    """The best shares that handicaps give, and the handicaps."""
    best: Shares | None = None
    chosen, gain = handicap, 0.2 * math.hypot(*paths.shape[1:])
    handicap = handicap.copy()
    for _ in range(_ROUNDS):
        owner = np.argmin(paths - handicap[:, None, None], axis=0)
        owner[~np.isfinite(paths).any(axis=0)] = -1
        shares = Shares(owner, problem.finish(owner))
        if best is None or shares.finish_s.max() < best.finish_s.max():
            best, chosen = shares, handicap.copy()
        if shares.imbalance <= tolerance:
            break
        mean = float(shares.finish_s.mean())
        handicap += gain * (mean - shares.finish_s) / max(mean, 1e-9)
        gain *= 0.96
    assert best is not None
    return best, chosen


class _Exchange:
    """Single cells that change hands along borders, from who is done last to who is done first."""

    def __init__(self, shares: Shares, problem: _Problem, paths: Array) -> None:
        self._owner, self._finish_s = shares.owner.copy(), shares.finish_s.copy()
        self._problem, self._seconds, self._paths = problem, problem.seconds, paths

    def run(self, tolerance: float) -> Shares:
        """Exchange until the shares are balanced, or nothing helps."""
        for _ in range(self._owner.size):
            order = np.argsort(self._finish_s)
            if 1.0 - self._finish_s[order[0]] / self._finish_s[order[-1]] <= tolerance:
                break
            if not self._exchange(order):
                break
        return Shares(self._owner, self._problem.finish(self._owner))

    def _exchange(self, order: Index) -> bool:
        """Give one piece from a late robot to an earlier one, if that helps any two of them."""
        return any(
            self._give(int(late), int(early))
            for late in order[::-1]
            for early in order
            if self._finish_s[early] < self._finish_s[late]
        )

    def _give(self, late: int, early: int) -> bool:
        """One cell from a robot to another one that is done before it, if there is such a cell."""
        own = self._owner == late
        border = own & _grown(self._owner == early) & np.isfinite(self._paths[early])
        more_s = self._seconds[early]
        border &= self._finish_s[early] + np.where(border, more_s, np.inf) < self._finish_s[late]
        if not border.any():
            return False
        far = self._paths[late] - self._paths[early]
        rows, columns = np.nonzero(border)
        for pick in np.argsort(-far[rows, columns], kind="stable"):
            row, column = int(rows[pick]), int(columns[pick])
            if _keeps_together(own, row, column):
                self._owner[row, column] = early
                self._finish_s[late] -= self._seconds[late][row, column]
                self._finish_s[early] += more_s[row, column]
                return True
        return False


def _grown(cells: Mask) -> Mask:
    """Cells next to these, side by side."""
    wide = np.pad(cells, 1)
    return np.asarray(wide[:-2, 1:-1] | wide[2:, 1:-1] | wide[1:-1, :-2] | wide[1:-1, 2:])


def _keeps_together(own: Mask, row: int, column: int) -> bool:
    """Whether the neighbors of a cell hold together without it."""
    around = np.pad(own, 1)[row : row + 3, column : column + 3].copy()
    around[1, 1] = False
    return bool(label(around, np.ones((3, 3)))[1] <= 1)
