# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Processes in the background, which end with a block."""

from __future__ import annotations

import contextlib
import signal
import socket
import subprocess
import sys
import weakref
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import FrameType
from typing import Any

from trident_tool.supervisor import AT_TERMINAL_S, DONE, adopt_orphans, end_descendants

_SUPERVISOR = Path(__file__).with_name("supervisor.py")
_END_LIMIT_S = 20.0  # it takes below 5 s; more where the machine is very slow
_POLL_S = 0.2
_ENDINGS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
_AFTERWARDS_S = 5.0


class Supervised(subprocess.Popen[bytes]):
    """A command below a supervisor: nothing of it outlives this process, or ``end``."""

    def __init__(
        self,
        command: Sequence[str | Path],
        env: Mapping[str, str] | None = None,
        *,
        at_terminal: bool = False,
        **streams: Any,
    ) -> None:
        """Start it.

        Args:
            command: program and arguments.
            env: the whole environment; None: this process' own.
            at_terminal: it stays in this terminal's foreground, as a shell must.
            streams: stdin, stdout, stderr and cwd as of subprocess.Popen.
        """
        adopt_orphans()  # should the supervisor be killed, they are this process' children
        self._lifeline, other = socket.socketpair()
        mode = "terminal" if at_terminal else "session"
        words = [sys.executable, "-I", "-S", str(_SUPERVISOR), str(other.fileno()), mode]
        with other:
            super().__init__(
                [*words, *(str(word) for word in command)],
                env=None if env is None else dict(env),
                pass_fds=[other.fileno()],
                start_new_session=not at_terminal,
                **streams,
            )
        _running.add(self)

    def ask_to_end(self) -> None:
        """Has the supervisor begin to end it."""
        with contextlib.suppress(OSError):
            self._lifeline.shutdown(socket.SHUT_WR)

    def end(self) -> int:
        """Interrupts the command, kills what does not end, and returns its exit code."""
        self.ask_to_end()
        try:
            self.wait(_END_LIMIT_S)
        except subprocess.TimeoutExpired:
            self.kill()
            self.wait()
        with self._lifeline, contextlib.suppress(OSError):
            if self._lifeline.fileno() >= 0 and self._lifeline.recv(1) != DONE:
                end_descendants()  # the supervisor was killed itself
        return self.returncode


_running: weakref.WeakSet[Supervised] = weakref.WeakSet()


@contextlib.contextmanager
def _handled(handlers: Mapping[int, Any]) -> Iterator[None]:
    """In the block these signals have these handlers."""
    before = {number: signal.signal(number, handler) for number, handler in handlers.items()}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@contextlib.contextmanager
def undisturbed() -> Iterator[None]:
    """A second Ctrl-C does not keep the block from ending what the first one has asked to end."""
    with _handled(dict.fromkeys(_ENDINGS, signal.SIG_IGN)):
        yield


@contextlib.contextmanager
def ends_by_exception() -> Iterator[None]:
    """In the block SIGINT, SIGTERM and SIGHUP raise KeyboardInterrupt, so that it is left in order.

    A SIGHUP that was ignored before, as below nohup, still is.
    """

    def interrupt(number: int, _frame: FrameType | None) -> None:
        raise KeyboardInterrupt(number)

    ignored = {signal.SIGHUP} if signal.getsignal(signal.SIGHUP) == signal.SIG_IGN else set()
    with _handled({number: interrupt for number in _ENDINGS if number not in ignored}):
        yield


@contextlib.contextmanager
def supervised(
    command: Sequence[str | Path], env: Mapping[str, str] | None = None, **options: Any
) -> Iterator[Supervised]:
    """A process that ends with the block, however that is left.

    Args:
        command: program and arguments.
        env: its environment.
        options: of Supervised.
    """
    process = Supervised(command, env, **options)
    try:
        yield process
    except KeyboardInterrupt:
        for other in _running:  # all at once, for one after the other would take as many times 5 s
            other.ask_to_end()
        raise
    finally:
        with undisturbed():
            process.end()


def run_supervised(
    command: Sequence[str | Path], env: Mapping[str, str] | None = None, **options: Any
) -> int:
    """Runs a command to its end and returns its exit code, as a shell reports it.

    Whatever ends this process, or a signal to it, ends the command and all that it has started.
    """
    with ends_by_exception(), supervised(command, env, **options) as process:
        try:
            code = process.wait()
        except KeyboardInterrupt as interrupt:
            if options.get("at_terminal") and interrupt.args == (signal.SIGINT,):
                # The command got it, too, and may have something to write.
                with undisturbed(), contextlib.suppress(subprocess.TimeoutExpired):
                    process.wait(AT_TERMINAL_S)
            raise
    return 128 - code if code < 0 else code


@contextlib.contextmanager
def started(command: Sequence[str], env: Mapping[str, str]) -> Iterator[subprocess.Popen[bytes]]:
    """A process without input and output that is interrupted with the block."""
    silent = subprocess.DEVNULL
    with supervised(command, env, stdin=silent, stdout=silent, stderr=silent) as process:
        yield process


def foreground(
    command: Sequence[str], env: Mapping[str, str], source: subprocess.Popen[bytes] | None
) -> int:
    """Runs a process to its end; Ctrl-C interrupts it once and lets it finish what it writes.

    Args:
        command: of the process.
        env: its environment.
        source: what it lives on; when that has ended it is interrupted, too, after a while in
            which it may end by itself.

    Returns:
        Its exit code; when the source failed, that of the source.
    """
    with supervised(command, env) as process:
        try:
            while source is None or source.poll() is None:
                with contextlib.suppress(subprocess.TimeoutExpired):
                    return process.wait(_POLL_S)
            with contextlib.suppress(subprocess.TimeoutExpired):
                return source.returncode or process.wait(_AFTERWARDS_S)
        except KeyboardInterrupt:
            pass  # the process is interrupted, too
    return process.returncode
