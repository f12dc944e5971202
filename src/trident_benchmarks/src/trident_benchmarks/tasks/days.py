# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Hard days: a third of all messages lost, a partition, and the deaths of a manager and a robot."""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from typing import Any

import numpy as np
from trident_fleet.core.tasks.methods import DEFAULT
from trident_fleet.core.tasks.trials.invariants import BrokenError
from trident_fleet.core.tasks.trials.scenes import Scene, asked_scene, hard_day

RATIO = 3.0  # limit of the finish over that of the same day without any loss or death
ROBOTS, TASKS, WORK_S = 5, 20, 6.0
_UNTIL_S = 600.0


@dataclass(frozen=True)
class Day:
    """How a day has ended.

    Attributes:
        seed: of all of it.
        finish_s: when every task was done, or reported as one that is not [s].
        lossless_s: the same, if nothing befalls the team [s].
        stuck: tasks that were neither at the end.
        lost: tasks that were not done, and nobody has reported.
        reported: tasks that were not done, with the reason.
        broken: the invariant that did not hold.
        messages: that were sent.
    """

    seed: int
    finish_s: float
    lossless_s: float
    stuck: tuple[str, ...]
    lost: tuple[str, ...]
    reported: dict[str, str]
    broken: str
    messages: int


def a_day(seed: int) -> Day:
    """One day, and the same without anything that befalls."""
    made = hard_day(seed, DEFAULT, robots=ROBOTS, tasks=TASKS, work_s=WORK_S)
    lossless = asked_scene(seed, method=DEFAULT, robots=ROBOTS, tasks=TASKS, work_s=WORK_S)
    broken = ""
    for scene in (made, lossless):
        try:
            scene.run(_UNTIL_S)
        except BrokenError as error:
            broken = str(error)
    finish_s, lossless_s = (scene.rehearsal.channel.now() for scene in (made, lossless))
    stuck = () if broken else tuple(made.rehearsal.open_tasks())
    reported = _reported(made)
    done = {task_id for _, task_id, _ in made.rehearsal.happened.done}
    lost = tuple(name for name in made.watch.tasks if name not in done and name not in reported)
    sent = made.rehearsal.channel.counts["sent"]
    return Day(seed, finish_s, lossless_s, stuck, () if broken else lost, reported, broken, sent)


def _reported(made: Scene) -> dict[str, str]:
    member = made.rehearsal.manager()
    return {} if member is None or member.manager is None else dict(member.manager.ledger.reasons)


def days(count: int) -> Iterator[Day]:
    """Days by seed, from 0, on all cores that this process may use."""
    with ProcessPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        yield from pool.map(a_day, range(count), chunksize=8)


def judged(found: list[Day]) -> dict[str, Any]:
    """The row of all days."""
    ratios = [day.finish_s / day.lossless_s for day in found]
    figures: dict[str, Any] = {
        "stuck": sum(bool(day.stuck) for day in found),
        "lost": sum(bool(day.lost) for day in found),
        "broken": sum(bool(day.broken) for day in found),
        "ratio": float(max(ratios)),
    }
    limits = {"stuck": 0, "lost": 0, "broken": 0, "ratio": RATIO}
    bad = [
        {"seed": day.seed, "stuck": day.stuck, "lost": day.lost, "broken": day.broken}
        for day in found
        if day.stuck or day.lost or day.broken
    ]
    return {
        "suite": "days",
        "row": f"{ROBOTS} robots, {TASKS} tasks of {WORK_S:g} s",
        "method": DEFAULT,
        "days": len(found),
        **figures,
        "ratio_mean": float(np.mean(ratios)),
        "ratio_p95": float(np.percentile(ratios, 95)),
        "slowest_seed": found[int(np.argmax(ratios))].seed,
        "reported": sum(len(day.reported) for day in found),
        "messages_per_task": float(np.mean([day.messages for day in found])) / TASKS,
        "bad": bad,
        "limits": limits,
        "passed": all(figures[name] <= limit for name, limit in limits.items()),
    }
