# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Which runs count: all seeds of a point, or as many as are enough."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from trident_eval.core.sweep.jobs import Job
from trident_eval.core.sweep.rows import DONE, RunRow
from trident_eval.core.sweep.scenario import Enough
from trident_eval.core.sweep.statistics import half_width


class Selection:
    """Follows the rows as they come.

    A point has enough after the first seed at which its interval is narrow enough, in the order of
    the seeds and not in that in which runs end: what counts depends on no worker's speed.
    """

    def __init__(self, jobs: Sequence[Job], enough: Enough | None) -> None:
        """Follow these jobs, whose order within a point is that of the seeds."""
        self._enough = enough
        self._by_point: dict[int, list[Job]] = {}
        for job in jobs:
            self._by_point.setdefault(job.point, []).append(job)
        self._rows: dict[str, RunRow] = {}
        self._checked: dict[int, int] = dict.fromkeys(self._by_point, 0)
        self._last: dict[int, int] = {}  # of a point: how many of its jobs count

    def add(self, row: RunRow) -> None:
        """Takes a row in."""
        self._rows[row.key] = row
        if self._enough is not None and row.point not in self._last:
            self._look(row.point, self._enough)

    def is_needed(self, job: Job) -> bool:
        """Whether a run is still to be made."""
        if job.key in self._rows:
            return False
        return job.point not in self._last

    def rows(self) -> list[RunRow]:
        """The rows that count, by point and seed."""
        return [
            self._rows[job.key]
            for point, jobs in sorted(self._by_point.items())
            for job in jobs[: self._last.get(point, len(jobs))]
            if job.key in self._rows
        ]

    @property
    def narrowed(self) -> Mapping[int, int]:
        """Points that had enough before their last seed, with the number of seeds that count."""
        return self._last

    def width(self, point: int) -> float:
        """Half of the interval of a point now; infinite without one."""
        return half_width(self._values(point, len(self._by_point[point])))

    def _look(self, point: int, enough: Enough) -> None:
        jobs = self._by_point[point]
        while self._checked[point] < len(jobs):
            count = self._checked[point] + 1
            if jobs[count - 1].key not in self._rows:
                return
            self._checked[point] = count
            values = self._values(point, count)
            if count >= enough.least and half_width(values) <= enough.half_width:
                self._last[point] = count
                return

    def _values(self, point: int, count: int) -> list[float]:
        if self._enough is None:
            return []
        rows = (self._rows.get(job.key) for job in self._by_point[point][:count])
        metric = self._enough.metric
        return [row.metrics[metric] for row in rows if row is not None and row.status == DONE]
