# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a method of allocation decides: which tasks are on offer, what robots bid, who wins.

The protocol (announce, bid, award, confirm) is the same for all of them. A manager calls `offered`
and `winners`, a robot `bids`. Methods keep nothing between calls.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from trident_fleet.core.tasks.plan import Insertion, Job, Plan


@dataclass(frozen=True)
class Offer:
    """A robot's bid as the methods see it.

    Attributes:
        robot: who bids.
        task_id: for what.
        cost: at least 0.
        start_s: when it would begin [s].
        energy_j: that it would take [J].
        bundle: tasks that it would do before this one; the bid holds only with them.
        version: of the robot's plan.
    """

    robot: str
    task_id: str
    cost: float
    start_s: float = 0.0
    energy_j: float = 0.0
    bundle: tuple[str, ...] = ()
    version: int = 0


class Method(Protocol):
    """A method of allocation.

    Attributes:
        name: by which users choose it.
        one_each: a robot has one task at a time.
        resells: what was won is auctioned again while robots travel.
    """

    name: str
    one_each: bool
    resells: bool

    def offered(self, open_tasks: Sequence[Job]) -> Sequence[Job]:
        """Which of the tasks that nobody has are announced now."""
        ...

    def bids(self, plan: Plan, offered: Sequence[Job], first: int) -> list[Offer]:
        """What a robot bids for those on offer; `first`: earlier places of its route are fixed."""
        ...

    def place(self, plan: Plan, job: Job, first: int) -> Insertion | None:
        """Where in its route a robot puts what it has won; None if it does not fit any more."""
        ...

    def winners(self, offers: Sequence[Offer]) -> list[Offer]:
        """Which of the bids for tasks on offer win now; at most one for each task."""
        ...


def offer_of(plan: Plan, job: Job, found: Insertion) -> Offer:
    """The bid for an insertion."""
    return Offer(
        plan.robot, job.task_id, found.cost, found.start_s, found.energy_j, (), plan.version
    )


def insertion_bids(plan: Plan, offered: Sequence[Job], first: int) -> list[Offer]:
    """A bid for each task that fits into the route, where it costs least, cheapest first."""
    found = [(job, plan.best_insertion(job, first)) for job in offered]
    bids = [offer_of(plan, job, insertion) for job, insertion in found if insertion is not None]
    return sorted(bids, key=by_cost)


def by_cost(offer: Offer) -> tuple[float, str, str]:
    """Order of bids: the cheapest first, then by name."""
    return (offer.cost, offer.task_id, offer.robot)


def lowest_for_each(offers: Sequence[Offer]) -> list[Offer]:
    """The lowest bid for each task."""
    lowest: dict[str, Offer] = {}
    for offer in sorted(offers, key=by_cost):
        lowest.setdefault(offer.task_id, offer)
    return list(lowest.values())
