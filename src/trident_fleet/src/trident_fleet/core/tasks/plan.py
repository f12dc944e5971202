# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a robot is going to do one after the other, and what one more task would cost it."""

from __future__ import annotations

import enum
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from trident_fleet.core.tasks.fields import Capabilities, Requirements
from trident_fleet.core.tasks.messages import Point, TaskAnnounce

# From one place to another: length of the path through what the robot moves in [m], infinite where
# no path exists. Where water moves, it is the path through the water: time times speed.
Travel = Callable[[Point, Point], float]

straight_line: Travel = math.dist

# A makespan is the longest finish; among equal ones, shorter paths are better.
_PATH_SHARE = 1e-3


class Objective(enum.Enum):
    """What an allocation is judged by."""

    SUM = "sum"  # of the lengths of the paths [m], small is good
    MAKESPAN = "makespan"  # when the last robot has finished [s], small is good
    VALUE = "value"  # of the tasks done by their deadlines, large is good


@dataclass(frozen=True)
class Job:
    """A task as a plan needs it: its announcement, and what that asks, read once."""

    task: TaskAnnounce
    asked: Requirements

    @staticmethod
    def of(task: TaskAnnounce) -> Job:
        """Read the requirements.

        Raises:
            TaskError: they are not legal.
        """
        return Job(task, Requirements.from_json(task.requirements, f"task {task.task_id!r}"))

    @property
    def task_id(self) -> str:
        """Of the task."""
        return self.task.task_id


@dataclass(frozen=True)
class Timing:
    """A route as it would be carried out.

    Attributes:
        length_m: of the path [m].
        finish_s: when the last task is done [s].
        energy_j: that it takes [J].
        starts_s: when the work at each task begins [s].
        value: of all tasks.
    """

    length_m: float
    finish_s: float
    energy_j: float
    starts_s: tuple[float, ...]
    value: float


@dataclass(frozen=True)
class Insertion:
    """One more task in a route.

    Attributes:
        cost: what the objective loses, at least 0.
        index: where in the route.
        start_s: when the work at it begins [s].
        energy_j: that it takes more [J].
    """

    cost: float
    index: int
    start_s: float
    energy_j: float


