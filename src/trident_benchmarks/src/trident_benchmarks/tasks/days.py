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

from trident_benchmarks.results import keeps

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

    @property
    def is_bad(self) -> bool:
        """Whether something went wrong that must not."""
        return bool(self.stuck or self.lost or self.broken)

    def record(self) -> dict[str, Any]:
        """What went wrong."""
        return {
            "seed": self.seed,
            "stuck": self.stuck,
            "lost": self.lost,
            "broken": self.broken,
        }


def a_day(seed: int) -> Day:
    """One day, and the same without anything that befalls."""
    made = hard_day(seed, DEFAULT, robots=ROBOTS, tasks=TASKS, work_s=WORK_S)
    lossless = asked_scene(seed, method=DEFAULT, robots=ROBOTS, tasks=TASKS, work_s=WORK_S)
    broken = _broken(made, lossless)
    finish_s, lossless_s = (scene.rehearsal.channel.now() for scene in (made, lossless))
    stuck = () if broken else tuple(made.rehearsal.open_tasks())
    reported = _reported(made)
    lost = () if broken else _lost(made, reported)
    sent = made.rehearsal.channel.counts["sent"]
    return Day(seed, finish_s, lossless_s, stuck, lost, reported, broken, sent)


def _broken(*scenes: Scene) -> str:
    """Run scenes; the invariant that one has broken, the last one if several have."""
    broken = ""
    for scene in scenes:
        try:
            scene.run(_UNTIL_S)
        except BrokenError as error:
            broken = str(error)
    return broken


def _lost(made: Scene, reported: dict[str, str]) -> tuple[str, ...]:
    done = {task_id for _, task_id, _ in made.rehearsal.happened.done}
    return tuple(name for name in made.watch.tasks if name not in done and name not in reported)


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
    bad = [day.record() for day in found if day.is_bad]
    figures = _counts(bad) | {"ratio": float(max(ratios))}
    limits = {"stuck": 0, "lost": 0, "broken": 0, "ratio": RATIO}
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
        "passed": keeps(figures, limits),
    }


def _counts(bad: list[dict[str, Any]]) -> dict[str, float]:
    """How many days ended with something that must not be."""
    return {name: sum(bool(one[name]) for one in bad) for name in ("stuck", "lost", "broken")}
