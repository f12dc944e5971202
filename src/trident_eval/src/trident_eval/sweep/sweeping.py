# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The sweep itself: what is still to be run is run, until all is there or enough."""

from __future__ import annotations

import json
import math
import time
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from trident_eval.core.sweep.comparing import compare
from trident_eval.core.sweep.jobs import Job
from trident_eval.core.sweep.page import sweep_page
from trident_eval.core.sweep.plots import draw
from trident_eval.core.sweep.rows import DONE, RunRow, read_row
from trident_eval.core.sweep.scenario import Scenario
from trident_eval.core.sweep.selection import Selection
from trident_eval.core.sweep.tables import replace_file, summary, write_tables
from trident_eval.sweep.engine import Engine
from trident_eval.sweep.progress import Progress

_WAIT_S = 0.5
_AHEAD = 3  # runs handed over for each worker: one at work, one made ahead, one that writes


@dataclass
class _State:
    done: int
    failed: int
    running: int = 0


class Sweep:
    """A scenario, the folder of its rows, and which of them count."""

    def __init__(self, scenario: Scenario, jobs: Sequence[Job], folder: Path, code: str) -> None:
        """Takes in what is there already."""
        self.scenario, self.folder, self.code = scenario, folder, code
        self._jobs = list(jobs)
        self._selection = Selection(jobs, scenario.enough)
        self._state = _State(0, 0)
        self._taken: set[str] = set()
        self.look()
        self.found = self._state.done

    def look(self) -> None:
        """Takes in what is there and was not reported, as after an interruption."""
        for job in self._jobs:
            if job.key not in self._taken:
                self._take(job.key)

    @property
    def wanted(self) -> int:
        """How many runs there are with all seeds."""
        return len(self._jobs)

    @property
    def missing(self) -> list[Job]:
        """The runs that are still to be made."""
        return [job for job in self._jobs if self._selection.is_needed(job)]

    def rows(self) -> list[RunRow]:
        """The rows that count."""
        return self._selection.rows()

    @property
    def failed(self) -> int:
        """Runs that have failed."""
        return self._state.failed

    def run(self, engine: Engine) -> None:
        """Makes the missing runs.

        Raises:
            EvalError: the engine is of no more use.
            KeyboardInterrupt: Ctrl-C; what has ended is there.
        """
        waiting = deque(self.missing)
        progress = Progress(self.wanted, self._state.done)
        try:
            while waiting or self._state.running:
                self._hand_out(engine, waiting)
                for key in engine.as_completed(_WAIT_S):
                    self._state.running -= 1
                    self._take(key)
                self._show(progress, len(waiting))
        finally:
            progress.close()

    def write(self, command: str) -> None:
        """Writes the tables, summary.json and report.html of what is there.

        Raises:
            OSError: the disk is full, or not to be written.
        """
        rows = self._selection.rows()
        compared = compare(self.scenario.comparisons, rows)
        write_tables(self.scenario, rows, self.folder)
        narrowed = self._selection.narrowed
        found = summary(self.scenario, rows, narrowed, self.code, self.wanted)
        text = json.dumps(found, indent=2, allow_nan=False) + "\n"
        replace_file(self.folder / "summary.json", text.encode())
        pictures = draw(self.scenario, rows, compared, self.folder / "pictures")
        page = sweep_page(self.scenario, rows, compared, pictures, self._about(), command)
        replace_file(self.folder / "report.html", page.encode())

    def _about(self) -> str:
        rows = self._selection.rows()
        failed = sum(row.status != DONE for row in rows)
        parts = [
            f"{self.scenario.subject}",
            f"{len(rows)} of {self.wanted} runs",
            f"{failed} failed",
            f"code {self.code}",
            time.strftime("%Y-%m-%d %H:%M"),
        ]
        return ", ".join(parts)

    def _hand_out(self, engine: Engine, waiting: deque[Job]) -> None:
        while waiting and self._state.running < _AHEAD * engine.workers:
            job = waiting.popleft()
            if self._selection.is_needed(job):
                engine.submit(job)
                self._state.running += 1

    def _take(self, key: str) -> None:
        row = read_row(self.folder, key)
        if row is not None:
            self._taken.add(key)
            self._selection.add(row)
            self._state.done += 1
            self._state.failed += row.status != DONE

    def _show(self, progress: Progress, left: int) -> None:
        state = self._state
        progress.show(state.done, state.failed, state.running, left + state.running, self._widest)

    def _widest(self) -> float:
        """Half of the widest interval of all points; infinite where none is asked for."""
        if self.scenario.enough is None:
            return math.inf
        return max(map(self._selection.width, {job.point for job in self._jobs}), default=math.inf)
