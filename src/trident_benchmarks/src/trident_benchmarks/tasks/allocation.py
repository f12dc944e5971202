# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows about allocation in one process: how far from the best each method ends."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from random import Random
from typing import Any

import numpy as np
from trident_fleet.core.assignment import cheapest_pairs
from trident_fleet.core.tasks.allocate import allocate
from trident_fleet.core.tasks.methods import DEFAULT, METHODS
from trident_fleet.core.tasks.plan import Objective
from trident_fleet.core.tasks.trials.exact import exact
from trident_fleet.core.tasks.trials.instances import Instance, random_instance, some_instances

from trident_benchmarks.results import keeps
from trident_benchmarks.tasks.table import INSTANCES, SECONDS, Table

# Limits: of gaps over a yardstick as shares, of CPU time, of messages for each task.
MEAN_GAP, WORST_GAP, FEW_GAP, ONE_EACH_GAP, MAKESPAN_GAP = 0.02, 0.08, 0.01, 0.001, 0.10
LARGE_CPU_S, MESSAGES = 1.5, 40.0

_MANY_EACH = [name for name, method in METHODS.items() if not method.one_each]
_ONE_EACH = ["auction", "plain", "nearest"]
#: What an objective counts of an allocation.
_COLUMNS = {Objective.SUM: "length_m", Objective.MAKESPAN: "finish_s"}


def gaps_row(
    what: str, method: str, gaps: Sequence[float], limits: dict[str, float], **more: Any
) -> dict[str, Any]:
    """A row: how far above the yardstick a method ends.

    Args:
        what: the yardstick and the instances.
        method: its name.
        gaps: as shares, one for each instance.
        limits: of `mean` and `worst`; none: the row is there to be compared with.
        more: other figures.
    """
    figures = {"mean": float(np.mean(gaps)), "worst": float(max(gaps))}
    return {
        "suite": "allocation",
        "row": what,
        "method": method,
        "instances": len(gaps),
        **figures,
        "gaps": [round(gap, 6) for gap in gaps],
        "limits": limits,
        "passed": keeps(figures, limits),
        **more,
    }


def against_table(table: Table, objective: Objective, quick: bool) -> list[dict[str, Any]]:
    """All methods against OR-tools' values, or the default one where the last finish counts."""
    cases = _known_cases(table, objective)[: 4 if quick else None]
    names = _MANY_EACH if objective is Objective.SUM else [DEFAULT]
    return [_against_values(cases, name, objective) for name in names] if cases else []


def _known_cases(table: Table, objective: Objective) -> list[tuple[Instance, float]]:
    """The instances of the table with their values."""
    return [
        (made, float(row[_COLUMNS[objective]]))
        for made in some_instances(INSTANCES)
        if (row := table.get((made.name, objective.value))) is not None
    ]


def _against_values(
    cases: Sequence[tuple[Instance, float]], name: str, objective: Objective
) -> dict[str, Any]:
    """One method against the known value of each instance."""
    found = [allocate(made.robots, made.tasks, METHODS[name], objective) for made, _ in cases]
    gaps = [
        getattr(one, _COLUMNS[objective]) / value - 1.0
        for one, (_, value) in zip(found, cases, strict=True)
    ]
    messages = [one.messages / len(made.tasks) for one, (made, _) in zip(found, cases, strict=True)]
    return gaps_row(
        f"{objective.value} over OR-tools at {SECONDS:.0f} s",
        name,
        gaps,
        _limits(name, objective),
        messages_per_task=float(max(messages)),
        of_instances=INSTANCES,
    )


def _limits(name: str, objective: Objective) -> dict[str, float]:
    """Of the gaps of a method over OR-tools."""
    if objective is not Objective.SUM:
        return {"mean": MAKESPAN_GAP}
    return {"mean": MEAN_GAP, "worst": WORST_GAP} if name == DEFAULT else {}


def against_exact(count: int) -> list[dict[str, Any]]:
    """Up to seven tasks, against the best that there is."""
    cases = [random_instance(2 + seed % 4, 4 + seed % 4, seed) for seed in range(count)]
    rows = []
    for objective, limit in ((Objective.SUM, FEW_GAP), (Objective.MAKESPAN, MAKESPAN_GAP)):
        is_span = objective is Objective.MAKESPAN
        gaps = []
        for made in cases:
            found = allocate(made.robots, made.tasks, METHODS[DEFAULT], objective)
            reached = found.finish_s if is_span else found.length_m
            gaps.append(reached / exact(made.robots, made.tasks, is_span) - 1.0)
        what = f"{objective.value} of 4 ... 7 tasks over the optimum"
        rows.append(gaps_row(what, DEFAULT, gaps, {"mean": limit}))
    return rows


def against_hungarian(count: int) -> list[dict[str, Any]]:
    """As many robots as tasks, one for each, against the Hungarian method."""
    cases = [_paired_case(seed) for seed in range(count)]
    rows = []
    for name in _ONE_EACH:
        gaps = [_one_each(made, name) / best - 1.0 for made, best in cases]
        limits = {"worst": ONE_EACH_GAP} if name == "auction" else {}
        rows.append(gaps_row("one task each over the Hungarian method", name, gaps, limits))
    return rows


def _paired_case(seed: int) -> tuple[Instance, float]:
    """An instance, and the least length of all paths by one task for each robot [m]."""
    size = Random(f"one each {seed}").randint(3, 30)
    made = random_instance(size, size, seed)
    cost = np.array(
        [[math.dist(place, task.place) for task in made.tasks] for _, place in made.robots.values()]
    )
    return made, float(cost[cheapest_pairs(cost)].sum())


def _one_each(made: Instance, name: str) -> float:
    """Length of all paths if no robot gets a second task [m]."""
    method = METHODS[name]
    if method.one_each:
        return allocate(made.robots, made.tasks, method).length_m
    left, length_m = dict(made.robots), 0.0
    for task in made.tasks:
        found = allocate(left, [task], method)
        length_m += found.length_m
        (winner,) = (robot for robot, route in found.routes.items() if route)
        del left[winner]
    return length_m


def large(count: int) -> list[dict[str, Any]]:
    """30 robots and 200 tasks: CPU time and messages."""
    cpu_s, messages = [], []
    for seed in range(count):
        made = random_instance(30, 200, seed)
        begin_s = time.process_time()
        found = allocate(made.robots, made.tasks, METHODS[DEFAULT])
        cpu_s.append(time.process_time() - begin_s)
        messages.append(found.messages / len(made.tasks))
    return [
        {
            "suite": "allocation",
            "row": "30 robots, 200 tasks",
            "method": DEFAULT,
            "instances": count,
            "cpu_s": float(np.median(cpu_s)),
            "messages_per_task": max(messages),
            "limits": {"cpu_s": LARGE_CPU_S, "messages_per_task": MESSAGES},
            "passed": bool(np.median(cpu_s) <= LARGE_CPU_S and max(messages) <= MESSAGES),
        }
    ]


def suites(table: Table, quick: bool) -> list[Callable[[], list[dict[str, Any]]]]:
    """What is measured, one after the other."""
    return [
        lambda: against_table(table, Objective.SUM, quick),
        lambda: against_table(table, Objective.MAKESPAN, quick),
        lambda: against_exact(4 if quick else 60),
        lambda: against_hungarian(3 if quick else 60),
        lambda: large(1 if quick else 5),
    ]
