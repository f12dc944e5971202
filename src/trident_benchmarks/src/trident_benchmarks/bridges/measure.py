# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the bridges' benchmark: measured, written, printed."""

from __future__ import annotations

import argparse
import difflib
from collections.abc import Sequence
from typing import Any

from trident_eval.core.errors import EvalError

from trident_benchmarks.bridges.all_rows import ROWS
from trident_benchmarks.bridges.bridge_measurement import measure_bridge
from trident_benchmarks.bridges.limits import as_json, figures_text
from trident_benchmarks.bridges.rows import ECHO, Bench, BridgeRow, MissingDataError, Row
from trident_benchmarks.processes import Processes
from trident_benchmarks.results import (
    check_folder,
    limits_code,
    new_document,
    say,
    write_document,
)

_QUICK = 0.05  # share of the whole measurement
#: What the tutorial on UAVs, UGVs and USVs of ROS 2 and Gazebo 11 gives for its bridges, whose
#: sizes and rates it does not say: latency [ms], and throughput [Mbit/s].
TUTORIAL = {"mavlink": (12.3, 5.2), "nmea": (8.7, 1.8), "modbus": (15.2, 2.4)}
_METHOD = (
    "source -> bridge -> protocol over loopback -> bridge -> sink, four processes of roscpp.\n"
    "Latency: 500 Hz, {seconds:g} s, from before publish() to the sink's callback. Throughput:\n"
    "a paced source, {seconds:g} s, bits of the protocol. CPU time: of both bridges. A codec\n"
    "alone: CPU time of one core, of the slowest step."
)
#: What a row has in any case, for those who read the file.
_COLUMNS: dict[str, Any] = dict.fromkeys(("median_ms", "p99_ms", "mbit_s", "lost"))


def chosen_rows(name: str | None) -> Sequence[Row]:
    """All rows; or the one of a name, behind the one that it is compared with.

    Raises:
        EvalError: there is no such row.
    """
    if name is None:
        return ROWS
    chosen = _row_named(name)
    is_compared = any(limit.key == "over_echo_ms" for limit in chosen.limits)
    names = (ECHO, name) if is_compared else (name,)
    return [row for row in ROWS if row.name in names]


def _row_named(name: str) -> Row:
    names = [row.name for row in ROWS]
    if name not in names:
        near = difflib.get_close_matches(name, names, n=1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise EvalError(f"--only {name!r} is not a row{hint} Known: {', '.join(names)}")
    return ROWS[names.index(name)]


def measure_row(
    row: Row, bench: Bench, share: float, echo_ms: float | None = None
) -> dict[str, Any]:
    """What is measured of a row, and whether it keeps its limits.

    Args:
        row: what to measure.
        bench: where it is started.
        share: of the whole measurement.
        echo_ms: median of plain roscpp, where it has been measured.

    Raises:
        EvalError: a process has failed, or nothing arrived.
    """
    result: dict[str, Any] = {"row": row.name, "protocol": row.protocol, **_COLUMNS}
    if isinstance(row, BridgeRow):
        result |= measure_bridge(row, bench, share)
        if echo_ms is not None and result["median_ms"] is not None:
            result["over_echo_ms"] = result["median_ms"] - echo_ms
    else:
        result |= row.measure(bench, share)
    result["limits"] = as_json(row.limits)
    result["passed"] = all(limit.holds(result) for limit in row.limits)
    if row.protocol in TUTORIAL:
        result["tutorial_ms"], result["tutorial_mbit_s"] = TUTORIAL[row.protocol]
    return result


def _attempt(row: Row, bench: Bench, share: float, echo_ms: float | None) -> dict[str, Any]:
    """The result of a row; otherwise the reason why there is not."""
    nothing = {"row": row.name, "protocol": row.protocol, **_COLUMNS}
    try:
        return measure_row(row, bench, share, echo_ms)
    except MissingDataError as error:
        say(f"SKIPPED: {row.name}: {error}")
        return nothing | {"skipped": str(error), "passed": True}
    except EvalError as error:
        say(str(error))
        return nothing | {"error": str(error).splitlines()[0], "passed": False}


def line(row: Row, result: dict[str, Any]) -> str:
    """A row as one line."""
    for reason in ("error", "skipped"):
        if reason in result:
            return f"{row.name}: {reason}: {result[reason]}"
    text = f"{row.name}: {figures_text(result, row.limits)}"
    if isinstance(row, BridgeRow) and "tutorial_ms" in result:
        text += f"; tutorial: {result['tutorial_ms']} ms, {result['tutorial_mbit_s']} Mbit/s"
    return text + "".join(f"\n  {buffers}" for buffers in result.get("socket_buffers", ()))


def measure(options: argparse.Namespace) -> int:
    """All rows; the exit code."""
    check_folder(options.out)
    rows = chosen_rows(options.only)
    share = _QUICK if options.quick else 1.0
    document = new_document() | {"rows": []}
    say(_METHOD.format(seconds=60.0 * share))
    echo_ms = None
    with Processes() as processes:
        _, master = processes.start_master()
        for row in rows:
            result = _attempt(row, Bench(processes, master), share, echo_ms)
            if row.name == ECHO:
                echo_ms = result["median_ms"]
            document["rows"].append(result)
            print(line(row, result), flush=True)
            write_document(options.out, document)
    return limits_code(document)
