# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A manager's side of the contract net: auctions, leases, permissions, and who takes over.

A pure state machine: it is fed messages and times, and returns what it would send. All members that
may manage have one. All but one stand by, and the next in the succession takes over when the table
of the one that manages was not heard for too long.

A task that must not be done twice, or that several robots do together, is begun only with
permission, which needs that more than half of the members know who has it (they say so in their
tables). A new manager touches such tasks only when more than half of the members follow it, so it
knows all permissions that can have been given. Then, whatever has been cut off, no second robot
begins the task unless the first one has said itself that it has not done it. If it never says
anything, the task is given up, and so reported.
"""

from __future__ import annotations

from collections.abc import Sequence

from trident_fleet.core.tasks.auctions import Auctions
from trident_fleet.core.tasks.book import Holder, Record
from trident_fleet.core.tasks.fields import TaskError
from trident_fleet.core.tasks.follower import Follower
from trident_fleet.core.tasks.intake import check_tasks, refuse_bid
from trident_fleet.core.tasks.ledger import Ledger
from trident_fleet.core.tasks.messages import (
    NOBODY,
    State,
    TaskAnnounce,
    TaskAward,
    TaskBid,
    TaskConfirm,
    TaskMessage,
    TaskProgress,
    TaskTable,
)
from trident_fleet.core.tasks.methods.base import Method, Offer
from trident_fleet.core.tasks.plan import Job
from trident_fleet.core.tasks.protocol import Sent, needs_permission
from trident_fleet.core.tasks.trading.resale import Resale


class Manager:
    """The state machine of one manager, on duty or standing by."""

    def __init__(self, name: str, method: Method, follower: Follower, now_s: float) -> None:
        """A manager that stands by.

        Args:
            name: of the member.
            method: of allocation; the robots have the same.
            follower: of this member.
            now_s: when it starts [s].
        """
        self.name, self.method, self.follower = name, method, follower
        self.team, self.times, self.guards = follower.team, follower.team.times, follower.guards
        self.on_duty = False
        self.ledger = Ledger(follower, now_s)
        self._auctions = Auctions(name, method, self.team, self.guards)
        self._resale = Resale(name, self.times, self.guards)
        self._next_table_s = now_s
        self._followers: set[str] = set()
        self._heard_s: dict[str, float] = {}

    def add(self, tasks: Sequence[TaskAnnounce]) -> list[str]:
        """Take in new tasks.

        Until its table is heard nobody else knows them: who must not lose them has `Requests`.

        Returns:
            What a user may want to know, a sentence each.

        Raises:
            TaskError: of a task that is not legal; none was taken in.
        """
        records = self.follower.book.records
        known = {name: record.task for name, record in records.items()}
        said = check_tasks(tasks, known, self.team.robots)
        for task in tasks:
            self.follower.book.enter(task)
        return said

    def cancel(self, task_id: str) -> None:
        """A task shall not be done any more.

        Raises:
            TaskError: it is unknown.
        """
        record = self.follower.book.records.get(task_id)
        if record is None:
            raise TaskError(f"task {task_id!r}: unknown, legal: {self._names()}")
        if not record.over:
            record.reopen(self.follower.epoch)
            self.ledger.give_up(record, "canceled")

    def take_over(self, now_s: float) -> list[Sent]:
        """Be the manager from now on, in an epoch of its own."""
        follower = self.follower
        follower.epoch = self.team.epoch_after(follower.seen_epoch, self.name)
        follower.manager, self.on_duty = self.name, True
        self._followers = {self.name} if follower.vouches else set()
        self.ledger.start(now_s)
        self._auctions = Auctions(self.name, self.method, self.team, self.guards)
        self._resale = Resale(self.name, self.times, self.guards)
        return self._table(now_s)

    def on_message(self, source: str, message: TaskMessage, now_s: float) -> list[Sent]:
        """Take in what somebody has sent."""
        self._heard_s[source] = now_s
        if isinstance(message, TaskTable):
            return self._on_table(source, message, now_s)
        if isinstance(message, TaskProgress) and message.robot_id == NOBODY:
            self._on_cancel(message)
        elif isinstance(message, TaskProgress):
            self.ledger.on_progress(source, message, self.on_duty)
        elif self.on_duty:
            self._on_answer(source, message, now_s)
        return []

    def _on_answer(self, source: str, message: TaskMessage, now_s: float) -> None:
        """A robot bids, or says whether it takes what it has won."""
        if isinstance(message, TaskBid):
            self._on_bid(source, message, now_s)
        elif isinstance(message, TaskConfirm) and not message.accept:
            self._on_refusal(source, message)

    def on_time(self, now_s: float) -> list[Sent]:
        """What is due by now."""
        if not self.on_duty:
            rank = self.team.managers.index(self.name)
            silence_s = self.times.silence_s + rank * self.times.stagger_s
            late = now_s - max(self.follower.heard_s, self.ledger.since_s) >= silence_s
            return self.take_over(now_s) if late else []
        self.ledger.end_leases(now_s)
        self.ledger.permit()
        sent = self._hold_auctions(now_s) + self._hold_sales(now_s)
        if now_s >= self._next_table_s or sent:
            sent += self._table(now_s)
        return sent

    def _table(self, now_s: float) -> list[Sent]:
        self._next_table_s = now_s + self.times.digest_s
        follower = self.follower
        if self.ledger.quorum(self._followers):
            for record in follower.book.records.values():
                record.epoch = follower.epoch
        return [Sent(TaskTable(now_s, self.name, follower.epoch, follower.book.table()))]

    def _on_table(self, source: str, table: TaskTable, now_s: float) -> list[Sent]:
        follower = self.follower
        follower.hear(source, table, now_s)
        if not self.on_duty:
            return []
        if follower.manager != self.name or self.guards.is_newer(table.epoch, follower.epoch):
            self._stand_by(now_s)
        elif source != self.name and table.manager in (self.name, NOBODY):
            self.hear_echo(source, table, now_s)
        return []

    def _stand_by(self, now_s: float) -> None:
        """Another member manages from now on."""
        self.on_duty, self.ledger.since_s = False, now_s
        if self.follower.manager == self.name:
            self.follower.manager = NOBODY

    def hear_echo(self, source: str, table: TaskTable, now_s: float) -> None:
        """What a member that follows this manager knows and has."""
        if not self.guards.is_current(table.epoch, self.follower.epoch):
            return
        self.follower.book.join(table.tasks)
        states = [state for state in table.tasks if self.ledger.is_newest(state)]
        if table.manager == self.name:
            self._followers.add(source)
            self.ledger.note_knowledge(source, states)
        for state in states:
            if state.robot_id == source:
                self.ledger.renew_lease(state, now_s)

    def _on_cancel(self, message: TaskProgress) -> None:
        """A user does not want a task any more."""
        if not self.on_duty or message.state is not State.WITHDRAWN:
            return
        try:
            self.cancel(message.task_id)
        except TaskError as error:
            self.follower.problem(str(error))

    def _on_bid(self, source: str, bid: TaskBid, now_s: float) -> None:
        problem = refuse_bid(bid, source, self.team.robots)
        record = self.follower.book.records.get(bid.task_id)
        if record is None:
            problem = f"bid of {source}: task_id is {bid.task_id!r}, legal: {self._names()}"
        elif problem is None and (self._resale.bid(bid, now_s) or self._resale.offer(bid, record)):
            return
        problem = problem or self._auctions.bid(bid, now_s)
        if problem is not None:
            self.follower.problem(problem)

    def _on_refusal(self, source: str, message: TaskConfirm) -> None:
        """A robot does not take what it has won, so it has not begun."""
        record = self.follower.book.records.get(message.task_id)
        if record is None or not self.guards.same_round(message.round, record.round):
            return
        self._auctions.refused(source)
        if source in record.holders and not record.done_by:
            record.reopen(self.follower.epoch)

    def _hold_auctions(self, now_s: float) -> list[Sent]:
        sent: list[Sent] = []
        for auction, offers in self._auctions.decide(now_s, self._awaited(now_s)):
            sent += self._award(auction.job, offers, now_s)
        for job in self._auctions.unsold(now_s):
            if self._waits_long(now_s) and self._auctions.fruitless[job.task_id] > 2:
                self.ledger.reasons[job.task_id] = "nobody who is heard can do it"
        announced = self._announce(now_s) + self._auctions.announcements_due(now_s)
        return sent + [Sent(task) for task in announced]

    def _awaited(self, now_s: float) -> set[str]:
        """The robots that were heard lately, so that they should bid."""
        earliest_s = now_s - self.times.silence_s
        return {
            name
            for name in self.team.robots
            if max(self._heard_s.get(name, 0.0), self.ledger.since_s) >= earliest_s
        }

    def _announce(self, now_s: float) -> list[TaskAnnounce]:
        """Open auctions of what waits for somebody."""
        opened = []
        for job in self.method.offered(self._waiting(now_s)):
            if job.task_id not in self._auctions.running:
                record = self.follower.book.records[job.task_id]
                record.round = record.next_round(self.follower.epoch)
                record.task = self._auctions.announce(job, record.round, now_s)
                opened.append(record.task)
        return opened

    def _hold_sales(self, now_s: float) -> list[Sent]:
        """What robots would rather give to others changes hands, or stays with them."""
        records, sent = self.follower.book.records, []
        for job, offer in self._resale.decide(records, now_s):
            record = records[job.task_id]
            record.round, record.task = job.task.round, job.task
            record.holders = {}
            sent += self._award(job, [offer], now_s)
        if self.ledger.quorum(self._followers):
            opened = self._resale.open(records, self.follower.epoch, now_s)
            sent += [Sent(task) for task in opened]
        return sent

    def _waiting(self, now_s: float) -> list[Job]:
        """The tasks that somebody should do, and could begin."""
        followed = self.ledger.quorum(self._followers)
        records = self.follower.book.records.values()
        waiting = [
            Job.of(record.task) for record in records if self._is_waiting(record, followed, now_s)
        ]
        return sorted(waiting, key=lambda job: self._auctions.fruitless.get(job.task_id, 0))

    def _is_waiting(self, record: Record, followed: bool, now_s: float) -> bool:
        """Whether a task could begin; one that has no time left is given up, or it is said why.

        Args:
            record: of the task.
            followed: whether more than half of the members follow this manager.
            now_s: [s].
        """
        task = record.task
        if not record.free:
            self._auctions.running.pop(task.task_id, None)
            return False
        if now_s + task.duration_s > task.deadline_s:
            self.ledger.give_up(record, f"not done by its deadline, {task.deadline_s} s")
            return False
        if followed or not needs_permission(task):
            settled = followed or now_s - self.ledger.since_s >= 2.0 * self.times.digest_s
            return settled and self.guards.after_done(task.after, self.follower.book.done())
        if self._waits_long(now_s):
            heard = f"{len(self._followers)} of {len(self.team.members)}"
            self.ledger.reasons[task.task_id] = (
                f"needs that more than half of the members agree, and only {heard} are heard"
            )
        return False

    def _waits_long(self, now_s: float) -> bool:
        return now_s - self.ledger.since_s >= self.times.patience_s

    def _award(self, job: Job, offers: Sequence[Offer], now_s: float) -> list[Sent]:
        record = self.follower.book.records[job.task_id]
        if not record.free or record.round != job.task.round:
            return []
        self._auctions.fruitless.pop(job.task_id, None)
        self.ledger.reasons.pop(job.task_id, None)
        lease_until_s = now_s + self.times.lease_s
        record.holders = {offer.robot: Holder(State.AWARDED, lease_until_s) for offer in offers}
        epoch = self.follower.epoch
        return [
            Sent(
                TaskAward(
                    now_s,
                    job.task_id,
                    record.round,
                    self.name,
                    offer.robot,
                    offer.cost,
                    (*offer.bundle, job.task_id) if offer.bundle else (),
                    epoch,
                    lease_until_s,
                ),
                offer.robot,
            )
            for offer in offers
        ]

    def _names(self) -> str:
        return ", ".join(self.follower.book.records) or "none"
