# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Stops random processes of a run, for a moment or for seconds."""

from __future__ import annotations

import os
import random
import signal
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

#: roslaunch ends itself when its own server or the master does not answer it within ten seconds.
_IMPATIENT = ("roslaunch", "rosmaster")
_IMPATIENT_FOR_S = 15.0


@dataclass(frozen=True)
class StopPlan:
    """How often, and for how long.

    Attributes:
        pause_s: mean wall time between two stops [s].
        short_s: most stops take between these two [s].
        long_s: the others take one of these [s].
        long_most: so many long ones at most.
        long_share: of the stops that are long while there may be such.
        long_early: so many of them before the run has begun, while programs still start.
    """

    pause_s: float = 0.3
    short_s: tuple[float, float] = (0.001, 0.3)
    long_s: tuple[float, ...] = (3.0, 7.0, 15.0)
    long_most: int = 2
    long_share: float = 0.2
    long_early: int = 1


@dataclass
class Stopper:
    """A thread that sends SIGSTOP and SIGCONT until the block ends; nobody stays stopped.

    Attributes:
        family: process ids of the run.
        seed: of the choice.
        plan: how often, and for how long.
        has_begun: whether simulated time runs.
        stops: what was stopped: name and seconds.
    """

    family: Callable[[], list[int]]
    seed: int
    plan: StopPlan = field(default_factory=StopPlan)
    has_begun: Callable[[], bool] = lambda: True
    stops: list[tuple[str, float]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._run)

    def __enter__(self) -> Stopper:
        """Begin."""
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        """End; what is stopped continues."""
        self._over.set()
        self._thread.join()

    def _run(self) -> None:
        chance, long_left = random.Random(self.seed), self.plan.long_most
        while not self._over.wait(chance.expovariate(1.0 / self.plan.pause_s)):
            processes = sorted(self.family())
            if not processes:
                continue
            process = chance.choice(processes)
            kept = 0 if self.has_begun() else self.plan.long_most - self.plan.long_early
            is_long = long_left > kept and chance.random() < self.plan.long_share
            is_long = is_long and not _starts_impatiently(process)
            long_left -= is_long
            low, high = self.plan.short_s
            seconds = chance.choice(self.plan.long_s) if is_long else chance.uniform(low, high)
            self._stop(process, seconds)

    def _stop(self, process: int, seconds: float) -> None:
        name = _name_of(process)
        with suppress(ProcessLookupError):
            os.kill(process, signal.SIGSTOP)
            try:
                self.stops.append((name, round(seconds, 3)))
                self._over.wait(seconds)
            finally:
                os.kill(process, signal.SIGCONT)


def _starts_impatiently(process: int) -> bool:
    """Whether it is one of ROS' own programs that give up by the clock while they start."""
    if _name_of(process).partition(" ")[0] not in _IMPATIENT:
        return False
    with suppress(OSError, ValueError, IndexError):
        stat = Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
        since_boot_s = float(Path("/proc/uptime").read_text(encoding="utf-8").split()[0])
        return since_boot_s - int(stat[19]) / os.sysconf("SC_CLK_TCK") < _IMPATIENT_FOR_S
    return False


def _name_of(process: int) -> str:
    """Program, and the node's name where it was given one."""
    with suppress(OSError):
        words = Path(f"/proc/{process}/cmdline").read_bytes().decode("utf-8", "replace").split("\0")
        programs = [Path(word).name for word in words[:2] if word]
        node = _first_with("__name:=", words).removeprefix("__name:=")
        space = _first_with("_UAV:=", words)
        return " ".join(part for part in (*programs[-1:], node, space) if part)
    return str(process)


def _first_with(prefix: str, words: list[str]) -> str:
    return next((word for word in words if word.startswith(prefix)), "")
