# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A mission from its beginning to its end, with what is drawn of it."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from trident_fleet.core.missions.mission import Mission
from trident_fleet.core.missions.setup import Outcome
from trident_fleet.core.search.area import Mask

Place = tuple[float, float]


@dataclass(frozen=True)
class Work:
    """A robot at a task: its kind, from and to when [s]."""

    robot: str
    task_id: str
    kind: str
    begin_s: float
    end_s: float


@dataclass
class Record:
    """What robots did.

    Attributes:
        tracks: places by robot, one a step, p_common [m].
        work: tasks in the order in which they ended.
        coverage: time [s] and share of the cells that were covered, now and then.
        covered: cells that were covered at the end.
    """

    tracks: dict[str, list[Place]] = field(default_factory=dict)
    work: list[Work] = field(default_factory=list)
    coverage: list[tuple[float, float]] = field(default_factory=list)
    covered: Mask | None = None
    _current: dict[str, Work] = field(default_factory=dict)

    def note(self, mission: Mission) -> None:
        """Take in how things stand after a step."""
        for name, crew in mission.crews.items():
            if crew.alive:
                self.tracks.setdefault(name, []).append(crew.vehicle.place)
            held = crew.robot.task() if crew.alive else None
            task = (held.job.task.task_id, held.job.task.kind) if held is not None else None
            self.note_task(name, mission.now_s, task)
        self.coverage.append((mission.now_s, mission.truth.coverage.share()))

    def note_task(self, name: str, now_s: float, task: tuple[str, str] | None) -> None:
        """What a robot is at from now on: name and kind of the task; None: it has none."""
        last = self._current.get(name)
        if last is not None and (task is None or last.task_id != task[0]):
            self.work.append(Work(name, last.task_id, last.kind, last.begin_s, now_s))
            del self._current[name]
        if task is not None and name not in self._current:
            self._current[name] = Work(name, *task, now_s, math.inf)

    def end(self, mission: Mission) -> None:
        """Take in the end."""
        for name in list(self._current):
            self.note_task(name, mission.now_s, None)
        self.covered = mission.truth.coverage.covered()


def fly(mission: Mission, until_s: float = math.inf) -> tuple[Outcome, Record]:
    """Steps a mission until it is over, or a time [s]."""
    record = Record()
    while not mission.is_over() and mission.now_s < until_s:
        mission.step()
        record.note(mission)
    record.end(mission)
    return mission.outcome(), record
