# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The auctions that a manager holds: what is on offer, what has been bid, who wins."""

from __future__ import annotations

import itertools
from collections.abc import Sequence, Set
from dataclasses import dataclass, field

from trident_fleet.core.tasks.messages import TaskAnnounce, TaskBid
from trident_fleet.core.tasks.methods.base import Method, Offer, by_cost
from trident_fleet.core.tasks.plan import Job, announced
from trident_fleet.core.tasks.protocol import Guards, Team

_LONGEST = 8.0  # times of bids_s, of an auction of what nobody has bid for again and again


@dataclass
class Auction:
    """One round of one task.

    Attributes:
        job: it.
        decide_s: it is decided by the bids that are there [s]; before, when all have answered.
        again_s: it is announced again [s], as announcements get lost.
        offers: by robot; None: the robot has taken its bid back.
    """

    job: Job
    decide_s: float
    again_s: float
    offers: dict[str, Offer] = field(default_factory=dict)


def _robots_of(won: dict[str, list[Offer]]) -> set[str]:
    return {offer.robot for offers in won.values() for offer in offers}


class Auctions:
    """All auctions of one manager."""

    def __init__(self, manager: str, method: Method, team: Team, guards: Guards) -> None:
        """None yet."""
        self.manager, self.method, self.guards = manager, method, guards
        self.times, self.robots = team.times, team.robots
        self.running: dict[str, Auction] = {}
        self.fruitless: dict[str, int] = {}
        self._used: dict[str, tuple[int, float]] = {}
        self._answers: dict[str, tuple[int, float]] = {}

    def announce(self, job: Job, auction: int, now_s: float) -> TaskAnnounce:
        """Open a round of a task."""
        longer = min(2.0 ** self.fruitless.get(job.task_id, 0), _LONGEST)
        until_s = now_s + self.times.bids_s * longer
        job = announced(
            job, stamp_s=now_s, manager=self.manager, round=auction, bids_until_s=until_s
        )
        decide_s, again_s = until_s - self.times.step_s, now_s + self.times.retry_s
        self.running[job.task_id] = Auction(job, decide_s, again_s)
        return job.task

    def announcements_due(self, now_s: float) -> list[TaskAnnounce]:
        """What is announced once more, for who has not heard it."""
        due = [
            auction
            for auction in self.running.values()
            if auction.again_s <= now_s < auction.job.task.bids_until_s
        ]
        for auction in due:
            auction.again_s = now_s + self.times.retry_s
        return [auction.job.task for auction in due]

    def bid(self, bid: TaskBid, now_s: float) -> str | None:
        """A legal bid has come.

        Returns:
            Why it does not count, if a user should know.
        """
        auction = self.running.get(bid.task_id)
        if auction is None or auction.job.task.round != bid.round:
            return None
        until_s = auction.job.task.bids_until_s
        if not self.guards.in_time(now_s, until_s):
            return (
                f"bid of {bid.robot_id} for task {bid.task_id!r}: came at {now_s:.3f} s, legal: "
                f"until {until_s:.3f} s"
            )
        self._answers[bid.robot_id] = max(
            (bid.version, bid.stamp_s), self._answers.get(bid.robot_id, (0, 0.0))
        )
        known = auction.offers.get(bid.robot_id)
        if known is not None and known.version > bid.version:
            return None
        if bid.withdraw:
            auction.offers.pop(bid.robot_id, None)
            return None
        auction.offers[bid.robot_id] = Offer(
            bid.robot_id, bid.task_id, bid.cost, bid.start_s, bid.energy, bid.bundle, bid.version
        )
        return None

    def decide(self, now_s: float, awaited: Set[str]) -> list[tuple[Auction, list[Offer]]]:
        """The auctions that end now with winners, one for each robot that the task needs.

        Args:
            now_s: [s].
            awaited: robots that should answer before a decision, where they can.
        """
        due = self._due(now_s, awaited)
        won = self._winners([(auction, self._valid(auction, now_s)) for auction in due])
        for offer in itertools.chain.from_iterable(won.values()):
            self._used[offer.robot] = (offer.version, now_s)
        return [(self.running.pop(name), offers) for name, offers in won.items()]

    def _due(self, now_s: float, awaited: Set[str]) -> list[Auction]:
        """The auctions whose time is up, or in which nobody has to answer any more."""
        return [
            auction
            for auction in self.running.values()
            if now_s >= auction.decide_s or not self._unanswered(auction, awaited, now_s)
        ]

    def _winners(self, due: Sequence[tuple[Auction, Sequence[Offer]]]) -> dict[str, list[Offer]]:
        """Who wins, by task: those for several robots first, then by the method those for one."""
        won: dict[str, list[Offer]] = {}
        single: list[Offer] = []
        for auction, offers in due:
            needed = auction.job.task.robots_needed
            if needed == 1:
                single += offers
            elif len(offers) >= needed:
                won[auction.job.task_id] = sorted(offers, key=by_cost)[:needed]
        taken = _robots_of(won)
        for offer in self.method.winners([one for one in single if one.robot not in taken]):
            won[offer.task_id] = [offer]
        return won

    def unsold(self, now_s: float) -> list[Job]:
        """The auctions that end now without a winner."""
        over = [
            name for name, auction in self.running.items() if now_s > auction.job.task.bids_until_s
        ]
        for name in over:
            self.fruitless[name] = self.fruitless.get(name, 0) + 1
        return [self.running.pop(name).job for name in over]

    def refused(self, robot: str) -> None:
        """A robot did not take what it won: its plan is as it was, so its bids count."""
        self._used.pop(robot, None)

    def _unanswered(self, auction: Auction, awaited: Set[str], now_s: float) -> list[str]:
        """Robots whose answer by their newest plans has not come."""
        missing = []
        for robot in sorted(awaited):
            version, when_s = self._answers.get(robot, (-1, -1.0))
            fresh = when_s >= auction.job.task.stamp_s and not self._is_used(robot, version, now_s)
            if not fresh and not self.robots[robot].lacks(auction.job.asked):
                missing.append(robot)
        return missing

    def _is_used(self, robot: str, version: int, now_s: float) -> bool:
        """Whether the robot has won by a bid of this plan just now: it will have another one."""
        used, when_s = self._used.get(robot, (-1, now_s))
        return version <= used and now_s - when_s <= self.times.bids_s

    def _valid(self, auction: Auction, now_s: float) -> Sequence[Offer]:
        """Bids by plans that have not changed since, as far as this manager knows."""
        return [
            offer
            for offer in auction.offers.values()
            if not self._is_used(offer.robot, offer.version, now_s)
        ]
