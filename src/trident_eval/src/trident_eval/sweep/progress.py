# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""One line that says how far a sweep is."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable

_PERIOD_S = 0.2  # on a terminal
_LOG_PERIOD_S = 30.0  # into a file


class Progress:
    """Shows done, failed, running, time left and the interval now, on stderr."""

    def __init__(self, wanted: int, done: int) -> None:
        """Begin.

        Args:
            wanted: runs in all.
            done: that were there already.
        """
        self._wanted, self._before = wanted, done
        self._begin = time.monotonic()
        self._is_terminal = sys.stderr.isatty()
        self._next = 0.0

    def show(
        self, done: int, failed: int, running: int, left: int, width: Callable[[], float]
    ) -> None:
        """The line, if it is time for it.

        Args:
            done: runs that have ended, failed ones and those of before included.
            failed: of them.
            running: now.
            left: still to be made.
            width: gives half of the widest interval that is asked for; infinite: none.
        """
        now = time.monotonic()
        if now < self._next:
            return
        self._next = now + (_PERIOD_S if self._is_terminal else _LOG_PERIOD_S)
        words = [f"{done} of {self._wanted} done", f"{failed} failed", f"{running} running"]
        if (made := done - self._before) > 0:
            words.append(f"{_clock(left * (now - self._begin) / made)} left")
        if math.isfinite(widest := width()):
            words.append(f"interval +-{widest:.3g}")
        begin, end = ("\r\x1b[K", "") if self._is_terminal else ("", "\n")
        print(begin + ", ".join(words), end=end, file=sys.stderr, flush=True)

    def close(self) -> None:
        """Leaves the line on a terminal."""
        if self._is_terminal:
            print(file=sys.stderr)


def _clock(seconds: float) -> str:
    whole = round(seconds)
    hours, minutes = divmod(whole // 60, 60)
    return f"{hours}:{minutes:02d}:{whole % 60:02d}" if hours else f"{minutes}:{whole % 60:02d}"
