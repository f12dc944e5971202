# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs a command so that nothing of it outlives its caller: ``supervisor.py FD MODE COMMAND …``.

roslaunch gives each node a session of its own, and a process that is killed by SIGKILL takes no
child with it. So every command that may start others runs below this small process. It adopts all
orphans among its descendants (it is a child subreaper, see prctl(2)), and holds one end of a socket
whose other end only its caller holds. When the caller ends, however that happens, the socket ends,
and then whatever the command has started is interrupted, and killed if it does not end. It needs no
rights.

MODE is ``session`` (a session of its own, so that a Ctrl-C at the terminal reaches the caller only,
and what is left when the command ends is ended, too) or ``terminal`` (the caller's terminal, for an
interactive shell, which may leave jobs behind as shells do).

It is run by its path, with nothing but Python's own library, so that it starts at once.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import resource
import select
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

# Together below 5 s: nothing is left then, whatever does not listen.
INTERRUPT_S = 3.2  # roslaunch interrupts its nodes and waits for them, the master comes last
AT_TERMINAL_S = 1.6  # of these, for a command that has had the terminal's Ctrl-C before
LEFT_OVER_S = 0.8  # for those that their own parent has left behind
TERMINATE_S = 0.6
DONE = b"."  # sent to the caller: nothing is left
_POLL_S = 0.02
_KILL_LIMIT_S = 10.0
_PR_SET_PDEATHSIG = 1
_PR_SET_CHILD_SUBREAPER = 36
_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGCHLD)


def adopt_orphans() -> None:
    """Makes this process the parent of each descendant whose own parent ends."""
    ctypes.CDLL(None, use_errno=True).prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)


def end_with_parent(number: int = signal.SIGTERM) -> None:
    """Has the kernel send this process a signal when its parent ends."""
    ctypes.CDLL(None, use_errno=True).prctl(_PR_SET_PDEATHSIG, number, 0, 0, 0)


def descendants(pid: int) -> list[int]:
    """Processes that descend from ``pid`` and still run."""
    children: dict[int, list[int]] = {}
    for folder in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError, ValueError, IndexError):
            # The name in brackets may hold anything, also brackets and blanks.
            fields = (folder / "stat").read_text("utf-8", "replace").rpartition(")")[2].split()
            if fields[0] not in "ZX":
                children.setdefault(int(fields[1]), []).append(int(folder.name))
    found: list[int] = []
    front = [pid]
    while front:
        front = [child for parent in front for child in children.get(parent, [])]
        found += front
    return found


def reap() -> dict[int, int]:
    """Takes note of children that have ended: process id -> wait status."""
    ended = {}
    with contextlib.suppress(ChildProcessError):
        while True:
            pid, status = os.waitpid(-1, os.WNOHANG)
            if pid == 0:
                break
            ended[pid] = status
    return ended


def send(pids: list[int], number: int) -> None:
    """Sends a signal to those of the processes that are there and ours."""
    for pid in pids:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.kill(pid, number)


def end_descendants(is_interrupted: bool = False, take_note: Callable[[], object] = reap) -> None:
    """Ends all descendants of this process: interrupted, terminated, killed.

    Args:
        is_interrupted: whether they have been interrupted before, and had their time.
        take_note: of children that have ended.
    """
    steps = [(signal.SIGINT, LEFT_OVER_S), (signal.SIGTERM, TERMINATE_S)]
    for number, patience_s in steps[is_interrupted:]:
        send(descendants(os.getpid()), number)
        if _gone(time.monotonic() + patience_s, take_note):
            return
    # A fork may slip through between looking and killing, but its child is found the next time.
    # What runs by another user's rights cannot be killed.
    deadline = time.monotonic() + _KILL_LIMIT_S
    while (left := descendants(os.getpid())) and time.monotonic() < deadline:
        send(left, signal.SIGKILL)
        time.sleep(_POLL_S)
        take_note()


def _gone(deadline: float, take_note: Callable[[], object]) -> bool:
    """Whether no descendant is left before the deadline [s, monotonic]."""
    while descendants(os.getpid()):
        if time.monotonic() > deadline:
            return False
        time.sleep(_POLL_S)
        take_note()
    take_note()
    return True


class Supervisor:
    """One command, the socket to its caller, and the signals of this process."""

    def __init__(self, lifeline: int, has_session: bool) -> None:
        """Adopt orphans and listen.

        Args:
            lifeline: the socket; it reads as ended when the caller has ended.
            has_session: whether the command gets a session of its own.
        """
        self._lifeline = lifeline
        self._has_session = has_session
        self._status: int | None = None
        self._command = 0
        self._asked: list[int] = []
        adopt_orphans()
        self._woken, waker = os.pipe()
        os.set_blocking(waker, False)
        os.set_blocking(self._woken, False)
        signal.set_wakeup_fd(waker, warn_on_full_buffer=False)
        for number in _SIGNALS:
            signal.signal(number, self._note)

    def _note(self, number: int, _frame: object) -> None:
        # At a terminal the interrupt goes to the command, too, which does with it what it likes.
        if number != signal.SIGCHLD and (self._has_session or number != signal.SIGINT):
            self._asked.append(number)

    def _reap(self) -> None:
        self._status = reap().get(self._command, self._status)

    def run(self, command: list[str]) -> int:
        """Run it to its end, or to that of the caller; its exit code as subprocess has it."""
        try:
            process = subprocess.Popen(
                command, start_new_session=self._has_session, preexec_fn=end_with_parent
            )
        except OSError as error:
            print(f"trident: {command[0]}: {error.strerror}", file=sys.stderr)
            return 127
        self._command = process.pid
        self._wait()
        if self._status is None:
            self._interrupt()
        elif self._has_session:
            end_descendants(take_note=self._reap)
        process.returncode = 0  # it has been reaped here
        return os.waitstatus_to_exitcode(self._status or 0)

    def _wait(self) -> None:
        """For the end of the command, or of the caller, or a signal."""
        self._reap()
        while self._status is None and not self._asked:
            ready, _, _ = select.select([self._lifeline, self._woken], [], [])
            if self._woken in ready:
                os.read(self._woken, 4096)
            if self._lifeline in ready:
                self._asked.append(signal.SIGHUP)
            self._reap()

    def _interrupt(self) -> None:
        """The command first, which ends its own children in order; then whatever is left."""
        if self._has_session:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self._command, signal.SIGINT)  # as a terminal's Ctrl-C does
        else:
            send([self._command], signal.SIGHUP)
        patience_s = INTERRUPT_S - (0.0 if self._has_session else AT_TERMINAL_S)
        deadline = time.monotonic() + patience_s
        while self._status is None and time.monotonic() < deadline:
            time.sleep(_POLL_S)
            self._reap()
        end_descendants(self._status is None, self._reap)


def end_alike(code: int) -> int:
    """Ends this process by the signal that ended the command; returns its exit code if none did."""
    if code < 0:
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))  # the command's own core is the one to see
        with contextlib.suppress(OSError, ValueError):
            signal.signal(-code, signal.SIG_DFL)
        os.kill(os.getpid(), -code)
    return code


def main(arguments: list[str]) -> int:
    """Supervise; returns the command's exit code, or ends by the signal that ended it."""
    lifeline, mode, *command = arguments
    code = Supervisor(int(lifeline), mode == "session").run(command)
    with contextlib.suppress(OSError):
        os.write(int(lifeline), DONE)
    return end_alike(code)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
