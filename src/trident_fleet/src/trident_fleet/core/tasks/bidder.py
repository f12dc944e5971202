# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a robot bids in the auctions that it has heard of."""

from __future__ import annotations

import math

from trident_fleet.core.tasks.fields import TaskError
from trident_fleet.core.tasks.follower import Follower
from trident_fleet.core.tasks.messages import (
    State,
    TaskAnnounce,
    TaskBid,
    TaskState,
    epoch_of,
)
from trident_fleet.core.tasks.methods.base import Method, Offer
from trident_fleet.core.tasks.plan import Job, Plan
from trident_fleet.core.tasks.protocol import Sent


class Bidder:
    """A robot's part that answers announcements."""

    def __init__(self, plan: Plan, method: Method, follower: Follower) -> None:
        """Of a robot that has heard nothing."""
        self.plan, self.method, self.follower = plan, method, follower
        self.guards = follower.guards
        self._open: dict[str, Job] = {}
        self._bids: dict[tuple[str, int], tuple[TaskBid, Job]] = {}
        self._version: int | None = plan.version

    def has_bid(self, task_id: str, auction: int) -> Job | None:
        """The task of an auction in which this robot has bid."""
        bid = self._bids.get((task_id, auction))
        return None if bid is None else bid[1]

    def won(self, task_id: str) -> None:
        """The task is this robot's, and not on offer to it any more."""
        self._open.pop(task_id, None)

    def bid(self, now_s: float, fixed: int) -> list[Sent]:
        """Bid for all that is on offer by the plan as it is now, if something has changed.

        Args:
            now_s: [s].
            fixed: tasks at the head of the route that keep their places.
        """
        if self._version == self.plan.version:
            return []
        self._version = self.plan.version
        open_jobs = [job for job in self._open.values() if self._may_bid(job, now_s)]
        self._open = {job.task_id: job for job in open_jobs}
        offers = self._offers(open_jobs, fixed)
        return self._send_bids(offers, now_s) if offers else self._send_no_bid(open_jobs[:1], now_s)

    def _offers(self, jobs: list[Job], fixed: int) -> list[Offer]:
        """What the robot would do some of these tasks for; nothing if it has enough to do."""
        is_busy = self.method.one_each and bool(self.plan.jobs)
        return [] if is_busy else self.method.bids(self.plan, jobs, fixed)

    def _may_bid(self, job: Job, now_s: float) -> bool:
        """Whether a bid is in time for a task that the robot has not, and that is not done."""
        return (
            self.guards.in_time(now_s, job.task.bids_until_s)
            and not self.plan.has(job.task_id)
            and job.task_id not in self.follower.book.done()
        )

    def _send_no_bid(self, jobs: list[Job], now_s: float) -> list[Sent]:
        return [Sent(self._no_bid(job.task, now_s), job.task.manager) for job in jobs]

    def _no_bid(self, task: TaskAnnounce, now_s: float) -> TaskBid:
        """The answer of a robot that has nothing to bid."""
        version = self.plan.version
        return TaskBid(
            now_s, task.task_id, task.round, self.plan.robot, 0.0, version=version, withdraw=True
        )

    def _send_bids(self, offers: list[Offer], now_s: float) -> list[Sent]:
        sent = []
        for offer in offers:
            task = self._open[offer.task_id].task
            bid = TaskBid(
                now_s,
                task.task_id,
                task.round,
                self.plan.robot,
                offer.cost,
                offer.start_s,
                offer.energy_j,
                offer.bundle,
                offer.version,
            )
            if math.isfinite(bid.cost):
                self._bids[task.task_id, task.round] = (bid, self._open[task.task_id])
                sent.append(Sent(bid, task.manager))
        return sent

    def hear(self, task: TaskAnnounce) -> list[Sent]:
        """An auction has been announced."""
        if not self.guards.is_current(epoch_of(task.round), self.follower.epoch):
            return []
        try:
            job = Job.of(task)
        except TaskError as error:
            self.follower.problem(str(error))
            return []
        known = self._bid_by_this_plan(task)
        if known is not None:
            return [Sent(known, task.manager)]
        if self._knows_newer(task.task_id, task.round) or not self.guards.can(self.plan.lacks(job)):
            return []
        self._open[task.task_id] = job
        self._version = None
        return []

    def _bid_by_this_plan(self, task: TaskAnnounce) -> TaskBid | None:
        """What the robot has bid for a round of a task by the plan that it still has."""
        known = self._bids.get((task.task_id, task.round))
        return known[0] if known is not None and known[0].version == self.plan.version else None

    def _knows_newer(self, task_id: str, auction: int) -> bool:
        record = self.follower.book.records.get(task_id)
        open_job = self._open.get(task_id)
        if open_job is not None and open_job.task.round > auction:
            return True
        return record is not None and (record.round > auction or bool(record.done_by))

    def forget_sold(self, task_id: str, states: list[TaskState]) -> None:
        """What another robot has won is not on offer: bid for something else instead."""
        job = self._open.get(task_id)
        known, is_free = self._round(job), states[0].state is State.WITHDRAWN
        # What somebody has by an older round than that on offer is for sale.
        sold = states[0].round > known or (states[0].round == known and not is_free)
        if job is not None and sold:
            del self._open[task_id]
            self._version = None

    @staticmethod
    def _round(job: Job | None) -> int:
        return 0 if job is None else job.task.round
