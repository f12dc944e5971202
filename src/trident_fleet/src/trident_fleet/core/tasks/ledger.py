# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What becomes of tasks that have been awarded: leases, permission to begin, failure, the end."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable

from trident_fleet.core.tasks.book import Holder, Record
from trident_fleet.core.tasks.follower import Follower
from trident_fleet.core.tasks.messages import NOBODY, State, TaskProgress, TaskState, epoch_of
from trident_fleet.core.tasks.protocol import needs_permission


class Ledger:
    """A manager's part that keeps the records of its member's book."""

    def __init__(self, follower: Follower, now_s: float) -> None:
        """Of a member that has not managed yet."""
        self.follower, self.team = follower, follower.team
        self.times, self.guards = follower.team.times, follower.guards
        self.reasons: dict[str, str] = {}
        self.since_s = now_s
        self.known_by: defaultdict[tuple[str, int], set[str]] = defaultdict(set)
        self._asked: set[tuple[str, int, str]] = set()
        self._failures: defaultdict[str, int] = defaultdict(int)

    def start(self, now_s: float) -> None:
        """The member manages from now on: what was permitted before is for others to say."""
        self.since_s = now_s
        self.known_by.clear()
        self._asked.clear()

    def on_progress(self, source: str, message: TaskProgress, on_duty: bool) -> None:
        """A robot has said how it is with a task; only a manager on duty acts on failures."""
        record = self.follower.book.records.get(message.task_id)
        if record is None or record.done_by or source != message.robot_id:
            return
        if message.state is State.DONE:
            self._on_done(record, message)
        elif on_duty:
            self._on_not_done(record, message)

    def _on_not_done(self, record: Record, message: TaskProgress) -> None:
        """A robot would begin, or has not done its task and will not."""
        if not self.guards.same_round(message.round, record.round):
            return
        if message.state is State.ACTIVE:
            self._asked.add((message.task_id, message.round, message.robot_id))
        elif message.state in (State.FAILED, State.WITHDRAWN) and (
            message.robot_id in record.holders or record.given_up
        ):
            self._on_failure(record, message)

    def _on_done(self, record: Record, message: TaskProgress) -> None:
        """A robot has done its part."""
        if record.task.robots_needed == 1:
            record.done_by = (message.robot_id,)
        elif self.guards.same_round(message.round, record.round):
            holder = record.holders.setdefault(message.robot_id, Holder())
            holder.state = State.DONE
            if all(one.state is State.DONE for one in record.holders.values()):
                record.done_by = tuple(record.holders)
        if record.done_by:
            self.reasons.pop(message.task_id, None)

    def _on_failure(self, record: Record, message: TaskProgress) -> None:
        """A robot says itself that it has not done a task, and will not."""
        task_id = record.task.task_id
        record.reopen(self.follower.epoch)
        self.reasons.pop(task_id, None)
        self._failures[task_id] += message.state is State.FAILED
        if self._failures[task_id] >= self.team.attempts:
            self.give_up(record, f"failed {self._failures[task_id]} times: {message.reason}")

    def end_leases(self, now_s: float) -> None:
        """Robots that were not heard in time have their tasks no longer."""
        for record in self.follower.book.records.values():
            if record.done_by:
                continue
            if record.given_up:
                earlier = "given up by an earlier manager"
                self.reasons.setdefault(record.task.task_id, earlier)
                continue
            gone = self._gone(record, now_s)
            if gone:
                self._take_from(record, gone)

    def _gone(self, record: Record, now_s: float) -> list[str]:
        """The robots whose leases of a task have ended, in words."""
        earliest_s = self.since_s + self.times.lease_s
        gone = [
            name
            for name, holder in record.holders.items()
            if holder.state is not State.DONE
            and self.guards.lease_over(
                now_s, max(holder.lease_until_s, earliest_s), self.times.guard_s
            )
        ]
        if 0 < len(record.holders) < record.task.robots_needed and now_s >= earliest_s:
            gone.append("a robot that only an earlier manager knew")
        return gone

    def _take_from(self, record: Record, gone: list[str]) -> None:
        """Open the task again if that is safe, else give it up."""
        inherited = epoch_of(record.round) < self.follower.epoch
        begun = inherited or any(
            holder.state is not State.AWARDED for holder in record.holders.values()
        )
        if self.guards.may_repeat(record.task, begun):
            record.reopen(self.follower.epoch)
        else:
            self.give_up(
                record,
                f"{', '.join(gone)} vanished, may have done it, and it must not be done twice",
            )

    def is_newest(self, state: TaskState) -> bool:
        """Whether a row of a table says who has a task by its newest round."""
        record = self.follower.book.records[state.task.task_id]
        return state.robot_id != NOBODY and self.guards.same_round(state.round, record.round)

    def note_knowledge(self, source: str, states: Iterable[TaskState]) -> None:
        """A member that follows this manager knows who has tasks."""
        for state in states:
            if state.epoch == self.follower.epoch:
                self.known_by[state.task.task_id, state.round].add(source)

    def renew_lease(self, state: TaskState, now_s: float) -> None:
        """A robot claims a task: it has a lease from now on, if it is one of the holders."""
        holder = self.follower.book.records[state.task.task_id].holders.get(state.robot_id)
        if holder is not None and state.lease_until_s > 0.0:
            holder.lease_until_s = max(holder.lease_until_s, now_s + self.times.lease_s)

    def permit(self) -> None:
        """Let robots begin that have asked, where that is safe."""
        for task_id, record in self.follower.book.records.items():
            if self._may_begin(task_id, record):
                for holder in record.holders.values():
                    holder.state = State(max(holder.state, State.ACTIVE))

    def _may_begin(self, task_id: str, record: Record) -> bool:
        """Whether all robots of a task have asked, and enough members know that they have it."""
        if record.over or not record.holders:
            return False
        known_by = self.known_by[task_id, record.round] | {self.follower.name}
        safe = not needs_permission(record.task) or self.quorum(known_by)
        asked = self._askers(task_id, record)
        return safe and self.guards.all_there(len(asked), record.task.robots_needed)

    def _askers(self, task_id: str, record: Record) -> list[str]:
        """The robots of a task that would begin, or have done their part."""
        return [
            name
            for name, holder in record.holders.items()
            if holder.state is State.DONE or (task_id, record.round, name) in self._asked
        ]

    def quorum(self, names: set[str]) -> bool:
        """Whether these are more than half of the members."""
        members = self.team.members
        return self.guards.is_quorum(len(names & members), len(members))

    def give_up(self, record: Record, reason: str) -> None:
        """Nobody will do this task, for a reason."""
        record.given_up = True
        self.reasons[record.task.task_id] = reason
