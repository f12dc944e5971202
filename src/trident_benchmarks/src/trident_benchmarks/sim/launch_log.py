# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What the output of roslaunch and of ./trident run reports about a launch."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Sequence

from trident_eval.core.errors import EvalError

_ANSI = re.compile(r"\x1b(\[[0-9;?]*[A-Za-z]|\][^\x07]*\x07)")
# rosconsole's default format; with simulated time after the wall time once the clock runs
_SPAWNED = re.compile(r"\[ *INFO\] \[(\d+\.\d+)(?:, \d+\.\d+)?\]: SpawnModel: Successfully spawned")
_STARTED = re.compile(r"process\[(\S+)-\d+\]: started with pid \[(\d+)\]")
_FOLDER = re.compile(r"^trident: \S+ -> (\S+)$", re.MULTILINE)


def spawn_times(log: str) -> list[float]:
    """Wall times of the vehicles' spawning [s since 1970], ascending, of a roslaunch output."""
    return sorted(float(text) for text in _SPAWNED.findall(_ANSI.sub("", log)))


def node_pids(log: str) -> dict[str, int]:
    """Process id of every node that roslaunch has started; not the master and rosout."""
    found = {name: int(pid) for name, pid in _STARTED.findall(_ANSI.sub("", log))}
    return {name: pid for name, pid in found.items() if name not in ("master", "rosout")}


def run_folder(output: str) -> str | None:
    """The folder that ./trident run says it writes to, or None as long as it has not."""
    found = _FOLDER.search(output)
    return found.group(1) if found else None


def interpolate(samples: Sequence[tuple[float, float]], at: float) -> float:
    """Value at ``at`` of samples (time, value) in time order; outside of them the nearest.

    Raises:
        EvalError: there are no samples.
    """
    if not samples:
        raise EvalError("no CPU times were sampled: the launch was too short")
    index = bisect_left(samples, (at,))
    if index == 0:
        return samples[0][1]
    if index == len(samples):
        return samples[-1][1]
    (t0, v0), (t1, v1) = samples[index - 1], samples[index]
    return v1 if t1 == t0 else v0 + (v1 - v0) * (at - t0) / (t1 - t0)
