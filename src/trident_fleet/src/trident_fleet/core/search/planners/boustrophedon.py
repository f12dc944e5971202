# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""To and fro in each part of the area that has no obstacle within, as an ox plows.

Source: H. Choset, Coverage of known spaces: the boustrophedon cellular decomposition, Autonomous
Robots 9, 2000. The order of the parts, and the corner at which each is begun, are those of a short
tour (nearest first, then improved by moving and turning pieces of it).
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from trident_fleet.core.search.area import Array, Mask
from trident_fleet.core.search.planners.base import Cell, CoverageProblem, walk

_SWEEPS = 6  # of improvements over the whole order, at most


@dataclass(frozen=True)
class Strip:
    """Free cells side by side in one row: from the first to the last column."""

    row: int
    first: int
    last: int


class Boustrophedon:
    """Along rows or along columns, whichever is shorter."""

    name = "boustrophedon"

    def plan(self, problem: CoverageProblem) -> list[Cell]:
        """A path from the start, cell by neighbor cell, that visits all reachable cells."""
        along_rows = walk(problem, _order(problem))
        turned = CoverageProblem(problem.free.T, problem.start[::-1])
        along_columns = [cell[::-1] for cell in walk(turned, _order(turned))]
        return min(along_rows, along_columns, key=len)


def parts_of(free: Mask) -> list[list[Strip]]:
    """The decomposition: strips in rows that follow each other, one above the other.

    A part ends where its strip splits, ends, or joins another one.
    """
    parts: list[list[Strip]] = []
    open_parts: list[list[Strip]] = []
    for row in range(free.shape[0]):
        strips = _strips(free[row], row)
        above = [_touching(open_parts, strip) for strip in strips]
        split = [sum(part in found for found in above) for part in open_parts]
        following = []
        for strip, found in zip(strips, above, strict=True):
            if len(found) == 1 and split[open_parts.index(found[0])] == 1:
                found[0].append(strip)
                following.append(found[0])
            else:
                parts.append([strip])
                following.append(parts[-1])
        open_parts = following
    return parts


def _touching(parts: list[list[Strip]], strip: Strip) -> list[list[Strip]]:
    """Parts whose last strip touches another one."""
    return [part for part in parts if _touch(part[-1], strip)]


def _strips(free: Mask, row: int) -> list[Strip]:
    edges = np.flatnonzero(np.diff(np.pad(free.astype(np.int8), 1)))
    return [
        Strip(row, int(first), int(end) - 1)
        for first, end in zip(edges[::2], edges[1::2], strict=True)
    ]


def _touch(one: Strip, other: Strip) -> bool:
    return one.first <= other.last and other.first <= one.last


def _sweep(part: list[Strip], upward: bool, rightward: bool) -> list[Cell]:
    """The cells of a part, to and fro."""
    cells: list[Cell] = []
    for strip in part if upward else part[::-1]:
        columns = range(strip.first, strip.last + 1)
        cells += [(strip.row, column) for column in (columns if rightward else columns[::-1])]
        rightward = not rightward
    return cells


def _order(problem: CoverageProblem) -> list[Cell]:
    """All cells in the order of a short tour of the parts."""
    parts = parts_of(problem.reachable)
    sweeps = [
        [_sweep(part, upward, rightward) for upward in (True, False) for rightward in (True, False)]
        for part in parts
    ]
    tour = PartTour(problem, sweeps)
    return [cell for part, option in tour.best() for cell in sweeps[part][option]]


class PartTour:
    """The order of parts, each with one of four sweeps, that needs the shortest links."""

    def __init__(self, problem: CoverageProblem, sweeps: list[list[list[Cell]]]) -> None:
        """Of all parts, with their four sweeps each."""
        begins = [sweep[0] for options in sweeps for sweep in options]
        ends = [sweep[-1] for options in sweeps for sweep in options]
        goals = [int(problem.number[cell]) for cell in begins]
        distances, _ = problem.distances([problem.start, *ends])
        count = len(sweeps)
        # From the start, shape (K, 4), and from the end of one sweep to the begin of another.
        self._first: Array = distances[0][goals].reshape(count, 4)
        self._links: Array = distances[1:][:, goals].reshape(count, 4, count, 4)

    def best(self) -> list[tuple[int, int]]:
        """Parts in order, with the number of the sweep of each."""
        order = self._nearest_first()
        cost, options = self._choose(order)
        for _ in range(_SWEEPS):
            improved = False
            for candidate in _neighbors(order):
                other, chosen = self._choose(candidate)
                if other < cost - 1e-9:
                    order, cost, options, improved = candidate, other, chosen, True
                    break
            if not improved:
                break
        return list(zip(order, options, strict=True))

    def _nearest_first(self) -> list[int]:
        waiting = set(range(len(self._first)))
        reach = self._first
        order = []
        while waiting:
            part, option = min(
                ((part, option) for part in waiting for option in range(4)),
                key=lambda one: (reach[one], one),
            )
            waiting.discard(part)
            order.append(part)
            reach = self._links[part, option]
        return order

    def _choose(self, order: list[int]) -> tuple[float, list[int]]:
        """The best sweeps for an order, by dynamic programming; and the length of the links."""
        cost = self._first[order[0]]
        choices = []
        for before, part in itertools.pairwise(order):
            total = cost[:, None] + self._links[before, :, part, :]
            choices.append(np.argmin(total, axis=0))
            cost = np.min(total, axis=0)
        option = int(np.argmin(cost))
        options = [option]
        for choice in reversed(choices):
            option = int(choice[option])
            options.append(option)
        return float(cost.min()), options[::-1]


def _neighbors(order: list[int]) -> Iterator[list[int]]:
    """Orders with one part elsewhere, or one piece turned."""
    count = len(order)
    for index in range(count):
        rest = order[:index] + order[index + 1 :]
        for place in range(count):
            if place != index:
                yield [*rest[:place], order[index], *rest[place:]]
    for first in range(count):
        for last in range(first + 2, count + 1):
            yield order[:first] + order[first:last][::-1] + order[last:]
