# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The robot that is nearest now gets the task, whatever else it has to do: a yardstick."""

from __future__ import annotations

from collections.abc import Sequence

from trident_fleet.core.tasks.methods.base import Offer, by_cost, lowest_for_each, offer_of
from trident_fleet.core.tasks.plan import Insertion, Job, Plan


class Nearest:
    """Tasks are announced in the order in which they came; a bid is the path from here."""

    name = "nearest"
    one_each = False
    resells = False

    def offered(self, open_tasks: Sequence[Job]) -> Sequence[Job]:
        """The first."""
        return open_tasks[:1]

    def bids(self, plan: Plan, offered: Sequence[Job], first: int) -> list[Offer]:
        """The path from where the robot is, if the task fits after all others."""
        bids = []
        for job in offered:
            found = plan.last_insertion(job)
            if found is not None:
                cost = plan.travel(plan.place, job.task.place)
                here = Insertion(cost, found.index, found.start_s, found.energy_j)
                bids.append(offer_of(plan, job, here))
        return sorted(bids, key=by_cost)

    def place(self, plan: Plan, job: Job, first: int) -> Insertion | None:
        """After all others."""
        return plan.last_insertion(job)

    def winners(self, offers: Sequence[Offer]) -> list[Offer]:
        """The nearest for each task."""
        return lowest_for_each(offers)
