# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Records of latency_probe (trident_bridges): when messages were sent and received."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from trident_eval.core.errors import EvalError
from trident_eval.core.tracks import Array

_MAGIC = 0x3159434E54414C54  # "TLATNCY1", little-endian
_FIELDS = 8
PERCENTILES = (1.0, 50.0, 90.0, 99.0, 99.9)


def make_record(path: Path, capacity: int) -> None:
    """Makes the file that the parts of latency_probe share.

    Args:
        path: of the file, which is replaced.
        capacity: numbers of messages are below it.
    """
    fields = np.zeros(_FIELDS + 2 * capacity, dtype="<u8")
    fields[:2] = _MAGIC, capacity
    path.write_bytes(fields.tobytes())


class LatencyRecord(NamedTuple):
    """What was measured, of the messages behind number 0.

    Attributes:
        latency_ms: of each message that arrived, in the order of their numbers, shape (N,).
        received_s: when these arrived, since the first was sent, shape (N,).
        sent: messages.
        doubles: that arrived twice.
        unknown: messages that are not the source's.
    """

    latency_ms: Array
    received_s: Array
    sent: int
    doubles: int
    unknown: int

    @property
    def lost(self) -> int:
        """Messages that did not arrive."""
        return self.sent - len(self.latency_ms)

    def rate(self) -> float:
        """Messages that arrived, per second from the first one's departure; 0: nothing arrived."""
        duration = float(self.received_s.max()) if len(self.received_s) else 0.0
        return len(self.received_s) / duration if duration > 0.0 else 0.0


def read_record(path: Path, first: int = 1) -> LatencyRecord:
    """Reads a record.

    Args:
        path: of the file.
        first: number of the first message that counts.

    Raises:
        EvalError: it is no record, or nothing was sent.
    """
    data = path.read_bytes()
    fields = np.frombuffer(data[: len(data) // 8 * 8], dtype="<u8")
    if len(fields) < _FIELDS or fields[0] != _MAGIC or len(fields) != _FIELDS + 2 * fields[1]:
        raise EvalError(f"{path} is no record of latencies")
    sent, received = fields[_FIELDS:].astype(np.int64).reshape(2, -1)[:, first:]
    has_arrived = (sent > 0) & (received > 0)
    if not (sent > 0).any():
        raise EvalError(f"{path}: no message was sent")
    begin = sent[sent > 0].min()
    return LatencyRecord(
        latency_ms=1e-6 * (received - sent)[has_arrived],
        received_s=1e-9 * (received - begin)[has_arrived],
        sent=int((sent > 0).sum()),
        doubles=int(fields[5]),
        unknown=int(fields[6]),
    )


def percentiles_ms(latency_ms: Array) -> dict[str, float]:
    """Median, percentiles and extremes [ms]; empty when there are no messages."""
    if len(latency_ms) == 0:
        return {}
    values = np.percentile(latency_ms, PERCENTILES)
    names = {f"p{level:g}": float(value) for level, value in zip(PERCENTILES, values, strict=True)}
    return {"min": float(latency_ms.min()), **names, "max": float(latency_ms.max())}
