# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What is checked before a task is taken in, and before a bid counts."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from trident_fleet.core.tasks.fields import Capabilities, Requirements, TaskError, nobody_can
from trident_fleet.core.tasks.messages import TaskAnnounce, TaskBid
from trident_fleet.core.tasks.plan import Job


def check_tasks(
    new: Sequence[TaskAnnounce],
    known: Mapping[str, TaskAnnounce],
    robots: dict[str, Capabilities],
) -> list[str]:
    """Check tasks that come together.

    Args:
        new: the tasks.
        known: that are there already.
        robots: of the team.

    Returns:
        What a user may want to know, a sentence each: requirements that no robot has.

    Raises:
        TaskError: names task, field, value and legal range.
    """
    together = _together(new, known)
    for task in new:
        check_fields(task, len(robots))
        _check_after(task, set(together))
    _check_order(together)
    said = (nobody_can(f"task {task.task_id!r}", Job.of(task).asked, robots) for task in new)
    return [text for text in said if text is not None]


def _together(
    new: Sequence[TaskAnnounce], known: Mapping[str, TaskAnnounce]
) -> dict[str, TaskAnnounce]:
    """New tasks after those that are known, by their names, each of which is there once."""
    together = dict(known)
    for task in new:
        if task.task_id in together:
            raise TaskError(f"task {task.task_id!r}: task_id is there already, legal: a new one")
        together[task.task_id] = task
    return together


def _check_after(task: TaskAnnounce, known: set[str]) -> None:
    """Refuse a task that waits for an unknown one."""
    for before in task.after:
        if before not in known:
            raise TaskError(
                f"task {task.task_id!r}: after is {before!r}, an unknown task, legal: "
                f"{', '.join(sorted(known - {task.task_id})) or 'none'}"
            )


def is_same(one: TaskAnnounce, other: TaskAnnounce) -> bool:
    """Whether two announcements are of one task, in any auction of it."""
    auction = {
        name: getattr(other, name) for name in ("stamp_s", "manager", "round", "bids_until_s")
    }
    return replace(one, **auction) == other


def check_fields(task: TaskAnnounce, robots: int) -> None:
    """Check a task for itself.

    Args:
        task: it.
        robots: of the team, how many.

    Raises:
        TaskError: names task, field, value and legal range.
    """
    owner = f"task {task.task_id!r}"
    if not task.task_id:
        raise TaskError("task: task_id is empty, legal: a name")
    _check_numbers(owner, task)
    if task.requirements:
        Requirements.from_json(task.requirements, owner)
    if not 1 <= task.robots_needed <= max(robots, 1):
        raise TaskError(
            f"{owner}: robots_needed is {task.robots_needed}, legal: 1 ... {max(robots, 1)}"
        )


def _check_numbers(owner: str, task: TaskAnnounce) -> None:
    """Refuse a place, a duration, a value or a deadline that cannot be."""
    if len(task.place) != 3 or not all(math.isfinite(value) for value in task.place):
        raise TaskError(f"{owner}: place is {task.place}, legal: three finite numbers")
    problem = _negative(owner, task, ("duration_s", "value"))
    if problem is not None:
        raise TaskError(problem)
    if not task.deadline_s > 0.0:
        raise TaskError(f"{owner}: deadline_s is {task.deadline_s}, legal: above 0")


def _negative(owner: str, message: TaskAnnounce | TaskBid, names: Sequence[str]) -> str | None:
    """Which of the fields is not finite and from 0; None: they all are."""
    for name in names:
        value = getattr(message, name)
        if not 0.0 <= value < math.inf:
            return f"{owner}: {name} is {value}, legal: finite, from 0"
    return None


def _check_order(tasks: Mapping[str, TaskAnnounce]) -> None:
    """Refuse tasks that wait for each other."""
    settled: set[str] = set()
    for first in tasks:
        path: list[str] = []
        stack = [(first, iter(tasks[first].after))]
        path.append(first)
        while stack:
            name, rest = stack[-1]
            before = next(rest, None)
            if before is None:
                stack.pop()
                path.pop()
                settled.add(name)
            elif before in path:
                circle = " after ".join([*path[path.index(before) :], before])
                raise TaskError(
                    f"task {before!r}: after is circular: {circle}, legal: an order without circles"
                )
            elif before not in settled:
                path.append(before)
                stack.append((before, iter(tasks[before].after)))


def refuse_bid(bid: TaskBid, source: str, robots: Mapping[str, Capabilities]) -> str | None:
    """Why a bid is bad input; None: it is not."""
    owner = f"bid of {source} for task {bid.task_id!r}"
    if bid.robot_id != source or bid.robot_id not in robots:
        legal = source if source in robots else ", ".join(robots)
        return f"{owner}: robot_id is {bid.robot_id!r}, legal: {legal}"
    return _negative(owner, bid, ("cost", "start_s", "energy"))
