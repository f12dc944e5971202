# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A process that has the modules of a sweep loaded, and forks one process for each run.

A fork costs milliseconds, a Python with numpy a tenth of a second. The processes of the next runs
are made ahead, and wait at a gate; one passes when a run before it is over, while that still writes
its row. The server is single-threaded, ends with the one that has started it, and takes its runs
along.
"""

from __future__ import annotations

import contextlib
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
    """A process. `gate` is open from its making to the end of its function; None: that is over."""

    job: Job
    pid: int
    pidfd: int
    gate: socket.socket | None
    started: str
    attempt: int
    begin: float | None = None  # when it passed the gate
    is_late: bool = False

    @property
    def is_at_work(self) -> bool:
        return self.begin is not None and self.gate is not None


class ForkServer:
    """Carries out what comes over the channel, in its order, until it closes."""

    def __init__(self, channel: Channel, folder: Path, workers: int) -> None:
        """Rows go to the folder of the sweep; so many runs are at work at a time."""
        self._channel, self._folder, self._workers = channel, folder, workers
        self._waiting: deque[tuple[Job, int]] = deque()  # each with the number of its attempt
        self._selector = selectors.DefaultSelector()
        self._selector.register(channel, selectors.EVENT_READ)
        self._running: dict[int, _Running] = {}  # by pidfd

    def serve(self) -> None:
        """Works until the other end closes; ends all runs then."""
        while not self._channel.closed:
            for key, _ in self._selector.select(self._until_next_limit_s()):
                run: _Running | None = key.data
                if run is None:
                    self._take_messages()
                elif key.fd == run.pidfd and key.fd in self._running:
                    self._take_ended(run)
                elif key.fileobj is run.gate:
                    self._close_gate(run)
                self._let_begin()
            self._end_late()
            while self._waiting and len(self._running) < 2 * self._workers:
                self._start(*self._waiting.popleft())
            self._let_begin()
        self._end_all()

    def _take_messages(self) -> None:
        for message in self._channel.receive(0.0):
            if "cancel" in message:
                self._end_all()
                self._channel.send({"cancelled": True})
            else:
                self._waiting.append((Job.from_json(message["job"]), 1))

    def _start(self, job: Job, attempt: int) -> None:
        ours, theirs = socket.socketpair()
        pid = os.fork()
        if pid == 0:
            self._channel.close()
            ours.close()
            carry_out(job, self._folder, theirs)
        theirs.close()
        pidfd = os.pidfd_open(pid)
        run = _Running(job, pid, pidfd, ours, now_text(), attempt)
        self._running[pidfd] = run
        self._selector.register(pidfd, selectors.EVENT_READ, run)
        self._selector.register(ours, selectors.EVENT_READ, run)

    def _let_begin(self) -> None:
        """The oldest ones pass their gates, as long as there is room."""
        room = self._workers - sum(run.is_at_work for run in self._running.values())
        for run in self._running.values():
            if room <= 0:
                return
            if run.begin is None and run.gate is not None:
                run.started, run.begin = now_text(), time.monotonic()
                with contextlib.suppress(OSError):  # its process has ended; that is seen elsewhere
                    run.gate.send(b"!")
                room -= 1

    def _close_gate(self, run: _Running) -> None:
        if run.gate is not None:
            self._selector.unregister(run.gate)
            run.gate.close()
            run.gate = None

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
        elapsed_s = 0.0 if run.begin is None else round(time.monotonic() - run.begin, 6)
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
        self._close_gate(run)
        self._selector.unregister(run.pidfd)
        os.close(run.pidfd)
        del self._running[run.pidfd]
        return status

    def _until_next_limit_s(self) -> float | None:
        limits = [
            run.begin + run.job.time_s
            for run in self._running.values()
            if run.begin is not None and not run.is_late
        ]
        return max(0.0, min(limits) - time.monotonic()) if limits else None

    def _end_late(self) -> None:
        now = time.monotonic()
        for run in self._running.values():
            if run.begin is not None and not run.is_late and now >= run.begin + run.job.time_s:
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
