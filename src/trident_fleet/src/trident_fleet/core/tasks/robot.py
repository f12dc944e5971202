# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A robot's side of the contract net: it bids, holds what it has won by lease, and says how it is.

A pure state machine: it is fed messages and times, and returns what it would send. Who drives the
robot asks `current` what is to be done, calls `begin` at the place until that is permitted, and
`finish`, `fail` or `withdraw` at the end.
"""

from __future__ import annotations

from dataclasses import dataclass

from trident_fleet.core.tasks.bidder import Bidder
from trident_fleet.core.tasks.book import Record, by_task
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
from trident_fleet.core.tasks.methods.base import Method
from trident_fleet.core.tasks.plan import Job, Objective, Plan
from trident_fleet.core.tasks.protocol import Sent, needs_permission
from trident_fleet.core.tasks.trading.resale import hold_s

_MOST_OFFERS = 2  # of one task by one robot


@dataclass
class Holding:
    """A task that the robot has.

    Attributes:
        job: it.
        round: in which it was won.
        lease_until_s: it is the robot's no longer [s].
        seen: version of the record when it was won.
        asked: the robot would begin.
        granted: the manager has said that it may.
        begun: it works on it.
        offers: how often the robot has offered it to others.
        offered_until_s: it is not begun before [s], as another robot may get it.
    """

    job: Job
    round: int
    lease_until_s: float
    seen: tuple[int, int]
    asked: bool = False
    granted: bool = False
    begun: bool = False
    offers: int = 0
    offered_until_s: float = 0.0

    @property
    def may_be_offered(self) -> bool:
        """Whether another robot may get it in a sale."""
        is_alone = self.job.task.robots_needed == 1
        return is_alone and self.offers < _MOST_OFFERS and not self.asked


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
        self._bidder = Bidder(plan, method, follower)
        self._next_table_s = self._next_report_s = self._next_offer_s = 0.0

    def on_message(self, source: str, message: TaskMessage, now_s: float) -> list[Sent]:
        """Take in what somebody else has sent."""
        self._drop_what_is_over(now_s)
        if isinstance(message, TaskAnnounce):
            return self._bidder.hear(message)
        if isinstance(message, TaskAward):
            return self._on_award(message, now_s)
        if isinstance(message, TaskTable) and self.follower.hear(source, message, now_s):
            return self._on_table(message, now_s)
        return []

    def on_time(self, now_s: float) -> list[Sent]:
        """What is due by now."""
        self._drop_what_is_over(now_s)
        sent = self._bidder.bid(now_s, self._fixed()) + self._offer(now_s)
        if now_s >= self._next_report_s:
            self._next_report_s = now_s + self.times.retry_s
            sent += [Sent(report) for report in self._reports(now_s)]
        if now_s >= self._next_table_s:
            self._next_table_s = now_s + self.times.digest_s
            follower = self.follower
            leases = {name: held.lease_until_s for name, held in self.holdings.items()}
            tasks = follower.book.echo(self.name, leases, follower.shown)
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
        return begun[0] if begun else self._next_of(held, now_s)

    def _next_of(self, held: list[Holding], now_s: float) -> Holding | None:
        """The first that it does alone, in the order of the route, else the oldest common one."""
        ready = [one for one in held if self._may_come_next(one) and now_s >= one.offered_until_s]
        for one in ready:
            if one.job.task.robots_needed == 1:
                one.asked = True
                return one
        return min(ready, key=lambda one: (one.round, one.job.task_id), default=None)

    def begin(self, task_id: str, now_s: float) -> bool:
        """The robot is at the place of a task: whether it may begin, and then has begun."""
        self._drop_what_is_over(now_s)
        held = self.holdings.get(task_id)
        if held is None or now_s < max(held.job.asked.not_before_s, held.offered_until_s):
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
        held = self.holdings.get(task_id)
        if held is not None and held.round == auction:
            held.lease_until_s = max(held.lease_until_s, lease_until_s)
            return ""
        return (
            self._why_not_won(task_id, auction)
            or self._why_too_late(task_id, auction, lease_until_s, now_s)
            or self._hold(task_id, auction, lease_until_s)
        )

    def _why_not_won(self, task_id: str, auction: int) -> str:
        """Why this robot cannot have won a round of a task; empty: it can."""
        ended = self._ended.get(task_id)
        if ended is not None and ended.round >= auction:
            return f"{ended.state.name.lower()} before: {ended.reason}"
        if task_id in self.holdings:
            return "holds it by another round"
        return "" if self._bidder.has_bid(task_id, auction) else "has not bid in this round"

    def _why_too_late(self, task_id: str, auction: int, lease_until_s: float, now_s: float) -> str:
        """Why a task that was won does not count any more; empty: it does."""
        record = self.follower.book.records.get(task_id)
        if record is not None and (record.round > auction or record.done_by):
            return "there is a newer round, or it is done"
        return "" if self.guards.lease_holds(now_s, lease_until_s) else "its lease has ended"

    def _hold(self, task_id: str, auction: int, lease_until_s: float) -> str:
        """Put a task that was won into the plan; returns why that is not possible."""
        job = self._bidder.has_bid(task_id, auction)
        assert job is not None
        insertion = self.method.place(self.plan, job, self._fixed())
        if insertion is None or not self.guards.can(self.plan.lacks(job)):
            return "does not fit the plan any more"
        self.plan.insert(job, insertion.index)
        record = self.follower.book.records.get(task_id)
        seen = record.version if record is not None else (0, 0)
        self.holdings[task_id] = Holding(job, auction, lease_until_s, seen)
        self._bidder.won(task_id)
        return ""

    def _on_table(self, table: TaskTable, now_s: float) -> list[Sent]:
        for task_id, states in by_task(table.tasks).items():
            self._take_own(states, now_s)
            held = self.holdings.get(task_id)
            if held is not None:
                self._compare(held, states)
            self._bidder.forget_sold(task_id, states)
        return []

    def _take_own(self, states: list[TaskState], now_s: float) -> None:
        """Take a task that is this robot's by the manager's table."""
        mine = next((state for state in states if state.robot_id == self.name), None)
        if mine is not None and mine.state < State.DONE:
            self._take(mine.task.task_id, mine.round, mine.lease_until_s, now_s)

    def _compare(self, held: Holding, states: list[TaskState]) -> None:
        """What the manager's table says about a task that this robot has."""
        if states[0].round == held.round:
            together = self.guards.all_there(len(states), held.job.task.robots_needed)
            active = all(one.state in (State.ACTIVE, State.DONE) for one in states)
            held.granted |= together and active

    def _offer(self, now_s: float) -> list[Sent]:
        """Offer the task that takes the longest detour, if the method has tasks change hands.

        Not the first one, to which the robot is on its path, and none again by the same plan.
        """
        if not self.method.resells or now_s < self._next_offer_s or not self.follower.manager:
            return []
        self._next_offer_s = now_s + hold_s(self.times)
        prices = self._prices()
        if not prices:
            return []
        task_id = max(prices, key=lambda one: (-self.holdings[one].offers, prices[one], one))
        held, price = self.holdings[task_id], prices[task_id]
        held.offers += 1
        held.offered_until_s = now_s + hold_s(self.times)
        offer = TaskBid(
            now_s,
            task_id,
            held.round,
            self.name,
            price,
            bundle=(task_id,),
            version=self.plan.version,
        )
        return [Sent(offer, self.follower.manager)]

    def _prices(self) -> dict[str, float]:
        """What the robot would save without each task that may change hands [m]."""
        if self.plan.objective is not Objective.SUM:
            return {}
        later = [self.holdings[job.task_id] for job in self.plan.jobs[1:]]
        return {
            held.job.task_id: self.plan.saving(held.job.task_id)
            for held in later
            if held.may_be_offered
        }

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
            record = records.get(task_id)
            if record is not None and self._is_over(held, record):
                self._drop(task_id)
                continue
            if self.guards.lease_holds(now_s, held.lease_until_s):
                continue
            self._ended[task_id] = TaskProgress(
                now_s, task_id, held.round, self.name, 0.0, 0.0, State.WITHDRAWN, "lease ended"
            )
            self._drop(task_id)

    @staticmethod
    def _is_over(held: Holding, record: Record) -> bool:
        """Whether what is known of a task says that it is another robot's, or nobody's."""
        if record.done_by or (record.given_up and record.version > held.seen):
            return True
        late = epoch_of(record.round) == epoch_of(held.round) and record.round < held.round
        return record.round != held.round and record.version > held.seen and not late

    def _reports(self, now_s: float) -> list[TaskProgress]:
        """What the manager's table does not show yet."""
        asked = [
            TaskProgress(now_s, task_id, held.round, self.name, 0.0, 0.0, State.ACTIVE)
            for task_id, held in self.holdings.items()
            if held.asked and not held.granted
        ]
        return asked + [one for one in self._ended.values() if self._is_unknown(one)]

    def _is_unknown(self, ended: TaskProgress) -> bool:
        """Whether the record of a task does not show how it has ended for this robot."""
        record = self.follower.book.records.get(ended.task_id)
        if record is None or record.done_by:
            return False
        holder = record.holders.get(self.name)
        if ended.state is State.DONE:
            return holder is None or holder.state is not State.DONE
        return holder is not None and record.round == ended.round
