# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The best that can be done with up to seven tasks, by looking at everything."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence

from trident_fleet.core.tasks.fields import Capabilities
from trident_fleet.core.tasks.messages import Point, TaskAnnounce

_MOST = 7


def exact(
    team: Mapping[str, tuple[Capabilities, Point]], tasks: Sequence[TaskAnnounce], makespan: bool
) -> float:
    """The best order of every subset of tasks for every robot, and the best partition.

    Args:
        team: who can all do all tasks, and where they are, p_common [m].
        tasks: seven at most, for one robot each, at any time.
        makespan: the last finish [s]; else the sum of the lengths [m].
    """
    count = len(tasks)
    assert count <= _MOST
    subsets = [_subset(tasks, mask) for mask in range(1 << count)]
    costs = [
        [_least(can, place, chosen, makespan) for chosen in subsets] for can, place in team.values()
    ]
    best = costs[0]
    for least in costs[1:]:
        best = [_best_split(best, least, mask, makespan) for mask in range(1 << count)]
    return best[-1]


def _subset(tasks: Sequence[TaskAnnounce], mask: int) -> list[TaskAnnounce]:
    return [task for index, task in enumerate(tasks) if mask >> index & 1]


def _least(
    can: Capabilities, place: Point, chosen: Sequence[TaskAnnounce], makespan: bool
) -> float:
    """The cost of a subset of tasks for one robot, in the best order."""
    length_m = min(
        sum(map(math.dist, (place, *order), order))
        for order in itertools.permutations(task.place for task in chosen)
    )
    if not makespan:
        return length_m
    return length_m / can.speed_m_s + sum(task.duration_s for task in chosen)


def _best_split(one: list[float], other: list[float], mask: int, makespan: bool) -> float:
    best, part = math.inf, mask
    while True:
        pair = (one[part], other[mask ^ part])
        best = min(best, max(pair) if makespan else sum(pair))
        if not part:
            return best
        part = (part - 1) & mask
