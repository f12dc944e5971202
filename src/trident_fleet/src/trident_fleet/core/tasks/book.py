# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a member knows of all tasks.

Records only grow: the greater epoch and round is the newer one, within a round a task goes from
free to awarded, active, and given up, and what is done stays done. So it does not matter in which
order and how often the news comes, and what two members know can be joined.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

from trident_fleet.core.tasks.messages import NOBODY, State, TaskAnnounce, TaskState, round_of


@dataclass
class Holder:
    """A robot that has a task.

    Attributes:
        state: AWARDED; ACTIVE: it may have begun; DONE.
        lease_until_s: it claims the task no longer [s].
    """

    state: State = State.AWARDED
    lease_until_s: float = 0.0


@dataclass
class Record:
    """What is known of a task.

    Attributes:
        task: as announced last, or entered.
        round: the newest.
        epoch: of the last manager that vouched for this while more than half of the members
            followed it; its word is newer than any round of an earlier one.
        holders: who won that round.
        given_up: nobody will do it.
        done_by: who has done it; empty: it is not done.
    """

    task: TaskAnnounce
    round: int = 0
    epoch: int = 0
    holders: dict[str, Holder] = field(default_factory=dict)
    given_up: bool = False
    done_by: tuple[str, ...] = ()

    @property
    def free(self) -> bool:
        """Whether it waits for somebody."""
        return not (self.holders or self.given_up or self.done_by)

    @property
    def over(self) -> bool:
        """Whether it is done, or nobody will do it."""
        return bool(self.done_by) or self.given_up

    def reopen(self, epoch: int) -> None:
        """Nobody has it any more: what is still said about the old round does not count."""
        self.round = self.next_round(epoch)
        self.holders, self.given_up = {}, False

    def note_done(self, states: list[TaskState]) -> None:
        """It is done if all of its robots have said so; who was first to do it stays known."""
        done_by = tuple(state.robot_id for state in states if state.state is State.DONE)
        if len(done_by) == len(states):
            self.done_by = self.done_by or done_by

    def next_round(self, epoch: int) -> int:
        """A round newer than all that are known, of this epoch's manager."""
        return max(self.round + 1, round_of(epoch, 1))

    @property
    def version(self) -> tuple[int, int]:
        """Of two records of a task, the greater one is the newer one."""
        return self.epoch, self.round

    def states(self) -> list[TaskState]:
        """As a table has it."""
        task, epoch = self.task, self.epoch
        if self.done_by:
            return [
                TaskState(task, State.DONE, name, self.round, epoch, 0.0) for name in self.done_by
            ]
        if self.given_up or not self.holders:
            state = State.FAILED if self.given_up else State.WITHDRAWN
            return [TaskState(task, state, NOBODY, self.round, epoch, 0.0)]
        return [
            TaskState(task, holder.state, name, self.round, epoch, holder.lease_until_s)
            for name, holder in self.holders.items()
        ]


def by_task(states: Iterable[TaskState]) -> dict[str, list[TaskState]]:
    """The rows of a table, those of one task together."""
    together: dict[str, list[TaskState]] = {}
    for state in states:
        together.setdefault(state.task.task_id, []).append(state)
    return together


class Book:
    """The records of a member, by task."""

    def __init__(self) -> None:
        """Empty."""
        self.records: dict[str, Record] = {}

    def done(self) -> set[str]:
        """The tasks that are done."""
        return {name for name, record in self.records.items() if record.done_by}

    def enter(self, task: TaskAnnounce) -> Record:
        """A new task."""
        return self.records.setdefault(task.task_id, Record(task))

    def join(self, states: Iterable[TaskState]) -> None:
        """What another member knows."""
        for same in by_task(states).values():
            self._join_task(same)

    def _join_task(self, states: list[TaskState]) -> None:
        first = states[0]
        record = self.enter(first.task)
        record.note_done(states)
        if record.done_by or (first.epoch, first.round) < record.version:
            return
        if (first.epoch, first.round) > record.version:
            record.epoch, record.round = first.epoch, first.round
            record.holders, record.given_up = {}, False
            record.task = first.task
        record.given_up |= first.state is State.FAILED
        for state in states:
            if state.robot_id != NOBODY:
                self._join_holder(record, state)

    @staticmethod
    def _join_holder(record: Record, state: TaskState) -> None:
        holder = record.holders.setdefault(state.robot_id, Holder())
        holder.state = State(max(holder.state, state.state))
        holder.lease_until_s = max(holder.lease_until_s, state.lease_until_s)

    def table(self) -> tuple[TaskState, ...]:
        """All of it."""
        return tuple(state for record in self.records.values() for state in record.states())

    def echo(
        self, robot: str, leases: dict[str, float], shown: dict[str, tuple[int, int]]
    ) -> tuple[TaskState, ...]:
        """What a member says that it knows, apart from what is free as the manager has said, too.

        Its own tasks have the lease until which it claims them, 0 if it does not.

        Args:
            robot: its name.
            leases: of the tasks that it has [s].
            shown: versions that the manager's table has shown.
        """
        return tuple(
            replace(state, lease_until_s=leases.get(state.task.task_id, 0.0))
            if state.robot_id == robot
            else state
            for record in self.records.values()
            if not record.free or record.version > shown.get(record.task.task_id, (-1, 0))
            for state in record.states()
        )
