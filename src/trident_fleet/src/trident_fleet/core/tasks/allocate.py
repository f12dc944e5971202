# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""All auctions at once in one process: who does what, if every message comes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from trident_fleet.core.tasks.bound_tasks import give_bound, is_bound
from trident_fleet.core.tasks.fields import Capabilities
from trident_fleet.core.tasks.intake import check_tasks
from trident_fleet.core.tasks.messages import Point, TaskAnnounce
from trident_fleet.core.tasks.methods.base import Method, Offer, by_cost
from trident_fleet.core.tasks.methods.improved import Improved
from trident_fleet.core.tasks.plan import Job, Objective, Plan, Timing, Travel, straight_line


@dataclass(frozen=True)
class Allocation:
    """Who does what.

    Attributes:
        routes: task ids of each robot, in order; a task for several robots is in several routes.
        length_m: of all paths together [m].
        finish_s: when the last robot has finished [s].
        value: of all tasks that are done.
        messages: that were needed.
        left: tasks that nobody does.
    """

    routes: dict[str, list[str]]
    length_m: float
    finish_s: float
    value: float
    messages: int
    left: list[str]


def allocate(
    robots: dict[str, tuple[Capabilities, Point]],
    tasks: Sequence[TaskAnnounce],
    method: Method,
    objective: Objective = Objective.SUM,
    travel: Travel | Mapping[str, Travel] = straight_line,
    messages_per_task: int = 40,
) -> Allocation:
    """Hold the auctions of all tasks.

    First those for one robot each that wait for nothing. Those for several robots, and those that
    come after others, follow in an order in which nobody waits for what comes later, each after all
    that its robots have: so a plan is true about when everybody is there. Robots trade only what
    was given away before.

    Args:
        robots: what they can do and where they are, p_common [m].
        tasks: the same in any order.
        method: of allocation.
        objective: of the team.
        travel: length of a path between places [m], of all robots, or of each by name.
        messages_per_task: bound for methods that trade.

    Raises:
        TaskError: of a task that is not legal.
    """
    check_tasks(tasks, {}, {name: can for name, (can, _) in robots.items()})
    plans = _plans(robots, objective, travel)
    waiting = [Job.of(task) for task in tasks if not is_bound(task)]
    messages = _auctions(plans, waiting, method)
    if isinstance(method, Improved):
        limit = messages_per_task * len(tasks) - messages
        messages += method.refine(list(plans.values()), limit)
    messages += give_bound(plans, [task for task in tasks if is_bound(task)], waiting, method)
    return _result(plans, waiting, messages)


def _plans(
    robots: dict[str, tuple[Capabilities, Point]],
    objective: Objective,
    travel: Travel | Mapping[str, Travel],
) -> dict[str, Plan]:
    """Of robots that have no task yet."""
    travels = travel if isinstance(travel, Mapping) else dict.fromkeys(robots, travel)
    return {
        name: Plan(name, can, place, travels[name], objective)
        for name, (can, place) in robots.items()
    }


def _auctions(plans: dict[str, Plan], waiting: list[Job], method: Method) -> int:
    """Give away what is waiting; what nobody takes stays there. Returns the messages."""
    messages, announced, refused = 0, set[str](), list[Job]()
    said: dict[str, tuple[int, frozenset[str], list[Offer]]] = {}
    while waiting:
        jobs = list(method.offered(waiting))
        ids = {job.task_id for job in jobs}
        messages += len(ids - announced)
        announced |= ids
        for name, plan in plans.items():
            if method.one_each and plan.jobs:
                said.pop(name, None)
                continue
            version, known, bids = said.get(name, (-1, frozenset(), []))
            gone = any(bid.task_id not in ids for bid in bids)
            if version != plan.version or gone or not ids <= known:
                bids = method.bids(plan, jobs, 0)
                messages += max(len(bids), 1)
                said[name] = plan.version, frozenset(ids), bids
        offers = sorted((bid for _, _, bids in said.values() for bid in bids), key=by_cost)
        won = _take(plans, jobs, method, offers)
        messages += 2 * len(won)
        waiting[:] = [job for job in waiting if job.task_id not in won]
        if not won:
            refused += jobs
            waiting[:] = [job for job in waiting if job.task_id not in ids]
    waiting += refused
    return messages


def _take(
    plans: dict[str, Plan], jobs: Sequence[Job], method: Method, offers: Sequence[Offer]
) -> set[str]:
    by_id = {job.task_id: job for job in jobs}
    won = set()
    for offer in method.winners(offers):
        plan, job = plans[offer.robot], by_id[offer.task_id]
        insertion = method.place(plan, job, 0)
        if insertion is not None:
            plan.insert(job, insertion.index)
            won.add(offer.task_id)
    return won


def _result(plans: dict[str, Plan], waiting: Sequence[Job], messages: int) -> Allocation:
    done = _timings(plans)
    return Allocation(
        {name: [job.task_id for job in plan.jobs] for name, plan in plans.items()},
        sum(timing.length_m for timing in done),
        max((timing.finish_s for timing in done), default=0.0),
        _value(plans),
        messages,
        [job.task_id for job in waiting],
    )


def _timings(plans: dict[str, Plan]) -> list[Timing]:
    timings = [plan.timing() for plan in plans.values()]
    done = [timing for timing in timings if timing is not None]
    assert len(done) == len(plans)
    return done


def _value(plans: dict[str, Plan]) -> float:
    """Of all tasks of the routes; those for several robots count once."""
    jobs = (job for plan in plans.values() for job in plan.jobs)
    return sum({job.task_id: job.task.value for job in jobs}.values())
