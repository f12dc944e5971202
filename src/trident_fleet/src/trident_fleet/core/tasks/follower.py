# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Which manager a member follows, and what it knows of the tasks: each member has one."""

from __future__ import annotations

from collections import Counter

from trident_fleet.core.tasks.book import Book
from trident_fleet.core.tasks.fields import TaskError
from trident_fleet.core.tasks.intake import check_tasks, is_same
from trident_fleet.core.tasks.messages import NOBODY, TaskAnnounce, TaskTable
from trident_fleet.core.tasks.protocol import Guards, Team

_MOST_PROBLEMS = 200  # texts, as each may quote something else


class Follower:
    """A member's promise to one manager at a time, by epoch, and its book.

    Who has changed to a newer epoch listens to no older one ever again. So a new manager that has
    the tables of more than half of the members knows all that an older one can have permitted.
    """

    def __init__(
        self, name: str, team: Team, guards: Guards, now_s: float, restarted: bool = False
    ) -> None:
        """Of a member that knows nothing.

        Args:
            name: of the member.
            team: that it is of.
            guards: what must hold.
            now_s: when it starts [s].
            restarted: it was there before and has forgotten what it knew: it vouches for nothing
                until it changes from one manager to the next.
        """
        self.name, self.team, self.guards = name, team, guards
        self.book = Book()
        self.epoch, self.manager, self.seen_epoch = 0, NOBODY, 0
        self.heard_s, self.vouches = now_s, not restarted
        self.shown: dict[str, tuple[int, int]] = {}
        self.problems: Counter[str] = Counter()

    def hear(self, source: str, table: TaskTable, now_s: float) -> bool:
        """Take in a table.

        Returns:
            Whether it is the word of the manager that this member follows.
        """
        self.seen_epoch = max(self.seen_epoch, table.epoch)
        if source != table.manager:
            return False
        if self.guards.is_newer(table.epoch, self.epoch):
            self.vouches |= self.epoch > 0
            self.epoch, self.manager = table.epoch, table.manager
        if not self.guards.is_current(table.epoch, self.epoch):
            return False
        if self.manager != table.manager:
            self.problem(
                f"table of {table.manager}: epoch is {table.epoch}, which is that of "
                f"{self.manager}; legal: one manager an epoch"
            )
            return False
        self.heard_s = now_s
        self.shown = {state.task.task_id: (state.epoch, state.round) for state in table.tasks}
        self.book.join(table.tasks)
        return True

    def request(self, task: TaskAnnounce) -> None:
        """A user asks for a task: every member that hears it keeps it for all managers to come."""
        known = {name: record.task for name, record in self.book.records.items()}
        if task.task_id in known and is_same(task, known[task.task_id]):
            return
        try:
            check_tasks([task], known, self.team.robots)
        except TaskError as error:
            self.problem(str(error))
            return
        self.book.enter(task)

    def problem(self, text: str) -> None:
        """Bad input: counted by its text, which names field, value and legal range."""
        if text not in self.problems and len(self.problems) >= _MOST_PROBLEMS:
            text = "other bad input"
        self.problems[text] += 1
