# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Concurrent auctions of all tasks; what has been won is traded again between the robots."""

from __future__ import annotations

from collections.abc import Sequence

from trident_fleet.core.tasks.methods.base import Offer, by_cost
from trident_fleet.core.tasks.methods.sequential import Sequential
from trident_fleet.core.tasks.plan import Plan
from trident_fleet.core.tasks.trading.trades import Trades


class Improved(Sequential):
    """As in sequential auctions, but with several winners at once, and trades afterwards."""

    name = "improved"
    resells = True

    def winners(self, offers: Sequence[Offer]) -> list[Offer]:
        """The lowest bids in order, up to the first that a robot would make otherwise now."""
        won: list[Offer] = []
        for offer in sorted(offers, key=by_cost):
            if any(offer.task_id == one.task_id or offer.robot == one.robot for one in won):
                break
            won.append(offer)
        return won

    def refine(self, plans: Sequence[Plan], messages: int) -> int:
        """Let robots trade segments, tails and single tasks while that is worth it.

        Args:
            plans: of all robots; they change.
            messages: no more than this.

        Returns:
            Messages that were needed.
        """
        return Trades(plans, messages).run()
