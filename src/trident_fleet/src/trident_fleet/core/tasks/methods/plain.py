# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The textbook's contract net: one task after the other, to who bids lowest.

Source: R. G. Smith, The contract net protocol, IEEE Trans. Computers C-29(12), 1980.
"""

from __future__ import annotations

from collections.abc import Sequence

from trident_fleet.core.tasks.methods.base import Offer, insertion_bids, lowest_for_each
from trident_fleet.core.tasks.plan import Insertion, Job, Plan


class Plain:
    """Tasks are announced in the order in which they came; a bid is the cheapest insertion."""

    name = "plain"
    one_each = False
    resells = False

    def offered(self, open_tasks: Sequence[Job]) -> Sequence[Job]:
        """The first."""
        return open_tasks[:1]

    def bids(self, plan: Plan, offered: Sequence[Job], first: int) -> list[Offer]:
        """The cheapest insertion."""
        return insertion_bids(plan, offered, first)

    def place(self, plan: Plan, job: Job, first: int) -> Insertion | None:
        """Where it costs least."""
        return plan.best_insertion(job, first)

    def winners(self, offers: Sequence[Offer]) -> list[Offer]:
        """The lowest bid for each task."""
        return lowest_for_each(offers)
