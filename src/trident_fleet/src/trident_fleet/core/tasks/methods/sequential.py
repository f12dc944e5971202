# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Sequential single-item auctions: of all bids for all tasks, the lowest wins, again and again.

Source: S. Koenig et al., Sequential bundle-bid single-sale auction algorithms for decentralized
control, Proc. IJCAI, 2007 (its single-item form).
"""

from __future__ import annotations

from collections.abc import Sequence

from trident_fleet.core.tasks.methods.base import Offer, by_cost, insertion_bids
from trident_fleet.core.tasks.plan import Insertion, Job, Plan


class Sequential:
    """All tasks are on offer; each robot bids for the one that it can insert at the least cost."""

    name = "sequential"
    one_each = False
    resells = False

    def offered(self, open_tasks: Sequence[Job]) -> Sequence[Job]:
        """All of them."""
        return open_tasks

    def bids(self, plan: Plan, offered: Sequence[Job], first: int) -> list[Offer]:
        """The cheapest insertion of all."""
        return insertion_bids(plan, offered, first)[:1]

    def place(self, plan: Plan, job: Job, first: int) -> Insertion | None:
        """Where it costs least."""
        return plan.best_insertion(job, first)

    def winners(self, offers: Sequence[Offer]) -> list[Offer]:
        """The lowest bid of all."""
        return sorted(offers, key=by_cost)[:1]
