# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The order in which a robot visits what it has: shorter than the order in which it was won."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from trident_fleet.core.missions.routes import Routes
from trident_fleet.core.tasks.messages import Point
from trident_fleet.core.tasks.plan import Job, Plan

_LEAST_M = 0.5


def shorten(plan: Plan, routes: Routes, fixed: int, rank: Callable[[Job], int]) -> bool:
    """Turn pieces of the route and move tasks in it while that makes it shorter.

    Args:
        plan: of the robot; it may change.
        routes: of the robot's kind.
        fixed: tasks at the head that keep their places.
        rank: of a task: those of a lower one come first.

    Returns:
        Whether it has changed.
    """
    before = list(plan.jobs)
    jobs = _shortened(plan, routes, fixed, rank)
    if jobs == before:
        return False
    for job in before:
        plan.remove(job.task_id)
    for job in jobs:
        plan.insert(job, len(plan.jobs))
    return True


def _shortened(plan: Plan, routes: Routes, fixed: int, rank: Callable[[Job], int]) -> list[Job]:
    """The tasks of a plan, in a short order among those of one rank."""
    jobs, rest = plan.jobs[:fixed], plan.jobs[fixed:]
    for number in sorted({rank(job) for job in rest}):
        group = [job for job in rest if rank(job) == number]
        start = jobs[-1].task.place if jobs else plan.place
        jobs += _short_tour(start, group, routes)
    return jobs


def _short_tour(start: Point, group: Sequence[Job], routes: Routes) -> list[Job]:
    """The tasks of a group in a short order from a place on."""
    places = [start, *(job.task.place for job in group)]
    lengths = [[routes(one, other) for other in places] for one in places]
    return [group[index] for index in short_order(lengths, 0)]


def short_order(lengths: Sequence[Sequence[float]], fixed: int) -> list[int]:
    """A short open path, by 2-opt and moves of up to three (Or, 1976) until neither helps.

    Args:
        lengths: between the start, which comes first, and the goals [m].
        fixed: goals at the head that keep their places.

    Returns:
        Numbers of the goals, from 0, in order.
    """
    path = list(range(len(lengths)))
    while _turn(path, lengths, fixed + 1) or _move(path, lengths, fixed + 1):
        pass
    return [node - 1 for node in path[1:]]


def _turn(path: list[int], lengths: Sequence[Sequence[float]], first: int) -> bool:
    for begin in range(first, len(path) - 1):
        for end in range(begin + 1, len(path)):
            before, head, tail = path[begin - 1], path[begin], path[end]
            gain = lengths[before][head] - lengths[before][tail]
            if end + 1 < len(path):
                after = path[end + 1]
                gain += lengths[tail][after] - lengths[head][after]
            if gain > _LEAST_M:
                path[begin : end + 1] = path[begin : end + 1][::-1]
                return True
    return False


def _move(path: list[int], lengths: Sequence[Sequence[float]], first: int) -> bool:
    for size in (1, 2, 3):
        for begin in range(first, len(path) - size + 1):
            piece, rest = path[begin : begin + size], path[:begin] + path[begin + size :]
            own = _detour(rest, begin, piece, lengths)
            for place in range(first, len(rest) + 1):
                if place != begin and own - _detour(rest, place, piece, lengths) > _LEAST_M:
                    path[:] = rest[:place] + piece + rest[place:]
                    return True
    return False


def _detour(
    rest: Sequence[int], place: int, piece: Sequence[int], lengths: Sequence[Sequence[float]]
) -> float:
    """How much longer the rest gets by a piece at a place [m]."""
    before = rest[place - 1]
    more = lengths[before][piece[0]]
    if place < len(rest):
        after = rest[place]
        more += lengths[piece[-1]][after] - lengths[before][after]
    return more
