# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A robot's side of the contract net: it bids, holds what it has won by lease, and says how it is.

A pure state machine: it is fed messages and times, and returns what it would send. Who drives the
robot asks `current` what is to be done, calls `begin` at the place until that is permitted, and
`finish`, `fail` or `withdraw` at the end.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from trident_fleet.core.tasks.fields import TaskError
from trident_fleet.core.tasks.follower import Follower
from trident_fleet.core.tasks.messages import (
    NOBODY,
    State,
    TaskAnnounce,
    TaskAward,
    TaskBid,
    TaskConfirm,
    TaskMessage,
    TaskProgress,
    TaskState,
    TaskTable,
    epoch_of,
)
from trident_fleet.core.tasks.methods.base import Method, Offer
from trident_fleet.core.tasks.plan import Job, Plan
from trident_fleet.core.tasks.protocol import Sent, needs_permission


@dataclass
class Holding:
    """A task that the robot has.

    Attributes:
        job: it.
        round: in which it was won.
        lease_until_s: it is the robot's no longer [s].
        asked: the robot would begin.
        granted: the manager has said that it may.
        begun: it works on it.
    """

    job: Job
    round: int
    lease_until_s: float
    asked: bool = False
    granted: bool = False
    begun: bool = False


class Robot:
    """The state machine of one robot."""

    def __init__(self, plan: Plan, method: Method, follower: Follower) -> None:
        """A robot that has no task.

        Args:
            plan: its route, empty.
            method: by which it bids; the manager has the same.
            follower: of this member.
        """
        self.name, self.plan, self.method, self.follower = plan.robot, plan, method, follower
        self.guards, self.times = follower.guards, follower.team.times
        self.holdings: dict[str, Holding] = {}
        self._ended: dict[str, TaskProgress] = {}
        self._open: dict[str, Job] = {}
        self._bids: dict[tuple[str, int], tuple[TaskBid, Job]] = {}
        self._bid_version: int | None = 0
        self._next_table_s = self._next_report_s = 0.0

    def on_message(self, source: str, message: TaskMessage, now_s: float) -> list[Sent]:
        """Take in what somebody else has sent."""
        self._drop_what_is_over(now_s)
        if isinstance(message, TaskAnnounce):
            return self._on_announce(message, now_s)
        if isinstance(message, TaskAward):
            return self._on_award(message, now_s)
        if isinstance(message, TaskTable) and self.follower.hear(source, message, now_s):
            return self._on_table(message, now_s)
        return []

    def on_time(self, now_s: float) -> list[Sent]:
        """What is due by now."""
        self._drop_what_is_over(now_s)
        sent = self.bid_again(now_s) if self._bid_version != self.plan.version else []
        if now_s >= self._next_report_s:
            self._next_report_s = now_s + self.times.retry_s
            sent += [Sent(report) for report in self._reports(now_s)]
        if now_s >= self._next_table_s:
            self._next_table_s = now_s + self.times.digest_s
            follower = self.follower
            leases = {name: held.lease_until_s for name, held in self.holdings.items()}
            tasks = follower.book.echo(follower.epoch, self.name, leases, follower.rounds)
            manager = follower.manager if follower.vouches else NOBODY
            sent.append(Sent(TaskTable(now_s, manager, follower.epoch, tasks)))
        return sent

    def current(self, now_s: float) -> Holding | None:
        """What the robot should do now; None: nothing. It may change until it has begun.

        Robots wait for each other at common tasks in one order for all, the oldest round first, and
        only with nothing else to do: so nobody waits for somebody who waits elsewhere.
        """
        self._drop_what_is_over(now_s)
        held = [self.holdings[job.task_id] for job in self.plan.jobs]
        begun = [one for one in held if one.begun]
        if begun:
            return begun[0]
        ready = [one for one in held if self._may_come_next(one)]
        alone = [one for one in ready if one.job.task.robots_needed == 1]
        common = sorted(
            (one for one in ready if one.job.task.robots_needed > 1),
            key=lambda one: (one.round, one.job.task_id),
        )
        chosen = (alone + common)[0] if ready else None
        if chosen is not None and chosen.job.task.robots_needed == 1:
            chosen.asked = True
        return chosen

    def begin(self, task_id: str, now_s: float) -> bool:
        """The robot is at the place of a task: whether it may begin, and then has begun."""
        self._drop_what_is_over(now_s)
        held = self.holdings.get(task_id)
        if held is None or now_s < held.job.asked.not_before_s:
            return False
        held.asked = True
        if not held.begun:
            permitted = self.guards.permitted(needs_permission(held.job.task), held.granted)
            held.begun = permitted and self._may_come_next(held)
        return held.begun

    def finish(self, task_id: str, now_s: float) -> list[Sent]:
        """A task that was begun is done."""
        return self._end(task_id, State.DONE, "", now_s)

    def fail(self, task_id: str, reason: str, now_s: float) -> list[Sent]:
        """A task cannot be done, and has not been done."""
        return self._end(task_id, State.FAILED, reason, now_s)

    def withdraw(self, task_id: str, reason: str, now_s: float) -> list[Sent]:
        """The robot gives a task back."""
        return self._end(task_id, State.WITHDRAWN, reason, now_s)

    def bid_again(self, now_s: float) -> list[Sent]:
        """Bid for all that is on offer, by the plan as it is now."""
        self._bid_version = self.plan.version
        open_jobs = [
            job
            for job in self._open.values()
            if self.guards.in_time(now_s, job.task.bids_until_s)
            and not self.plan.has(job.task_id)
            and job.task_id not in self.follower.book.done()
        ]
        self._open = {job.task_id: job for job in open_jobs}
        busy = self.method.one_each and bool(self.plan.jobs)
        offers = [] if busy else self.method.bids(self.plan, open_jobs, self._fixed())
        if not offers:
            return [Sent(self._no_bid(job.task, now_s), job.task.manager) for job in open_jobs[:1]]
        return self._send_bids(offers, now_s)

    def _no_bid(self, task: TaskAnnounce, now_s: float) -> TaskBid:
        """The answer of a robot that has nothing to bid."""
        version = self.plan.version
        return TaskBid(
            now_s, task.task_id, task.round, self.name, 0.0, version=version, withdraw=True
        )

    def _send_bids(self, offers: list[Offer], now_s: float) -> list[Sent]:
        sent = []
        for offer in offers:
            task = self._open[offer.task_id].task
            bid = TaskBid(
                now_s,
                task.task_id,
                task.round,
                self.name,
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

    def _on_announce(self, task: TaskAnnounce, now_s: float) -> list[Sent]:
        if not self.guards.is_current(epoch_of(task.round), self.follower.epoch):
            return []
        try:
            job = Job.of(task)
        except TaskError as error:
            self.follower.problem(str(error))
            return []
        known = self._bids.get((task.task_id, task.round))
        if known is not None and known[0].version == self.plan.version:
            return [Sent(known[0], task.manager)]
        if self._knows_newer(task.task_id, task.round) or not self.guards.can(self.plan.lacks(job)):
            return []
        self._open[task.task_id] = job
        self._bid_version = None
        return []

    def _knows_newer(self, task_id: str, auction: int) -> bool:
        record = self.follower.book.records.get(task_id)
        open_job = self._open.get(task_id)
        if open_job is not None and open_job.task.round > auction:
            return True
        return record is not None and (record.round > auction or bool(record.done_by))

    def _on_award(self, award: TaskAward, now_s: float) -> list[Sent]:
        if not self.guards.is_current(award.epoch, self.follower.epoch):
            return []
        if award.robot_id != self.name:
            return []
        reason = self._take(award.task_id, award.round, award.lease_until_s, now_s)
        confirm = TaskConfirm(now_s, award.task_id, award.round, self.name, not reason, reason)
        return [Sent(confirm, award.manager)]

    def _take(self, task_id: str, auction: int, lease_until_s: float, now_s: float) -> str:
        """Take a task that the manager says is this robot's; returns why not."""
        held, ended = self.holdings.get(task_id), self._ended.get(task_id)
        if held is not None and held.round == auction:
            held.lease_until_s = max(held.lease_until_s, lease_until_s)
            return ""
        if ended is not None and ended.round >= auction:
            return f"{ended.state.name.lower()} before: {ended.reason}"
        if held is not None:
            return "holds it by another round"
        bid = self._bids.get((task_id, auction))
        if bid is None:
            return "has not bid in this round"
        job = bid[1]
        record = self.follower.book.records.get(task_id)
        if record is not None and (record.round > auction or record.done_by):
            return "there is a newer round, or it is done"
        if not self.guards.lease_holds(now_s, lease_until_s):
            return "its lease has ended"
        insertion = self.method.place(self.plan, job, self._fixed())
        if insertion is None or not self.guards.can(self.plan.lacks(job)):
            return "does not fit the plan any more"
        self.plan.insert(job, insertion.index)
        self.holdings[task_id] = Holding(job, auction, lease_until_s)
        self._open.pop(task_id, None)
        epoch = self.follower.epoch
        mine = TaskState(job.task, State.AWARDED, self.name, auction, epoch, lease_until_s)
        self.follower.book.join([mine])
        return ""

    def _on_table(self, table: TaskTable, now_s: float) -> list[Sent]:
        together: dict[str, list[TaskState]] = {}
        for state in table.tasks:
            together.setdefault(state.task.task_id, []).append(state)
        for task_id, states in together.items():
            mine = next((state for state in states if state.robot_id == self.name), None)
            if mine is not None and mine.state < State.DONE:
                self._take(task_id, mine.round, mine.lease_until_s, now_s)
            held = self.holdings.get(task_id)
            if held is not None:
                self._compare(held, states)
        return []

    def _compare(self, held: Holding, states: list[TaskState]) -> None:
        """What the manager's table says about a task that this robot has."""
        if states[0].round == held.round:
            together = self.guards.all_there(len(states), held.job.task.robots_needed)
            active = all(one.state in (State.ACTIVE, State.DONE) for one in states)
            held.granted |= together and active

    def _may_come_next(self, held: Holding) -> bool:
        return self.guards.after_done(held.job.task.after, self.follower.book.done())

    def _fixed(self) -> int:
        """How many tasks at the head of the route keep their places."""
        return sum(held.asked for held in self.holdings.values())

    def _end(self, task_id: str, state: State, reason: str, now_s: float) -> list[Sent]:
        self._drop_what_is_over(now_s)
        held = self.holdings.get(task_id)
        if held is None or (state is State.DONE and not held.begun):
            return []
        share = 1.0 if state is State.DONE else 0.0
        ended = TaskProgress(now_s, task_id, held.round, self.name, share, 0.0, state, reason)
        self._ended[task_id] = ended
        self._drop(task_id)
        return [Sent(ended)]

    def _drop(self, task_id: str) -> None:
        self.holdings.pop(task_id, None)
        self.plan.remove(task_id)

    def _drop_what_is_over(self, now_s: float) -> None:
        records = self.follower.book.records
        for task_id, held in list(self.holdings.items()):
            record = records[task_id]
            if record.done_by or record.given_up or record.round > held.round:
                self._drop(task_id)
                continue
            if self.guards.lease_holds(now_s, held.lease_until_s):
                continue
            self._ended[task_id] = TaskProgress(
                now_s, task_id, held.round, self.name, 0.0, 0.0, State.WITHDRAWN, "lease ended"
            )
            self._drop(task_id)

    def _reports(self, now_s: float) -> list[TaskProgress]:
        """What the manager's table does not show yet."""
        records, reports = self.follower.book.records, []
        for task_id, held in self.holdings.items():
            if held.asked and not held.granted:
                reports.append(
                    TaskProgress(now_s, task_id, held.round, self.name, 0.0, 0.0, State.ACTIVE)
                )
        for task_id, ended in self._ended.items():
            record = records.get(task_id)
            holder = record.holders.get(self.name) if record is not None else None
            if record is None or record.done_by:
                continue
            shown = holder is not None and holder.state is State.DONE
            if (ended.state is State.DONE and not shown) or (
                ended.state is not State.DONE and record.round == ended.round and holder
            ):
                reports.append(ended)
        return reports
