# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the bridges' benchmark: measured, written, printed."""

from __future__ import annotations

import argparse
import difflib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.core.latency import LatencyRecord, make_record, percentiles_ms, read_record
from trident_eval.ros_paths import program

from trident_benchmarks.bridges.all_rows import ROWS
from trident_benchmarks.bridges.rows import SINK_TOPIC, SOURCE_TOPIC, BridgeRow
from trident_benchmarks.processes import Master, Processes
from trident_benchmarks.procfs import process_cpu_s
from trident_benchmarks.results import (
    FAILED,
    MEASURED,
    check_folder,
    new_document,
    say,
    write_document,
)

_FIRST = 50  # messages before anything is measured
_WARM_UP = 100  # messages that do not count
_LIMIT_S = 180.0
_LATENCY_S = 20.0
_QUICK = 0.1  # share of latency and throughput


def chosen_rows(name: str | None) -> Sequence[BridgeRow]:
    """All rows, or the one of a name.

    Raises:
        EvalError: there is no such row.
    """
    if name is None:
        return ROWS
    names = [row.name for row in ROWS]
    if name not in names:
        near = difflib.get_close_matches(name, names, n=1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise EvalError(f"--only {name!r} is not a row{hint} Known: {', '.join(names)}")
    return [row for row in ROWS if row.name == name]


@contextmanager
def _started(row: BridgeRow, processes: Processes, master: Master) -> Iterator[list[int]]:
    """The row's two nodes; their process ids."""
    started = []
    try:
        for node in row.nodes():
            master.set_params(node.params)
            started.append(processes.start(node.name, node.command))
        yield [process.pid for process in started]
    finally:
        for process in reversed(started):
            processes.stop(process)


def _run(row: BridgeRow, processes: Processes, count: int, rate: float) -> LatencyRecord:
    """Source and sink around nodes that have been started; rate 0: as fast as they can."""
    record = processes.folder / "record"
    make_record(record, count + _WARM_UP + 1)
    probe = program("trident_bridges", "latency_probe")
    words = ["--record", str(record), "--message", row.message]
    sent = ["--count", str(count + _WARM_UP), "--size", str(row.size), "--rate", str(rate)]
    sent += ["--window", str(row.window), "--topic", SOURCE_TOPIC]
    sink = processes.start("sink", [probe, "sink", *words, "--topic", SINK_TOPIC])
    source = processes.start("source", [probe, "source", *words, *sent])
    processes.finish("source", source, _LIMIT_S)
    processes.finish("sink", sink, _LIMIT_S)
    return read_record(record, first=_WARM_UP)


def measure_row(
    row: BridgeRow, processes: Processes, master: Master, share: float
) -> dict[str, Any]:
    """Latency at the row's rate, then throughput without one.

    Args:
        row: what to measure.
        processes: where they are started.
        master: that runs there.
        share: of the whole measurement.

    Raises:
        EvalError: a process has failed, or nothing arrived.
    """
    with _started(row, processes, master) as pids:
        _run(row, processes, _FIRST, row.rate)  # what the nodes do once is not measured
        begin_s = sum(process_cpu_s(pid) for pid in pids)
        paced = _run(row, processes, round(share * _LATENCY_S * row.rate), row.rate)
        cpu_s = sum(process_cpu_s(pid) for pid in pids) - begin_s
        bulk = _run(row, processes, round(share * row.bulk), 0.0)
    latency = percentiles_ms(paced.latency_ms)
    result = {
        "row": row.name,
        "protocol": row.protocol,
        "message": row.message,
        "rate_hz": row.rate,
        "median_ms": latency.get("p50"),
        "p99_ms": latency.get("p99"),
        "max_ms": latency.get("max"),
        "wire_bytes": row.wire_bytes,
        "messages_s": bulk.rate(),
        "mbit_s": 8e-6 * row.wire_bytes * bulk.rate(),
        "lost": paced.lost + bulk.lost,
        "cpu_ms_per_1000": 1e6 * cpu_s / max(paced.sent, 1),
    }
    return result | {"passed": _passes(row, result)}


def _passes(row: BridgeRow, result: dict[str, Any]) -> bool:
    limits = (
        (result["median_ms"], row.median_limit_ms),
        (result["p99_ms"], row.p99_limit_ms),
    )
    is_fast = all(
        limit is None or (value is not None and value <= limit) for value, limit in limits
    )
    is_wide = row.mbit_s_limit is None or result["mbit_s"] >= row.mbit_s_limit
    return is_fast and is_wide and result["lost"] == 0


def line(row: dict[str, Any]) -> str:
    """A row as one line."""
    if "error" in row:
        return f"{row['row']}: {row['error']}"
    verdict = "" if row["passed"] else " (limit missed)"
    return (
        f"{row['row']}: {row['median_ms']:.3f} ms, 99 % {row['p99_ms']:.3f} ms"
        f" at {row['rate_hz']:g} Hz; {row['messages_s']:.0f} messages/s,"
        f" {row['mbit_s']:.1f} Mbit/s; {row['lost']} lost;"
        f" {row['cpu_ms_per_1000']:.0f} CPU ms for 1000{verdict}"
    )


def measure(options: argparse.Namespace) -> int:
    """All rows; the exit code."""
    check_folder(options.out)
    rows = chosen_rows(options.only)
    document = new_document() | {"rows": []}
    with Processes() as processes:
        _, master = processes.start_master()
        for row in rows:
            try:
                result = measure_row(row, processes, master, _QUICK if options.quick else 1.0)
            except EvalError as error:
                say(str(error))
                result = {"row": row.name, "protocol": row.protocol, "passed": False}
                result["error"] = str(error).splitlines()[0]
            document["rows"].append(result)
            print(line(result), flush=True)
            write_document(options.out, document)
    return MEASURED if all(row["passed"] for row in document["rows"]) else FAILED
