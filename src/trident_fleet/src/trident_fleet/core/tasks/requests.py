# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A user's side of the contract net: what shall be done is asked for until a manager has heard it.

A pure state machine, like a manager and a robot. All members that hear a request keep it. It is
said again while the table of the newest manager does not show it, so that no task gets lost with a
manager that dies.
"""

from __future__ import annotations

from collections.abc import Sequence

from trident_fleet.core.tasks.fields import TaskError
from trident_fleet.core.tasks.follower import Follower
from trident_fleet.core.tasks.intake import check_tasks
from trident_fleet.core.tasks.messages import (
    NOBODY,
    State,
    TaskAnnounce,
    TaskMessage,
    TaskProgress,
    TaskTable,
)
from trident_fleet.core.tasks.protocol import Sent


class Requests:
    """What one user has asked for."""

    def __init__(self, follower: Follower) -> None:
        """Of a user that hears the team, and is no member of it."""
        self.follower, self._times = follower, follower.team.times
        self._asked: dict[str, TaskAnnounce] = {}
        self._canceled: set[str] = set()
        self._next_s = 0.0

    def add(self, tasks: Sequence[TaskAnnounce]) -> list[str]:
        """Ask for tasks.

        Returns:
            What a user may want to know, a sentence each.

        Raises:
            TaskError: of a task that is not legal; none was asked for.
        """
        said = check_tasks(tasks, self._known(), self.follower.team.robots)
        self._asked |= {task.task_id: task for task in tasks}
        return said

    def cancel(self, task_id: str) -> None:
        """A task shall not be done any more.

        Raises:
            TaskError: it is unknown.
        """
        if task_id not in self._known():
            legal = ", ".join(self._known()) or "none"
            raise TaskError(f"task {task_id!r}: unknown, legal: {legal}")
        self._canceled.add(task_id)

    def pending(self) -> list[str]:
        """What the newest manager is not known to have heard."""
        shown, records = self.follower.shown, self.follower.book.records
        asked = [name for name in self._asked if name not in shown]
        ended = {name for name, record in records.items() if record.over}
        return asked + sorted(self._canceled - ended)

    def on_message(self, source: str, message: TaskMessage, now_s: float) -> None:
        """Take in what a member has sent."""
        if isinstance(message, TaskTable):
            self.follower.hear(source, message, now_s)

    def on_time(self, now_s: float) -> list[Sent]:
        """What is due by now."""
        if now_s < self._next_s:
            return []
        self._next_s = now_s + self._times.retry_s
        waiting = self.pending()
        sent = [
            Sent(task)
            for name, task in self._asked.items()
            if name in waiting and name not in self._canceled
        ]
        return sent + [
            Sent(TaskProgress(now_s, name, 0, NOBODY, 0.0, 0.0, State.WITHDRAWN, "canceled"))
            for name in sorted(self._canceled)
            if name in waiting
        ]

    def _known(self) -> dict[str, TaskAnnounce]:
        records = self.follower.book.records
        return self._asked | {name: record.task for name, record in records.items()}
