# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs on a Dask cluster: one that is there, or one of this machine.

Workers get the data of a job and the name of a function of this package; each has a fork server of
its own, so that a run is a process of its own here, too.
"""

from __future__ import annotations

import contextlib
import queue
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.core.sweep.jobs import Job
from trident_eval.core.sweep.rows import RunRow, read_row, write_row
from trident_eval.sweep.carry_out import failed_row, now_text
from trident_eval.sweep.code_version import machine_facts, unlike
from trident_eval.sweep.local_engine import LocalEngine

_CONNECT_S = 30
_CLOSE_S = 2  # wall time; an interrupted sweep ends within 3 s
_INSTALL = "pip install dask distributed"
_POLL_S = 3600.0
_servers: dict[tuple[str, str], LocalEngine] = {}  # of this process, where it is a worker


def import_distributed() -> Any:
    """The package distributed.

    Raises:
        EvalError: it is not installed.
    """
    try:
        import distributed
    except ImportError as error:
        raise EvalError(f"engine dask: {error}; install it: {_INSTALL}") from error
    return distributed


def run_on_worker(job: dict[str, Any], folder: str) -> dict[str, Any]:
    """One job in a worker; returns its row."""
    one = Job.from_json(job)
    found = read_row(Path(folder), one.key)
    if found is None:
        place = (folder, one.subject)
        if place not in _servers:
            _servers[place] = LocalEngine(Path(folder), one.subject, 1)
        _servers[place].submit(one)
        while one.key not in _servers[place].as_completed(_POLL_S):
            pass
        found = read_row(Path(folder), one.key)
    if found is None:
        raise EvalError(f"{folder}: the row of {one.key} is not there")
    return found.to_json()


class DaskEngine:
    """Carries jobs out on the workers of a scheduler that are like this machine."""

    def __init__(self, folder: Path, subject: str, workers: int, address: str) -> None:
        """Connects.

        Args:
            folder: of the sweep; workers of this machine write into it.
            subject: of all jobs.
            workers: to start, where no address is given.
            address: of a scheduler, tcp://HOST:PORT; "": one that is started here, on loopback.

        Raises:
            EvalError: no distributed, no scheduler, or no worker that is like this machine.
        """
        distributed = import_distributed()
        self._folder = folder
        self._cluster = None if address else start_cluster(workers)
        try:
            self._client = distributed.Client(
                address or self._cluster, timeout=_CONNECT_S, set_as_default=False
            )
        except OSError as error:
            raise EvalError(f"{address}: {error}; legal: a running scheduler") from error
        self._ended: queue.SimpleQueue[Any] = queue.SimpleQueue()
        self._submitted: dict[str, tuple[Job, Any]] = {}
        self._like_us = self._choose_workers(subject)

    @property
    def workers(self) -> int:
        """Workers that are like this machine."""
        return len(self._like_us)

    def submit(self, job: Job) -> None:
        """Hands a job to one of the workers."""
        future = self._client.submit(
            run_on_worker,
            job.to_json(),
            str(self._folder),
            key=f"run-{job.key}",
            workers=None if self._cluster else self._like_us,
            pure=False,
            retries=0,
        )
        self._submitted[job.key] = (job, future)
        future.add_done_callback(lambda ended: self._ended.put((job.key, ended)))

    def as_completed(self, timeout_s: float) -> Iterator[str]:
        """Keys of runs that have ended; see Engine."""
        try:
            yield self._take(*self._ended.get(timeout=timeout_s))
            while True:
                yield self._take(*self._ended.get_nowait())
        except queue.Empty:
            if self._client.status not in ("running", "connecting"):
                raise EvalError("the scheduler has gone; the same command continues") from None

    def cancel(self) -> None:
        """Ends what is running; workers end the processes of runs that nobody waits for."""
        self._client.cancel([future for _, future in self._submitted.values()], force=True)
        self._submitted.clear()

    def close(self) -> None:
        """Ends the connection, and the cluster if it was started here."""
        end_in_time(self._client)
        if self._cluster is not None:
            end_in_time(self._cluster)

    def _take(self, key: str, future: Any) -> str:
        job, _ = self._submitted.pop(key, (None, None))
        if job is None or future.status == "cancelled":
            return key
        problem = future.exception()
        if problem is None:
            row = RunRow(**future.result())
        else:  # e.g. each worker that had it was killed
            row = failed_row(job, f"{type(problem).__name__}: {problem}"[:300], now_text(), 0.0)
        if read_row(self._folder, key) is None:  # a worker that does not share our disk
            write_row(self._folder, row)
        return key

    def _choose_workers(self, subject: str) -> list[str]:
        self._client.wait_for_workers(1, timeout=_CONNECT_S)
        ours = machine_facts(subject)
        chosen = []
        for address, theirs in self._client.run(machine_facts, subject, on_error="return").items():
            problem = str(theirs) if isinstance(theirs, Exception) else unlike(ours, theirs)
            if problem:
                print(f"worker {address} is left out: {problem}", file=sys.stderr)
            else:
                chosen.append(address)
        if not chosen:
            raise EvalError("no worker is like this machine")
        return chosen


def end_in_time(ended: Any) -> None:
    """Closes a client or cluster; what takes long ends with this process, whose child it is.

    All rows are written by then, so that a machine with no time to spare is no reason to fail.
    """
    with contextlib.suppress(TimeoutError):
        ended.close(timeout=_CLOSE_S)


def start_cluster(workers: int, port: int = 0) -> Any:
    """A scheduler and workers on loopback, each worker a process with one thread."""
    distributed = import_distributed()
    return distributed.LocalCluster(
        n_workers=workers,
        threads_per_worker=1,
        processes=True,
        host="127.0.0.1",
        scheduler_port=port,
        dashboard_address=None,
    )
