# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Processes in the background, which end with a block."""

from __future__ import annotations

import contextlib
import signal
import subprocess
import time
from collections.abc import Iterator, Mapping, Sequence

from trident_tool.shell import master_answers
from trident_tool.workspace import TridentError

_END_LIMIT_S = 25.0  # roslaunch waits 15 s for a node that does not end
_MASTER_LIMIT_S = 300.0  # it is told at once when roscore ends
_POLL_S = 0.2
_AFTERWARDS_S = 5.0


@contextlib.contextmanager
def started(command: Sequence[str], env: Mapping[str, str]) -> Iterator[subprocess.Popen[bytes]]:
    """A process without input and output that is interrupted with the block."""
    process = subprocess.Popen(
        command,
        env=dict(env),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        yield process
    finally:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(_END_LIMIT_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


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
    process = subprocess.Popen(command, env=dict(env), start_new_session=True)
    try:
        while source is None or source.poll() is None:
            with contextlib.suppress(subprocess.TimeoutExpired):
                return process.wait(_POLL_S)
        with contextlib.suppress(subprocess.TimeoutExpired):
            return source.returncode or process.wait(_AFTERWARDS_S)
    except KeyboardInterrupt:
        pass  # the process is interrupted, too
    finally:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
            process.wait(_END_LIMIT_S)
    return process.returncode


def wait_for_master(uri: str, process: subprocess.Popen[bytes]) -> None:
    """Return when a master answers.

    Raises:
        TridentError: its process has ended, or it takes too long.
    """
    deadline = time.monotonic() + _MASTER_LIMIT_S
    while not master_answers(uri):
        if process.poll() is not None or time.monotonic() > deadline:
            raise TridentError("roscore did not start")
        time.sleep(0.1)
