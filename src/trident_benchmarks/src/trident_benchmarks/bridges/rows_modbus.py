# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Modbus TCP between two nodes: 100 registers are written at a device and polled by its client."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from trident_base.ports import free_port
from trident_eval.ros_paths import program

from trident_benchmarks.bridges.limits import at_most
from trident_benchmarks.bridges.rows import NO_LOSS, SINK_TOPIC, SOURCE_TOPIC, BridgeRow, Node

#: Of the 100 registers of a response.
REGISTER_BYTES = 200
_MAP = """poll: 1000.0
transport: {{kind: tcp, port: {port}}}
registers:
  - {{name: number, table: input, address: 0, type: float32, topic: number}}
  - {{name: rest, table: input, address: 2, count: 98}}
"""


@cache
def _folder() -> TemporaryDirectory[str]:
    """Of the map file; it is removed when the program ends."""
    return TemporaryDirectory(prefix="trident_modbus_")


def _node(role: str, map_file: Path, topic: str) -> Node:
    command = [program("trident_bridges", f"modbus_{role}_node"), f"number:={topic}"]
    return Node(f"modbus_{role}", [*command, f"_map:={map_file}"])


def _modbus_bridges() -> list[Node]:
    map_file = Path(_folder().name) / "map.yaml"
    map_file.write_text(_MAP.format(port=free_port()), encoding="utf-8")
    return [_node("server", map_file, SOURCE_TOPIC), _node("client", map_file, SINK_TOPIC)]


MODBUS_ROWS = (
    BridgeRow(
        "Modbus",
        "modbus",
        "float32",
        REGISTER_BYTES,
        _modbus_bridges,
        (at_most("median_ms", 0.9), at_most("p99_ms", 2.5), NO_LOSS),
        window=1,
        bulk=10_000,
    ),
)
