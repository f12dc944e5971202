# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The routes of all robots as arrays, so that what any trade between them is worth is one sum."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trident_fleet.core.quintic import Array
from trident_fleet.core.tasks.messages import Point
from trident_fleet.core.tasks.plan import Objective, Plan

Index = npt.NDArray[np.intp]

# A makespan is what high powers of the finishing times add up to, so that the others count, too.
_POWER = 8


@dataclass(frozen=True)
class Edges:
    """All legs of all routes; the last leg of each goes to the end, which is anywhere.

    Attributes:
        route: whose leg it is, shape (E,).
        index: number of tasks before it in the route, shape (E,).
        start: node from which it goes, shape (E,).
        end: node to which it goes, shape (E,).
        before_m: length of the route before it [m], shape (E,).
        work_before_s: work of the tasks before it [s], shape (E,).
    """

    route: Index
    index: Index
    start: Index
    end: Index
    before_m: Array
    work_before_s: Array


class Tours:
    """Routes over nodes: tasks are 0 ... n - 1, then the robots' places, then the end.

    Attributes:
        lengths: from node to node, by robots that travel alike [m], shape (K, P, P); not
            symmetric where water moves. The end is anywhere: no path leads to it.
        lengths_to: the same, to a node from the other.
        kind: which of these each robot has, shape (R,).
    """

    def __init__(self, plans: Sequence[Plan]) -> None:
        """Of plans with the same objective."""
        self.plans = list(plans)
        self.objective = plans[0].objective
        self.jobs = [job for plan in plans for job in plan.jobs]
        self.routes = self._routes()
        self.kind, self.lengths = self._lengths()
        self.lengths_to = np.ascontiguousarray(self.lengths.transpose(0, 2, 1))
        self.end = len(self.jobs) + len(plans)
        self.work = np.array([job.task.duration_s for job in self.jobs] + [0.0] * (len(plans) + 1))
        self.speed = np.array([plan.can.speed_m_s for plan in plans])
        self.can = self._abilities()
        self.bound = self._is_bound()

    def _routes(self) -> list[list[int]]:
        number = {job.task_id: index for index, job in enumerate(self.jobs)}
        return [[number[job.task_id] for job in plan.jobs] for plan in self.plans]

    def _points(self) -> list[Point]:
        """Where the tasks and then the robots are, p_common [m]."""
        return [job.task.place for job in self.jobs] + [plan.place for plan in self.plans]

    def _lengths(self) -> tuple[Index, Array]:
        """Which robots travel alike, and lengths from node to node by them."""
        points = self._points()
        travels = {id(plan.travel): plan.travel for plan in self.plans}
        kind = [list(travels).index(id(plan.travel)) for plan in self.plans]
        lengths = np.zeros((len(travels), len(points) + 1, len(points) + 1))
        for table, travel in zip(lengths, travels.values(), strict=True):
            for row, column in itertools.permutations(range(len(points)), 2):
                table[row, column] = travel(points[row], points[column])
        return np.array(kind, dtype=np.intp), lengths

    def _abilities(self) -> npt.NDArray[np.bool_]:
        """Which robot can do which task, shape (R, n)."""
        can = [[not plan.lacks(job) for job in self.jobs] for plan in self.plans]
        return np.array(can, dtype=bool).reshape(len(self.plans), len(self.jobs))

    def _is_bound(self) -> bool:
        """Whether times or energy decide what fits."""
        tasks = any(
            job.task.deadline_s < math.inf or job.asked.not_before_s > 0.0 for job in self.jobs
        )
        return tasks or any(plan.energy_j < math.inf for plan in self.plans)

    def nodes(self, route: int) -> list[int]:
        """The place of the robot, its tasks, the end."""
        return [len(self.jobs) + route, *self.routes[route], self.end]

    def edges(self) -> Edges:
        """All legs as they are now."""
        rows: list[tuple[int, int, int, int]] = []
        before, work = [], []
        for route in range(len(self.routes)):
            nodes = self.nodes(route)
            length_m, work_s, kind = 0.0, 0.0, self.kind[route]
            for index in range(len(nodes) - 1):
                rows.append((route, index, nodes[index], nodes[index + 1]))
                before.append(length_m)
                work.append(work_s)
                length_m += float(self.lengths[kind, nodes[index], nodes[index + 1]])
                work_s += float(self.work[nodes[index + 1]])
        table = np.array(rows, dtype=np.intp).T
        return Edges(table[0], table[1], table[2], table[3], np.array(before), np.array(work))

    def length(self) -> Array:
        """Of each route [m]."""
        return np.array(
            [
                sum(self.lengths[kind, a, b] for a, b in itertools.pairwise(self.nodes(route)))
                for route, kind in enumerate(self.kind)
            ]
        )

    def finish(self) -> Array:
        """When each robot is done, if it never waits [s]."""
        now = np.array([plan.now_s for plan in self.plans])
        work = np.array([self.work[route].sum() for route in self.routes])
        return now + self.length() / self.speed + work

    def loss(self, finish_s: Array, route: Index, more_m: Array, more_s: Array) -> Array:
        """What the objective loses when a route gets longer, and has more work.

        Args:
            finish_s: of all routes now [s].
            route: which one, any shape that goes with the others.
            more_m: path, negative if less [m].
            more_s: work, negative if less [s].
        """
        if self.objective is not Objective.MAKESPAN:
            return more_m
        scale = max(float(finish_s.max()), 1e-9)
        old = finish_s[route] / scale
        new = np.maximum(old + (more_m / self.speed[route] + more_s) / scale, 0.0)
        return new**_POWER - old**_POWER + 1e-9 * more_m

    def score(self) -> float:
        """Of all routes: small is good."""
        length = float(self.length().sum())
        if self.objective is not Objective.MAKESPAN:
            return length
        return float(self.finish().max()) + 1e-6 * length

    def fits(self, route: int, nodes: Sequence[int]) -> bool:
        """Whether a robot can carry out these tasks in this order."""
        if not self.can[route, list(nodes)].all():
            return False
        return not self.bound or self.plans[route].timing([self.jobs[n] for n in nodes]) is not None

    def write(self) -> None:
        """Make the routes those of the plans."""
        for plan, route in zip(self.plans, self.routes, strict=True):
            jobs = [self.jobs[node] for node in route]
            for job in list(plan.jobs):
                plan.remove(job.task_id)
            for job in jobs:
                plan.insert(job, len(plan.jobs))
