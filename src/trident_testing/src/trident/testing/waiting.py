# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Waiting for conditions, never for an amount of time."""

from __future__ import annotations

import subprocess
import time
from collections.abc import Callable

from trident.patience import Patience

LIMIT_S = 60.0  # for what takes a second on a quiet machine
_POLL_S = 0.02
_LOOK_S = 0.5


def eventually(condition: Callable[[], bool], what: str, limit_s: float = LIMIT_S) -> None:
    """Return once a condition holds.

    Args:
        condition: polled; what it raises ends the wait.
        what: is waited for; part of the error.
        limit_s: time [s], as far as the machine gives it to this process and what it has started
            (`trident.patience`).

    Raises:
        AssertionError: it did not hold in time.
    """
    patience = Patience()
    while not condition():
        assert patience.spent_s() < limit_s, f"{what} did not happen within {limit_s:g} s"
        time.sleep(_POLL_S)


def output_of(process: subprocess.Popen[str], limit_s: float = LIMIT_S) -> str:
    """What a process has written to its pipe when it has ended; limit as of `eventually`.

    Raises:
        AssertionError: it has not ended in time; it is killed, and its output shown.
    """
    patience = Patience()
    while True:
        try:
            return process.communicate(timeout=_LOOK_S)[0] or ""
        except subprocess.TimeoutExpired:
            if patience.spent_s() >= limit_s:
                process.kill()
                output = process.communicate()[0]
                raise AssertionError(
                    f"{process.args!r} did not end within {limit_s:g} s:\n{output}"
                ) from None
