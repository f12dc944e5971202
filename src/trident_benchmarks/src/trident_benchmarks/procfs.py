# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""CPU time and memory of processes, from Linux' /proc (man 5 proc)."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from trident_eval.core.errors import EvalError

_PROC = Path("/proc")
_TICK_S = 1.0 / os.sysconf("SC_CLK_TCK")
_KB_PER_MB = 1024.0
_IDLE_FIELDS = (3, 4)  # idle and iowait of the line "cpu" in /proc/stat
_GUEST_FIELDS = (8, 9)  # already contained in user and nice


@dataclass(frozen=True)
class Memory:
    """Resident memory of a process [MB of 2^20 bytes]: now, and at its largest so far."""

    rss_mb: float
    peak_mb: float


def parse_process_cpu(stat: str, tick_s: float = _TICK_S) -> float:
    """CPU seconds, user and system, of the text of /proc/PID/stat; children are not included.

    Raises:
        EvalError: the text is not of that form.
    """
    # The name in parentheses may contain spaces and parentheses of its own.
    fields = stat[stat.rfind(")") + 1 :].split()
    try:
        return (int(fields[11]) + int(fields[12])) * tick_s
    except (IndexError, ValueError) as error:
        raise EvalError(f"/proc/PID/stat: {stat[:80]!r} has no utime and stime") from error


def parse_parent(stat: str) -> int:
    """Process id of the parent, from the text of /proc/PID/stat."""
    return int(stat[stat.rfind(")") + 1 :].split()[1])


def parse_memory(status: str) -> Memory:
    """Memory, of the text of /proc/PID/status.

    Raises:
        EvalError: VmRSS or VmHWM is missing, as in a process that has ended.
    """

    def entry(key: str) -> float:
        found = re.search(rf"^{key}:\s+(\d+) kB$", status, re.MULTILINE)
        if found is None:
            raise EvalError(f"/proc/PID/status has no {key}: the process has ended")
        return int(found.group(1)) / _KB_PER_MB

    return Memory(entry("VmRSS"), entry("VmHWM"))


def parse_machine_busy(stat: str, tick_s: float = _TICK_S) -> float:
    """CPU seconds that all cores together have been busy since boot, of the text of /proc/stat."""
    words = stat.split("\n", 1)[0].split()
    if not words or words[0] != "cpu":
        raise EvalError("/proc/stat does not begin with the line 'cpu'")
    ticks = [int(word) for word in words[1:]]
    ignored = {*_IDLE_FIELDS, *_GUEST_FIELDS}
    return sum(value for field, value in enumerate(ticks) if field not in ignored) * tick_s


def descendants_of(pid: int, parents: Mapping[int, int]) -> list[int]:
    """``pid`` and all below it, in ascending order.

    Args:
        pid: the root.
        parents: parent of every process.
    """
    found = {pid}
    grew = True
    while grew:
        below = {child for child, parent in parents.items() if parent in found} - found
        grew = bool(below)
        found |= below
    return sorted(found)


def process_cpu_s(pid: int) -> float:
    """CPU seconds of a running process.

    Raises:
        EvalError: there is no such process.
    """
    return parse_process_cpu(_proc_text(pid, "stat"))


def total_cpu_s(pids: Iterable[int]) -> float:
    """CPU seconds of several running processes together."""
    return sum(process_cpu_s(pid) for pid in pids)


def memory_of(pid: int) -> Memory:
    """Memory of a running process.

    Raises:
        EvalError: there is no such process.
    """
    return parse_memory(_proc_text(pid, "status"))


def _proc_text(pid: int, name: str) -> str:
    try:
        return (_PROC / str(pid) / name).read_text(encoding="utf-8")
    except OSError as error:
        raise EvalError(f"process {pid} has ended before it could be measured") from error


def machine_busy_s() -> float:
    """CPU seconds that the machine has been busy since boot."""
    return parse_machine_busy((_PROC / "stat").read_text(encoding="utf-8"))


def process_tree(pid: int) -> list[int]:
    """``pid`` and all its descendants that run now."""
    parents = {}
    for entry in _PROC.iterdir():
        if entry.name.isdigit():
            try:
                parents[int(entry.name)] = parse_parent((entry / "stat").read_text("utf-8"))
            except (OSError, UnicodeDecodeError):
                continue  # ended meanwhile
    return descendants_of(pid, parents)


def program_name(pid: int) -> str:
    """File name of the program that a process runs, or "" when it has ended."""
    try:
        words = (_PROC / str(pid) / "cmdline").read_bytes().split(b"\0")
    except OSError:
        return ""
    return Path(words[0].decode("utf-8", "replace")).name
