# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Limits on waiting that follow what the machine gives, not the clock on the wall.

On a loaded machine a process that wants to run has to wait for a processor. The kernel counts for
how long, thread by thread (/proc/PID/task/TID/schedstat: time run and time waited for a processor,
in nanoseconds). A `Patience` counts time as far as this process and all that it has started got
what they wanted: with a tenth of a processor, a limit of 60 s is one of 600 s. What hangs without
wanting anything, or runs for ever, reaches its limit as on a quiet machine.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

Usage = dict[int, tuple[int, int]]
"""Nanoseconds that each thread has run and has waited for a processor."""

_INTERVAL_S = 0.5
_SLOWEST = 0.02  # time counts at least this much, so that every wait ends
_IDLE = 0.05  # who wants less of a processor than this is not held up by those that compete for it


def rate_of_time(ran_s: float, waited_s: float, wall_s: float) -> float:
    """How much of some wall time counts for processes that ran, and waited for a processor.

    Args:
        ran_s: by all their threads together [s].
        waited_s: by all their threads together [s].
        wall_s: that went by [s], more than 0.

    Returns:
        1 where they got all they wanted, less where they did not.
    """
    if ran_s + waited_s < _IDLE * wall_s:
        return 1.0
    return max(ran_s / (ran_s + waited_s), _SLOWEST)


class Patience:
    """Time that counts towards a limit, from the making of this on."""

    def __init__(self, usage: Callable[[], Usage] | None = None) -> None:
        """Begin to count.

        Args:
            usage: of those who are waited for; default: of this process and its descendants.
        """
        self._usage = usage or (lambda: usage_of(family(os.getpid())))
        self._last_s = time.monotonic()
        self._last: Usage | None = None
        self._spent_s = 0.0

    def spent_s(self) -> float:
        """Time that counts, up to now [s]; looked at often, it costs little."""
        now_s = time.monotonic()
        wall_s = now_s - self._last_s
        if wall_s < _INTERVAL_S:
            # Most waits end before anything has to be looked up.
            return self._spent_s + (wall_s if self._last is None else _SLOWEST * wall_s)
        usage = self._usage()
        # Of the first interval nothing is known; it counts like one on a quiet machine.
        rate = 1.0
        if self._last is not None:
            rate = rate_of_time(*_difference(self._last, usage), wall_s)
        self._last_s, self._last = now_s, usage
        self._spent_s += rate * wall_s
        return self._spent_s


def family(pid: int) -> list[int]:
    """A process and all its descendants that have not lost their parents."""
    children: dict[int, list[int]] = {}
    for folder in Path("/proc").glob("[0-9]*"):
        with suppress(OSError, IndexError, ValueError):
            stat = (folder / "stat").read_text(encoding="utf-8", errors="replace")
            parent = int(stat.rsplit(")", 1)[1].split()[1])
            children.setdefault(parent, []).append(int(folder.name))
    found = [pid]
    for member in found:  # grows as it goes
        found += children.get(member, [])
    return found


def usage_of(pids: list[int]) -> Usage:
    """What all threads of some processes have got; nothing where the kernel does not count it."""
    usage: Usage = {}
    for pid in pids:
        with suppress(OSError):  # it ends meanwhile
            for folder in Path(f"/proc/{pid}/task").glob("[0-9]*"):
                with suppress(OSError, ValueError):
                    ran_ns, waited_ns, _ = (folder / "schedstat").read_text().split()
                    usage[int(folder.name)] = (int(ran_ns), int(waited_ns))
    return usage


def _difference(before: Usage, after: Usage) -> tuple[float, float]:
    """Seconds run and waited since `before`; a thread's end takes nothing away."""
    ran_ns = waited_ns = 0
    for thread, (ran, waited) in after.items():
        ran_before, waited_before = before.get(thread, (0, 0))
        ran_ns += max(ran - ran_before, 0)
        waited_ns += max(waited - waited_before, 0)
    return ran_ns / 1e9, waited_ns / 1e9
