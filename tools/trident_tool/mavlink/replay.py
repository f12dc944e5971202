# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Plays a telemetry log again: sends its packets at their pace."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

from trident_tool.workspace import TridentError

_TIME_SIZE = 8
_OVERHEAD = {0xFE: 8, 0xFD: 12}
_SIGNATURE = 13


class Record(NamedTuple):
    """A packet of a log.

    Attributes:
        time_us: since 1970.
        packet: as it was received.
    """

    time_us: int
    packet: bytes


def records(log: bytes, name: str) -> Iterator[Record]:
    """The packets of a telemetry log, in order.

    Raises:
        TridentError: no packet is where one should be; names the byte.
    """
    at = 0
    while at < len(log):
        head = log[at + _TIME_SIZE : at + _TIME_SIZE + 3]
        if len(head) < 3 or head[0] not in _OVERHEAD:
            raise TridentError(f"{name}: byte {at}: no record of a telemetry log begins here")
        size = head[1] + _OVERHEAD[head[0]]
        if head[0] == 0xFD and head[2] & 1:
            size += _SIGNATURE
        end = at + _TIME_SIZE + size
        if end > len(log):
            raise TridentError(f"{name}: byte {at}: the last record is cut")
        yield Record(int.from_bytes(log[at : at + _TIME_SIZE], "big"), log[at + _TIME_SIZE : end])
        at = end


def read_log(path: Path) -> list[Record]:
    """The packets of a file.

    Raises:
        TridentError: it is missing, empty or no telemetry log.
    """
    try:
        log = path.read_bytes()
    except OSError as error:
        raise TridentError(f"{path}: {error.strerror}") from error
    found = list(records(log, str(path)))
    if not found:
        raise TridentError(f"{path}: the log is empty")
    return found


def replay(
    log: list[Record],
    send: Callable[[bytes], object],
    speed: float,
    *,
    now: Callable[[], float] = time.monotonic,
    sleep: Callable[[float], None] = time.sleep,
) -> int:
    """Sends the packets when their times come; returns how many.

    Args:
        log: in the order of their times; times that go back count as now.
        send: takes a packet.
        speed: factor of real time; infinite: as fast as possible.
        now: a clock [s].
        sleep: waits so many seconds.
    """
    begin = now()
    for record in log:
        due = begin + 1e-6 * (record.time_us - log[0].time_us) / speed
        wait = due - now()
        if wait > 0.0 and math.isfinite(wait):
            sleep(wait)
        send(record.packet)
    return len(log)
