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
_MASTER_LIMIT_S = 20.0


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
