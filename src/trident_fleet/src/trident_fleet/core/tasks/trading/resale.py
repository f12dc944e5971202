# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What robots have won, and have not begun, is auctioned again while they travel.

A robot offers a task that it has: a bid for its own round (`is_offer`) says what it would save. It
does not begin the task for `hold_s` then. The manager announces the task in a new round, which
counts only if another robot bids less than that by a margin, and if it is awarded while the robot
still waits. So a task changes hands with the word of the robot that has it, and never by a lease
that runs.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from trident_fleet.core.tasks.book import Record
from trident_fleet.core.tasks.messages import State, TaskAnnounce, TaskBid
from trident_fleet.core.tasks.methods.base import Offer, by_cost
from trident_fleet.core.tasks.plan import Job, announced
from trident_fleet.core.tasks.protocol import Guards, Times

_MARGIN = 0.02  # of the price: less is not worth the messages
_MESSAGES_PER_TASK = 12  # of all sales together
_AT_ONCE = 3  # sales, as who wins one bids otherwise for the next


def hold_s(times: Times) -> float:
    """How long a robot waits for what becomes of its offer [s]."""
    return times.bids_s + 3.0 * times.step_s


def is_offer(bid: TaskBid) -> bool:
    """Whether who bids has the task, and would give it away: it comes after itself.

    The bid by which the task was won may come again, late: it does not count here.
    """
    return bid.bundle == (bid.task_id,)


@dataclass
class Sale:
    """A task that may change hands.

    Attributes:
        offer: of who has it.
        job: as announced, in the round of the sale.
        bids: of others.
    """

    offer: TaskBid
    job: Job
    bids: dict[str, Offer] = field(default_factory=dict)

    def buyer(self) -> Offer | None:
        """Who bids least; None: nobody bids less than the offer by the margin."""
        best = min(self.bids.values(), key=by_cost, default=None)
        return best if best and best.cost < (1.0 - _MARGIN) * self.offer.cost else None


class Resale:
    """All sales of one manager."""

    def __init__(self, manager: str, times: Times, guards: Guards) -> None:
        """None yet."""
        self._manager, self._times, self._guards = manager, times, guards
        self._offers: dict[str, TaskBid] = {}
        self._sales: dict[str, Sale] = {}
        self._messages = 0

    def offer(self, bid: TaskBid, record: Record) -> bool:
        """Take in a bid for a task that its sender has; whether it is one."""
        holder = record.holders.get(bid.robot_id)
        if holder is None or record.round != bid.round or not is_offer(bid):
            return False
        self._messages += 1
        if holder.state is State.AWARDED:
            self._offers[bid.task_id] = bid
        return True

    def bid(self, bid: TaskBid, now_s: float) -> bool:
        """Take in a bid in a sale; whether it is one."""
        sale = self._sales.get(bid.task_id)
        if sale is None or sale.job.task.round != bid.round:
            return False
        self._messages += 1
        known = sale.bids.get(bid.robot_id)
        if known is not None and known.version > bid.version:
            return True
        sale.bids.pop(bid.robot_id, None)
        if not bid.withdraw and self._guards.in_time(now_s, sale.job.task.bids_until_s):
            sale.bids[bid.robot_id] = Offer(
                bid.robot_id, bid.task_id, bid.cost, bid.start_s, bid.energy, (), bid.version
            )
        return True

    def open(self, records: Mapping[str, Record], epoch: int, now_s: float) -> list[TaskAnnounce]:
        """Announce the dearest offers, while messages are left."""
        opened = []
        for offer in sorted(self._offers.values(), key=lambda one: (-one.cost, one.task_id)):
            room = len(self._sales) < _AT_ONCE
            if not room or self._messages > _MESSAGES_PER_TASK * len(records):
                break
            record = records[offer.task_id]
            job = announced(
                Job.of(record.task),
                stamp_s=now_s,
                manager=self._manager,
                round=record.next_round(epoch),
                bids_until_s=offer.stamp_s + self._times.bids_s,
            )
            self._sales[offer.task_id] = Sale(offer, job)
            self._messages += 1
            opened.append(job.task)
        self._offers.clear()
        return opened

    def decide(self, records: Mapping[str, Record], now_s: float) -> list[tuple[Job, Offer]]:
        """The sales that end now with a buyer; of each robot one, whose bids then are others."""
        sold: list[tuple[Job, Offer]] = []
        busy: set[str] = set()
        for task_id, sale in list(self._sales.items()):
            if now_s <= sale.job.task.bids_until_s:
                continue
            del self._sales[task_id]
            best = sale.buyer()
            if best is None or best.robot in busy or not self._holds(sale, records, now_s):
                continue
            self._messages += 2
            busy.add(best.robot)
            sold.append((sale.job, best))
        return sold

    def _holds(self, sale: Sale, records: Mapping[str, Record], now_s: float) -> bool:
        """Whether who has offered the task still waits, as far as this manager knows."""
        record = records[sale.job.task_id]
        holder = record.holders.get(sale.offer.robot_id)
        until_s = sale.offer.stamp_s + hold_s(self._times) - self._times.step_s
        return (
            holder is not None
            and not record.over
            and holder.state is State.AWARDED
            and self._guards.same_round(sale.offer.round, record.round)
            and self._guards.in_time(now_s, until_s)
        )