class Plan:
    """The route of one robot: the jobs that are its own, in order."""

    def __init__(
        self,
        robot: str,
        can: Capabilities,
        place: Point,
        travel: Travel = straight_line,
        objective: Objective = Objective.SUM,
    ) -> None:
        """An empty route of a robot that is at `place`, p_common [m], at time 0."""
        self.robot, self.can, self.travel, self.objective = robot, can, travel, objective
        self.place, self.now_s, self.energy_j = place, 0.0, can.energy_j
        self.jobs: list[Job] = []
        self.version = 0
        self._found: dict[tuple[str, int], Insertion | None] = {}
        self._own: list[Timing | None] = []  # of the route as it is, once it is known

    def copy(self) -> Plan:
        """The same route, to try something."""
        other = Plan(self.robot, self.can, self.place, self.travel, self.objective)
        other.now_s, other.energy_j, other.jobs = self.now_s, self.energy_j, list(self.jobs)
        return other

    def moved(self, place: Point, now_s: float, energy_j: float | None = None) -> None:
        """The robot is here now, with this much energy left (None: as it was)."""
        self.place, self.now_s = place, now_s
        self._forget()
        self.energy_j = self.energy_j if energy_j is None else energy_j

    def _forget(self) -> None:
        self._found.clear()
        self._own.clear()

    def _timing_now(self) -> Timing | None:
        if not self._own:
            self._own.append(self.timing())
        return self._own[0]

    def lacks(self, job: Job) -> list[str]:
        """What the job asks and the robot has not."""
        return self.can.lacks(job.asked)

    def has(self, task_id: str) -> bool:
        """Whether the task is in the route."""
        return any(job.task_id == task_id for job in self.jobs)

    def insert(self, job: Job, index: int) -> None:
        """Take a job into the route."""
        self.jobs.insert(index, job)
        self._forget()
        self.version += 1

    def remove(self, task_id: str) -> None:
        """Leave a job, if it is there."""
        kept = [job for job in self.jobs if job.task_id != task_id]
        self.version += len(kept) != len(self.jobs)
        self.jobs = kept
        self._forget()

    def timing(self, jobs: Sequence[Job] | None = None) -> Timing | None:
        """Carry out a route in mind.

        Args:
            jobs: in order; None: the robot's route.

        Returns:
            How it goes; None if a deadline, the energy or a path fails.
        """
        place, now_s, length_m, energy_j, value = self.place, self.now_s, 0.0, 0.0, 0.0
        starts_s = []
        for job in self.jobs if jobs is None else jobs:
            task = job.task
            leg_m = self.travel(place, task.place)
            arrival_s = now_s + leg_m / self.can.speed_m_s
            start_s = max(arrival_s, job.asked.not_before_s)
            done_s = start_s + task.duration_s
            energy_j += self.can.travel_power_w * leg_m / self.can.speed_m_s
            energy_j += self.can.work_power_w * (done_s - arrival_s)
            if not done_s <= task.deadline_s or not energy_j <= self.energy_j or leg_m == math.inf:
                return None
            place, now_s, length_m, value = task.place, done_s, length_m + leg_m, value + task.value
            starts_s.append(start_s)
        return Timing(length_m, now_s, energy_j, tuple(starts_s), value)

    def best_insertion(self, job: Job, first: int = 0) -> Insertion | None:
        """Where in the route a job costs least; None if it does not fit, or lacks something.

        Args:
            job: that is not in the route.
            first: no earlier than this: what comes before has been begun.
        """
        key = (job.task_id, first)
        if key not in self._found:
            self._found[key] = None if self.lacks(job) else self._best_insertion(job, first)
        return self._found[key]

    def _best_insertion(self, job: Job, first: int) -> Insertion | None:
        before = self._timing_now()
        indices = sorted(
            range(min(first, len(self.jobs)), len(self.jobs) + 1),
            key=lambda index: self._detour(job, index),
        )
        for index in indices:
            found = self._insertion(job, index, before)
            if found is not None:
                return found
        return None

    def saving(self, task_id: str) -> float:
        """How much shorter the path would be without a task of the route [m], at least 0."""
        now, without = (
            self.timing(jobs)
            for jobs in (self.jobs, [job for job in self.jobs if job.task_id != task_id])
        )
        return max(now.length_m - without.length_m, 0.0) if now and without else 0.0

    def last_insertion(self, job: Job) -> Insertion | None:
        """The job after all others; None if it does not fit, or lacks something."""
        return None if self.lacks(job) else self._insertion(job, len(self.jobs), self._timing_now())

    def _detour(self, job: Job, index: int) -> float:
        """Additional path of the job at this place in the route [m]."""
        here = job.task.place
        last = self.jobs[index - 1].task.place if index else self.place
        detour_m = self.travel(last, here)
        if index < len(self.jobs):
            after = self.jobs[index].task.place
            detour_m += self.travel(here, after) - self.travel(last, after)
        return detour_m

    def _insertion(self, job: Job, index: int, before: Timing | None) -> Insertion | None:
        jobs = [*self.jobs[:index], job, *self.jobs[index:]]
        after = self.timing(jobs)
        if after is None:
            return None
        old = before or Timing(0.0, self.now_s, 0.0, (), 0.0)
        detour_m = max(after.length_m - old.length_m, 0.0)
        energy_j = max(after.energy_j - old.energy_j, 0.0)
        return Insertion(
            self._price(job, detour_m, after, old), index, after.starts_s[index], energy_j
        )

    def _price(self, job: Job, detour_m: float, after: Timing, before: Timing) -> float:
        if self.objective is Objective.MAKESPAN:
            return after.finish_s + _PATH_SHARE * detour_m / self.can.speed_m_s
        if self.objective is Objective.VALUE:
            more_s = max(after.finish_s - before.finish_s, 0.0)
            return more_s / job.task.value if job.task.value > 0.0 else math.inf
        return detour_m


def announced(job: Job, **changed: object) -> Job:
    """The same job, with other fields in its announcement."""
    return replace(job, task=replace(job.task, **changed))  # type: ignore[arg-type]
