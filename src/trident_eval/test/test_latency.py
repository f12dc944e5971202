# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from trident_eval.core.bridges.latency import make_record, percentiles_ms, read_record
from trident_eval.core.errors import EvalError

MS = 1_000_000


def written(path: Path, sent: list[int], received: list[int]) -> Path:
    """A record of these times [ns]."""
    make_record(path, len(sent))
    fields = np.frombuffer(path.read_bytes(), dtype="<u8").copy()
    fields[5:7] = 3, 4
    fields[8:] = np.array([*sent, *received], dtype=np.int64).astype("<u8")
    path.write_bytes(fields.tobytes())
    return path


def test_latencies_are_of_messages_that_arrived(tmp_path: Path) -> None:
    file = written(tmp_path / "r", [9, 10 * MS, 20 * MS, 30 * MS], [9, 12 * MS, 0, 36 * MS])
    record = read_record(file)
    assert record.latency_ms.tolist() == [2.0, 6.0]
    assert record.received_s.tolist() == pytest.approx([0.002, 0.026])
    assert (record.sent, record.lost, record.doubles, record.unknown) == (3, 1, 3, 4)
    assert record.rate() == pytest.approx(2 / 0.026)
    assert percentiles_ms(record.latency_ms)["p50"] == 4.0
    assert percentiles_ms(record.latency_ms)["max"] == 6.0
    assert read_record(file, first=3).latency_ms.tolist() == [6.0]


def test_a_record_of_nothing_has_no_percentiles(tmp_path: Path) -> None:
    record = read_record(written(tmp_path / "r", [1, 5], [1, 0]))
    assert (record.lost, record.rate()) == (1, 0.0)
    assert percentiles_ms(record.latency_ms) == {}


def test_what_is_no_record_is_refused(tmp_path: Path) -> None:
    make_record(tmp_path / "empty", 10)
    with pytest.raises(EvalError, match="no message was sent"):
        read_record(tmp_path / "empty")
    (tmp_path / "text").write_bytes(b"not a record of latencies")
    with pytest.raises(EvalError, match="is no record"):
        read_record(tmp_path / "text")
    cut = (tmp_path / "empty").read_bytes()[:-8]
    (tmp_path / "cut").write_bytes(cut)
    with pytest.raises(EvalError, match="is no record"):
        read_record(tmp_path / "cut")
