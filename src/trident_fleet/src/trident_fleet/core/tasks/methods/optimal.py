# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""One task for each robot at the least total cost, by the Hungarian method."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from trident_fleet.core.assignment import cheapest_pairs
from trident_fleet.core.quintic import Array
from trident_fleet.core.tasks.methods.base import Offer, insertion_bids
from trident_fleet.core.tasks.plan import Insertion, Job, Plan

Pairs = Callable[[Array], list[tuple[int, int]]]


class Optimal:
    """Robots without a task bid for all tasks; the manager pairs them."""

    name = "optimal"
    one_each = True
    resells = False

    def offered(self, open_tasks: Sequence[Job]) -> Sequence[Job]:
        """All of them."""
        return open_tasks

    def bids(self, plan: Plan, offered: Sequence[Job], first: int) -> list[Offer]:
        """A bid for each."""
        return insertion_bids(plan, offered, first)

    def place(self, plan: Plan, job: Job, first: int) -> Insertion | None:
        """Where it costs least: there is nothing else."""
        return plan.best_insertion(job, first)

    def winners(self, offers: Sequence[Offer]) -> list[Offer]:
        """The pairs of the least total cost."""
        return paired(offers, _hungarian)


def _hungarian(cost: Array) -> list[tuple[int, int]]:
    rows, columns = cheapest_pairs(cost)
    return [(int(row), int(column)) for row, column in zip(rows, columns, strict=True)]


def paired(offers: Sequence[Offer], pairs: Pairs) -> list[Offer]:
    """The offers of the least total cost, one for each robot and for each task.

    As many tasks as possible are given away: a pair without a bid costs more than all bids.

    Args:
        offers: the bids.
        pairs: the pairs of least total cost of a finite matrix, rows are robots.
    """
    if not offers:
        return []
    robots = sorted({offer.robot for offer in offers})
    tasks = sorted({offer.task_id for offer in offers})
    cost = np.full((len(robots), len(tasks)), 1.0 + sum(offer.cost for offer in offers))
    by_pair = {}
    for offer in offers:
        pair = robots.index(offer.robot), tasks.index(offer.task_id)
        by_pair[pair], cost[pair] = offer, offer.cost
    return [by_pair[pair] for pair in pairs(cost) if pair in by_pair]
