# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A row of the bridges' benchmark that stands between a source and a sink."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from trident_eval.core.bridges.latency import (
    LatencyRecord,
    make_record,
    percentiles_ms,
    read_record,
)
from trident_eval.ros_paths import program

from trident_benchmarks.bridges.rows import SINK_TOPIC, SOURCE_TOPIC, Bench, BridgeRow, Node
from trident_benchmarks.bridges.sockets import kernel_drops
from trident_benchmarks.processes import Processes
from trident_benchmarks.procfs import total_cpu_s

_FIRST = 50  # messages before anything is measured
_WARM_UP = 100  # messages that do not count
_LIMIT_S = 180.0
_LATENCY_S = 60.0
_BULK_S = 60.0
_COLOR = re.compile(r"\x1b\[[0-9;]*m")


@contextmanager
def _started(nodes: Sequence[Node], bench: Bench) -> Iterator[list[int]]:
    """The row's two nodes; their process ids."""
    started = []
    try:
        for node in nodes:
            bench.master.set_params(node.params)
            started.append(bench.processes.start(node.name, node.command))
        yield [process.pid for process in started]
    finally:
        for process in reversed(started):
            bench.processes.stop(process)


def _run(
    row: BridgeRow, processes: Processes, count: int, rate: float, words: list[str]
) -> LatencyRecord:
    """Source and sink around nodes that have been started; rate 0: as fast as they can."""
    record = processes.folder / "record"
    make_record(record, count + _WARM_UP + 1)
    probe = program("trident_bridges", "latency_probe")
    both = ["--record", str(record), "--message", row.message, *words]
    sent = ["--count", str(count + _WARM_UP), "--size", str(row.size), "--rate", str(rate)]
    sent += ["--window", str(row.window), "--topic", SOURCE_TOPIC]
    sink = processes.start("sink", [probe, "sink", *both, "--topic", SINK_TOPIC])
    source = processes.start("source", [probe, "source", *both, *sent])
    processes.finish("source", source, _LIMIT_S)
    processes.finish("sink", sink, _LIMIT_S)
    return read_record(record, first=_WARM_UP)


def _socket_buffers(nodes: Sequence[Node], processes: Processes) -> list[str]:
    """What the nodes say that they got from the kernel."""
    found = []
    for node in nodes:
        text = processes.log(node.name).read_text(encoding="utf-8", errors="replace")
        lines = _COLOR.sub("", text).splitlines()
        found += [line.split("]: ", 1)[-1] for line in lines if " buffer " in line]
    return found


def _bulk(row: BridgeRow, processes: Processes, share: float, words: list[str]) -> LatencyRecord:
    count = _BULK_S * row.bulk_rate if row.bulk_rate > 0.0 else row.bulk
    return _run(row, processes, round(share * count), row.bulk_rate, words)


def measure_bridge(row: BridgeRow, bench: Bench, share: float) -> dict[str, Any]:
    """Latency at the row's rate, then its throughput.

    Args:
        row: what to measure.
        bench: where it is started.
        share: of the whole measurement.

    Raises:
        MissingDataError: the row needs data that is not there.
        EvalError: a process has failed, or nothing arrived.
    """
    words = row.words()
    nodes = row.nodes()
    processes = bench.processes
    with _started(nodes, bench) as pids:
        # What the nodes do once is not measured.
        _run(row, processes, _FIRST, row.rate, words)
        begin_s = total_cpu_s(pids)
        paced = _run(row, processes, round(share * _LATENCY_S * row.rate), row.rate, words)
        between_s = total_cpu_s(pids)
        bulk = _bulk(row, processes, share, words)
        cpu_s = between_s - begin_s, total_cpu_s(pids) - between_s
        drops = [kernel_drops(node.udp_port) for node in nodes if node.udp_port]
    result = _figures(row, paced, bulk)
    result["cpu_ms_per_1000"] = 1e6 * cpu_s[0] / max(paced.sent, 1)
    result["bulk_cpu_ms_per_1000"] = 1e6 * cpu_s[1] / max(bulk.sent, 1)
    if drops:
        # What a node has logged is all in the file when it has ended.
        buffers = _socket_buffers(nodes, processes)
        result |= {"kernel_drops": sum(drops), "socket_buffers": buffers}
    return result


def _figures(row: BridgeRow, paced: LatencyRecord, bulk: LatencyRecord) -> dict[str, Any]:
    latency = percentiles_ms(paced.latency_ms)
    # Where the newest value alone is carried, one that a newer one replaced is not lost.
    is_newest_only = row.window == 1
    lost = bulk.lost + (0 if is_newest_only else paced.lost)
    return {
        "message": row.message,
        "rate_hz": row.rate,
        "bulk_rate_hz": row.bulk_rate or None,
        "median_ms": latency.get("p50"),
        "p99_ms": latency.get("p99"),
        "max_ms": latency.get("max"),
        "wire_bytes": row.wire_bytes,
        "messages_s": bulk.rate(),
        "mbit_s": 8e-6 * row.wire_bytes * bulk.rate(),
        "lost": lost,
        "lost_share": lost / max(paced.sent + bulk.sent, 1),
        "overwritten": paced.lost if is_newest_only else None,
    }
