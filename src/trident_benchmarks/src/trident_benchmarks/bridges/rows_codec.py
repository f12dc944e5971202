# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Codecs alone, by CPU time on one core, and registers over TCP between two processes, no ROS."""

from __future__ import annotations

import json
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import program

from trident_benchmarks.bridges.limits import at_least, at_most
from trident_benchmarks.bridges.rows import Bench, OtherRow

_LIMIT_S = 300.0
_CODEC_S = 4.0
_TCP_S = 60.0
_REQUESTS_AT_ONCE = 8


def _output(bench: Bench, name: str, *words: str) -> list[str]:
    """Lines that a program writes.

    Raises:
        EvalError: it fails.
    """
    process = bench.processes.start(name, [program("trident_bridges", name), *words])
    bench.processes.finish(name, process, _LIMIT_S)
    return bench.processes.log(name).read_text(encoding="utf-8").splitlines()


def mavlink_figures(lines: list[str], signed: bool) -> dict[str, Any]:
    """The slowest of packing and parsing, of all messages.

    Args:
        lines: of mavlink_codec_bench: a JSON object for each message and step.
        signed: whether of signed packets.

    Raises:
        EvalError: a step is missing.
    """
    steps = ("pack and sign", "parse and check") if signed else ("pack", "parse")
    rows = [row for row in map(json.loads, lines) if row["step"] in steps]
    if len(rows) < len(steps):
        raise EvalError(f"mavlink_codec_bench: {len(rows)} rows of {', '.join(steps)}")
    slowest = min(rows, key=lambda row: float(row["mbit_s"]))
    return {
        "mbit_s": slowest["mbit_s"],
        "cpu_ms_per_1000": slowest["cpu_us"],
        "message": f"{slowest['message']}, {slowest['step']}",
        "steps": rows,
    }


def _mavlink(signed: bool) -> Any:
    def measure(bench: Bench, share: float) -> dict[str, Any]:
        seconds = f"{max(share * _CODEC_S, 0.1):g}"
        lines = _output(bench, "mavlink_codec_bench", "--seconds", seconds)
        return mavlink_figures(lines, signed)

    return measure


def _nmea(bench: Bench, share: float) -> dict[str, Any]:
    """The slower of reading and writing: lines "read  N sentences/s  M Mbit/s ..."."""
    lines = _output(bench, "nmea_codec_bench", f"{max(share * _CODEC_S, 0.1):g}")
    words = [line.split() for line in lines]
    name, rate, _, mbit_s = min((line[:4] for line in words), key=lambda line: float(line[1]))
    return {
        "sentences_s": float(rate),
        "mbit_s": float(mbit_s),
        "cpu_ms_per_1000": 1e6 / float(rate),
        "message": name,
    }


def _pairs(lines: list[str]) -> dict[str, float]:
    return {name: float(value) for name, value in (line.split() for line in lines)}


def _modbus(bench: Bench, share: float) -> dict[str, Any]:
    """The slowest of framing for TCP and RTU, of reading 125 registers and of writing 123."""
    del share  # it measures half a second of each
    figures = _pairs(_output(bench, "modbus_benchmark", "codec"))
    name = min(figures, key=lambda one: figures[one])
    return {
        "pdus_s": figures[name],
        "cpu_ms_per_1000": 1e6 / figures[name],
        "message": name,
        "steps": figures,
    }


def _modbus_tcp(bench: Bench, share: float) -> dict[str, Any]:
    """125 registers, read again and again; CPU time is the client's."""
    words = ["tcp", f"{max(share * _TCP_S, 0.5):g}", str(_REQUESTS_AT_ONCE)]
    figures = _pairs(_output(bench, "modbus_benchmark", *words))
    return {
        "messages_s": figures["responses_s"],
        "mbit_s": figures["mbit_s"],
        "lost": int(figures["wrong"]),
        "cpu_ms_per_1000": figures["client_cpu_us"],
        "message": f"125 registers, {_REQUESTS_AT_ONCE} requests at once",
    }


CODEC_ROWS = (
    OtherRow("MAVLink codec", "mavlink", _mavlink(signed=False), (at_least("mbit_s", 800),)),
    OtherRow("MAVLink codec, signed", "mavlink", _mavlink(signed=True), (at_least("mbit_s", 150),)),
    OtherRow("NMEA codec", "nmea", _nmea, (at_least("sentences_s", 1.5e6),)),
    OtherRow("Modbus codec", "modbus", _modbus, (at_least("pdus_s", 1e6),)),
    OtherRow(
        "Modbus registers over TCP",
        "modbus",
        _modbus_tcp,
        (at_least("mbit_s", 40.0), at_most("lost", 0)),
    ),
)
