# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Allocation of tasks that are bound to others: in an order, or to several robots at one time.

Robots take them after all that they have, one task after the other, in an order in which each comes
after those that it waits for. So nothing that is planned later delays what was planned before, no
two robots wait for each other, and the time at which all are there is known when it is planned.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from trident_fleet.core.tasks.messages import TaskAnnounce
from trident_fleet.core.tasks.methods.base import Method, Offer, by_cost, offer_of
from trident_fleet.core.tasks.plan import Job, Plan


def is_bound(task: TaskAnnounce) -> bool:
    """Whether a task waits for others, or for several robots."""
    return bool(task.after) or task.robots_needed > 1


def give_bound(
    plans: dict[str, Plan], tasks: Sequence[TaskAnnounce], left: list[Job], method: Method
) -> int:
    """Give them to the robots that bid lowest.

    Args:
        plans: of all robots; they change.
        tasks: all of them bound.
        left: what nobody does; it grows.
        method: of the team; it says whether a robot has one task at most.

    Returns:
        Messages that were needed.
    """
    finished_s = _finishes(plans)
    missing = {job.task_id for job in left}
    messages = 0
    for task in _in_order(tasks):
        job = Job.of(task)
        offers: list[Offer] = []
        if not missing & set(task.after):
            offers = _offers(plans, _not_before(job, _ready_s(task, finished_s)), method)
        messages += 1 + len(offers)
        chosen = offers[: task.robots_needed]
        begin_s = _begin_s(chosen)
        together = _not_before(job, begin_s)
        if len(chosen) < task.robots_needed or not _all_fit(plans, chosen, together):
            left.append(job)
            missing.add(task.task_id)
            continue
        _insert_last(plans, chosen, together)
        finished_s[task.task_id] = begin_s + task.duration_s
        messages += 2 * len(chosen)
    return messages


def _in_order(tasks: Sequence[TaskAnnounce]) -> list[TaskAnnounce]:
    """Each after those that it waits for; there is no circle."""
    waiting = {task.task_id: task for task in tasks}
    ordered: list[TaskAnnounce] = []
    while waiting:
        ready = [task for task in waiting.values() if not set(task.after) & set(waiting)]
        ordered += ready
        for task in ready:
            del waiting[task.task_id]
    return ordered


def _finishes(plans: dict[str, Plan]) -> dict[str, float]:
    """When each task of the routes is done [s]."""
    finished_s = {}
    for plan in plans.values():
        timing = plan.timing()
        assert timing is not None
        for job, start_s in zip(plan.jobs, timing.starts_s, strict=True):
            finished_s[job.task_id] = start_s + job.task.duration_s
    return finished_s


def _ready_s(task: TaskAnnounce, finished_s: dict[str, float]) -> float:
    """When all that a task waits for is done [s]."""
    return max((finished_s.get(name, 0.0) for name in task.after), default=0.0)


def _begin_s(chosen: Sequence[Offer]) -> float:
    """When the last one of the robots that do a task together is there [s]."""
    return max((offer.start_s for offer in chosen), default=0.0)


def _insert_last(plans: dict[str, Plan], chosen: Sequence[Offer], job: Job) -> None:
    for offer in chosen:
        plan = plans[offer.robot]
        plan.insert(job, len(plan.jobs))


def _not_before(job: Job, ready_s: float) -> Job:
    return replace(job, asked=replace(job.asked, not_before_s=max(job.asked.not_before_s, ready_s)))


def _offers(plans: dict[str, Plan], job: Job, method: Method) -> list[Offer]:
    found = [
        (plan, plan.last_insertion(job))
        for plan in plans.values()
        if not (method.one_each and plan.jobs)
    ]
    offers = [offer_of(plan, job, insertion) for plan, insertion in found if insertion is not None]
    return sorted(offers, key=by_cost)


def _all_fit(plans: dict[str, Plan], chosen: Sequence[Offer], job: Job) -> bool:
    """Whether the last one does not come too late for another one's deadline or energy."""
    return all(plans[offer.robot].last_insertion(job) is not None for offer in chosen)
