# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Bundles of tasks, each bid for on the condition of those before it.

Source: H.-L. Choi, L. Brunet, J. P. How, Consensus-based decentralized auctions for robust task
allocation, IEEE Trans. Robotics 25(4), 2009. There, robots pass the highest bids on to their
neighbors until all agree. Here, all bids come to the manager, and its table says who has won what:
the result is that of the paper's algorithm once it has converged, but a robot that hears no manager
wins nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from trident_fleet.core.tasks.methods.base import Offer, by_cost, insertion_bids
from trident_fleet.core.tasks.plan import Insertion, Job, Plan

_LONGEST = 4  # tasks in a bundle


class Bundle:
    """Each robot bids for the tasks that it would take one after the other."""

    name = "bundle"
    one_each = False
    resells = False

    def offered(self, open_tasks: Sequence[Job]) -> Sequence[Job]:
        """All of them."""
        return open_tasks

    def bids(self, plan: Plan, offered: Sequence[Job], first: int) -> list[Offer]:
        """The cheapest insertion, then the cheapest one after that, and so on."""
        trial = plan.copy()
        left = list(offered)
        bids: list[Offer] = []
        while left and len(bids) < _LONGEST:
            found = insertion_bids(trial, left, first)[:1]
            if not found:
                break
            job = next(job for job in left if job.task_id == found[0].task_id)
            insertion = trial.best_insertion(job, first)
            assert insertion is not None
            before = tuple(bid.task_id for bid in bids)
            # A bid holds only with those before it, so it is no lower than they are.
            cost = max([found[0].cost, *(bid.cost for bid in bids[-1:])])
            bids.append(replace(found[0], cost=cost, bundle=before, version=plan.version))
            trial.insert(job, insertion.index)
            left.remove(job)
        return bids

    def place(self, plan: Plan, job: Job, first: int) -> Insertion | None:
        """Where it costs least."""
        return plan.best_insertion(job, first)

    def winners(self, offers: Sequence[Offer]) -> list[Offer]:
        """The lowest bids in order, up to the first that a robot would make otherwise now.

        Who has been outbid bids again for something else, and maybe at less than those that follow.
        """
        won: dict[str, Offer] = {}
        for offer in sorted(offers, key=lambda one: (one.cost, len(one.bundle), by_cost(one))):
            mine = {task for task, one in won.items() if one.robot == offer.robot}
            if offer.task_id in won or not set(offer.bundle) <= mine:
                break
            won[offer.task_id] = offer
        return list(won.values())
