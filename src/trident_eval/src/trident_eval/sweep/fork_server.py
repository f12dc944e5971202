# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A process that has the modules of a sweep loaded, and forks one process for each run.

A fork costs milliseconds, a Python with numpy a tenth of a second. It is single-threaded, ends with
the one that has started it, and takes its runs along.
"""

from __future__ import annotations

import os
import selectors
import signal
import socket
import sys
import time
from collections import deque
from dataclasses import dataclass
from pathlib import Path

from trident_eval.core.errors import EvalError
from trident_eval.core.sweep.jobs import Job
from trident_eval.core.sweep.rows import read_row, write_row
from trident_eval.sweep.carry_out import (
    CANNOT_WRITE,
    carry_out,
    failed_row,
    load_function,
    now_text,
)
from trident_eval.sweep.channel import Channel

# A run that somebody else has killed is made again: that is no failure of the run.
ATTEMPTS = 4


@dataclass
class _Running:
    job: Job
    pid: int
    pidfd: int
    started: str
    begin: float
    attempt: int
    is_late: bool = False


class ForkServer:
    """Carries out what comes over the channel, in its order, until it closes."""

    def __init__(self, channel: Channel, folder: Path, workers: int) -> None:
        """Rows go to the folder of the sweep; so many workers are at work at a time."""
        self._channel, self._folder, self._workers = channel, folder, workers
        self._waiting: deque[tuple[Job, int]] = deque()  # each with the number of its attempt
        self._selector = selectors.DefaultSelector()
        self._selector.register(channel, selectors.EVENT_READ)
        self._running: dict[int, _Running] = {}  # by pidfd

    def serve(self) -> None:
        """Works until the other end closes; ends all runs then."""
        while not self._channel.closed:
            for key, _ in self._selector.select(self._until_next_limit_s()):
                if key.fileobj is self._channel:
                    self._take_messages()
                elif key.fd in self._running:
                    self._take_ended(self._running[key.fd])
            self._end_late()
            while self._waiting and len(self._running) < self._workers:
                self._start(*self._waiting.popleft())
        self._end_all()

    def _take_messages(self) -> None:
        for message in self._channel.receive(0.0):
            if "cancel" in message:
                self._end_all()
                self._channel.send({"cancelled": True})
            else:
                self._waiting.append((Job.from_json(message["job"]), 1))

    def _start(self, job: Job, attempt: int) -> None:
        started, begin = now_text(), time.monotonic()
        pid = os.fork()
        if pid == 0:
            self._channel.close()
            carry_out(job, self._folder)
        pidfd = os.pidfd_open(pid)
        self._running[pidfd] = _Running(job, pid, pidfd, started, begin, attempt)
        self._selector.register(pidfd, selectors.EVENT_READ)

    def _take_ended(self, run: _Running) -> None:
        status = os.waitstatus_to_exitcode(self._forget(run))
        if read_row(self._folder, run.job.key) is not None:
            self._channel.send({"done": run.job.key})
            return
        if status == CANNOT_WRITE:
            self._refuse(run)
            return
        if status == -signal.SIGKILL and not run.is_late and run.attempt < ATTEMPTS:
            self._waiting.appendleft((run.job, run.attempt + 1))
            return
        self._write_failed(run, _reason(run, status))

    def _write_failed(self, run: _Running, reason: str) -> None:
        elapsed_s = round(time.monotonic() - run.begin, 6)
        try:
            write_row(self._folder, failed_row(run.job, reason, run.started, elapsed_s))
            self._channel.send({"done": run.job.key})
        except OSError:
            self._refuse(run)

    def _refuse(self, run: _Running) -> None:
        self._channel.send({"refused": f"{self._folder}: a row cannot be written (is it full?)"})

    def _forget(self, run: _Running) -> int:
        """Takes a process' end in, with all that it has started; returns its wait status."""
        _kill_group(run.pid)
        _, status = os.waitpid(run.pid, 0)
        self._selector.unregister(run.pidfd)
        os.close(run.pidfd)
        del self._running[run.pidfd]
        return status

    def _until_next_limit_s(self) -> float | None:
        limits = [run.begin + run.job.time_s for run in self._running.values() if not run.is_late]
        return max(0.0, min(limits) - time.monotonic()) if limits else None

    def _end_late(self) -> None:
        now = time.monotonic()
        for run in self._running.values():
            if not run.is_late and now >= run.begin + run.job.time_s:
                run.is_late = True
                _kill_group(run.pid)

    def _end_all(self) -> None:
        self._waiting.clear()
        for run in list(self._running.values()):
            self._forget(run)


def _reason(run: _Running, status: int) -> str:
    if run.is_late:
        return f"it took longer than {run.job.time_s:g} s"
    if status == -signal.SIGKILL:
        return f"killed by SIGKILL, {run.attempt} times (out of memory?)"
    if status < 0:
        return f"ended by {signal.Signals(-status).name}"
    return f"ended with exit code {status} and no result"


def _kill_group(pid: int) -> None:
    # Until it has made its own group, it is known by its number alone.
    for kill in (os.killpg, os.kill):
        try:
            kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            continue


def main(arguments: list[str]) -> int:
    """Serve over a file descriptor: FD FOLDER SUBJECT WORKERS."""
    descriptor, folder, subject, workers = arguments
    channel = Channel(socket.socket(fileno=int(descriptor)))
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the sweep decides what Ctrl-C ends
    try:
        load_function(subject)
    except EvalError as error:
        channel.send({"refused": str(error)})
        return 2
    channel.send({"ready": True})
    ForkServer(channel, Path(folder), int(workers)).serve()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
