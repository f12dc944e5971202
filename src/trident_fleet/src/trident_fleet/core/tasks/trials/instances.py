# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Random instances: robots and tasks anywhere on a square, by seed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from random import Random
from typing import Any

from trident_fleet.core.tasks.fields import Capabilities
from trident_fleet.core.tasks.messages import Point, TaskAnnounce

SIDE_M = 100.0
WORK_S = 5.0  # at each task
_SPEEDS_M_S = (1.0, 2.0, 3.0)
_ROBOTS, _TASKS = (3, 30), (5, 200)


@dataclass(frozen=True)
class Instance:
    """Robots that have nothing to do, and tasks for one robot each.

    Attributes:
        seed: of all of it.
        robots: what they can do, and where they are, p_common [m].
        tasks: all of the same value and duration.
    """

    seed: int
    robots: dict[str, tuple[Capabilities, Point]]
    tasks: list[TaskAnnounce]

    @property
    def name(self) -> str:
        """Size and seed."""
        return f"{len(self.robots)}x{len(self.tasks)}/{self.seed}"

    def as_numbers(self) -> dict[str, Any]:
        """What another solver needs: starts and places [m], speeds [m/s], work [s]."""
        return {
            "name": self.name,
            "starts": [place[:2] for _, place in self.robots.values()],
            "places": [task.place[:2] for task in self.tasks],
            "speeds": [can.speed_m_s for can, _ in self.robots.values()],
            "work": WORK_S,
        }


def random_instance(robots: int, tasks: int, seed: int) -> Instance:
    """An instance of a size."""
    random = Random(seed)

    def point() -> Point:
        return (random.uniform(0.0, SIDE_M), random.uniform(0.0, SIDE_M), 0.0)

    team = {
        f"r{index}": (Capabilities("ground", speed_m_s=random.choice(_SPEEDS_M_S)), point())
        for index in range(robots)
    }
    work = [
        TaskAnnounce(0.0, f"t{index}", "", 0, "visit", "", point(), WORK_S)
        for index in range(tasks)
    ]
    return Instance(seed, team, work)


def some_instances(count: int) -> list[Instance]:
    """Seeds 0 ... count - 1: 3 ... 30 robots, 5 ... 200 tasks, the sizes of tasks by logarithm."""
    made = []
    for seed in range(count):
        random = Random(f"size {seed}")
        robots = random.randint(*_ROBOTS)
        tasks = round(math.exp(random.uniform(*map(math.log, _TASKS))))
        made.append(random_instance(robots, tasks, seed))
    return made
