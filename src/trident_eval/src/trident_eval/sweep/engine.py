# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What carries runs out: this machine, or a Dask cluster."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Protocol

from trident_eval.core.sweep.jobs import Job


class Engine(Protocol):
    """Carries jobs out; each leaves its row in the folder of the sweep before it is completed."""

    @property
    def workers(self) -> int:
        """How many runs there are at a time."""

    def submit(self, job: Job) -> None:
        """Hands a job over."""

    def as_completed(self, timeout_s: float) -> Iterator[str]:
        """Keys of the jobs that have ended since; waits for the first, at most so long [s].

        Raises:
            EvalError: the engine, or the folder, is of no more use.
        """

    def cancel(self) -> None:
        """Ends all that is running, and leaves no row of it."""

    def close(self) -> None:
        """Ends the engine and its processes."""
