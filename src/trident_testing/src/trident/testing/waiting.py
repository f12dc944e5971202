# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Waiting for conditions, never for an amount of time."""

from __future__ import annotations

import time
from collections.abc import Callable

LIMIT_S = 60.0  # wall time for what takes a second on a quiet machine
_POLL_S = 0.02


def eventually(condition: Callable[[], bool], what: str, limit_s: float = LIMIT_S) -> None:
    """Return once a condition holds.

    Args:
        condition: polled; what it raises ends the wait.
        what: is waited for; part of the error.
        limit_s: wall time [s], one that a loaded machine meets.

    Raises:
        AssertionError: it did not hold in time.
    """
    deadline = time.monotonic() + limit_s
    while not condition():
        assert time.monotonic() < deadline, f"{what} did not happen within {limit_s:g} s"
        time.sleep(_POLL_S)
