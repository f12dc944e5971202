# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs on this machine, by a fork server."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

from trident_eval.core.errors import EvalError
from trident_eval.core.sweep.jobs import Job
from trident_eval.core.sweep.rows import read_row
from trident_eval.sweep.channel import Channel

# Each run has one thread; there are as many runs at a time as there are cores.
_ONE_THREAD = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "NUMEXPR_NUM_THREADS",
    "BLIS_NUM_THREADS",
    "RAYON_NUM_THREADS",
)
_STARTS = 100  # of fork servers that somebody kills, before it is given up
_LOAD_S = 300.0  # the modules of a subject may take so long to load


class LocalEngine:
    """Carries jobs out in processes of this machine."""

    def __init__(self, folder: Path, subject: str, workers: int) -> None:
        """Starts the fork server.

        Args:
            folder: of the sweep.
            subject: of all jobs.
            workers: runs at a time.

        Raises:
            EvalError: the subject cannot be loaded.
        """
        self._folder, self._subject, self._workers = folder, subject, workers
        self._submitted: dict[str, Job] = {}
        self._starts = 0
        self._start()

    @property
    def workers(self) -> int:
        """Runs at a time."""
        return self._workers

    def submit(self, job: Job) -> None:
        """Starts a run."""
        self._submitted[job.key] = job
        self._channel.send({"job": job.to_json()})

    def as_completed(self, timeout_s: float) -> Iterator[str]:
        """Keys of runs that have ended; see Engine."""
        messages = self._channel.receive(timeout_s)
        if not messages and self._channel.closed:
            yield from self._begin_again()
        for message in messages:
            if "refused" in message:
                raise EvalError(message["refused"])
            if message.get("done") in self._submitted:
                del self._submitted[message["done"]]
                yield message["done"]

    def cancel(self) -> None:
        """Ends all runs that are running."""
        self._submitted.clear()
        self._channel.send({"cancel": True})
        self._wait_for("cancelled")

    def close(self) -> None:
        """Ends the fork server, and its runs."""
        self._channel.close()
        self._process.wait()

    def _start(self) -> None:
        self._starts += 1
        if self._starts > _STARTS:
            raise EvalError(f"the fork server was killed {_STARTS} times")
        ours, theirs = socket.socketpair()
        env = {**os.environ, **dict.fromkeys(_ONE_THREAD, "1")}
        module = "trident_eval.sweep.fork_server"
        words = [str(theirs.fileno()), str(self._folder), self._subject, str(self._workers)]
        # A session of its own: Ctrl-C of a terminal does not reach it, nor its runs.
        self._process = subprocess.Popen(
            [sys.executable, "-m", module, *words],
            env=env,
            pass_fds=[theirs.fileno()],
            stdin=subprocess.DEVNULL,
            start_new_session=True,
        )
        theirs.close()
        self._channel = Channel(ours)
        self._wait_for("ready")

    def _wait_for(self, word: str) -> None:
        end = time.monotonic() + _LOAD_S
        while not self._channel.closed and time.monotonic() < end:
            for message in self._channel.receive(end - time.monotonic()):
                if "refused" in message:
                    raise EvalError(message["refused"])
                if word in message:
                    return
        if time.monotonic() >= end:
            raise EvalError(f"{self._subject}: not loaded within {_LOAD_S:g} s")

    def _begin_again(self) -> Iterator[str]:
        """After the fork server was killed: what has no row is made again."""
        self._process.wait()
        self._channel.close()
        self._start()
        for job in list(self._submitted.values()):
            if read_row(self._folder, job.key) is not None:
                del self._submitted[job.key]
                yield job.key
            else:
                self.submit(job)
