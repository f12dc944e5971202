# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""NMEA 0183 between two nodes: each position is a GGA sentence over TCP."""

from __future__ import annotations

from trident_base.ports import free_port
from trident_eval.ros_paths import program

from trident_benchmarks.bridges.rows import SINK_TOPIC, SOURCE_TOPIC, BridgeRow, Node

#: "$GPGGA,hhmmss.ss,5900.00000,N,dddmm.mmmmm,W,1,,0.7,10.000,M,,M,,*hh" with its line end.
GGA_BYTES = 69
_INSTRUMENTS = ("fix", "gnss_status", "odometry", "speed_through_water", "depth", "wind", "path")


def _node(name: str, link: dict[str, object], topics: dict[str, str], *words: str) -> Node:
    params: dict[str, object] = {
        f"/{name}/links": [link],
        f"/{name}/rates": {"GGA": 1e6},
        f"/{name}/topics": dict.fromkeys(_INSTRUMENTS, "") | topics,
        f"/{name}/output": f"{name}_output",
    }
    command = [program("trident_bridges", "nmea_node"), f"__name:={name}", *words]
    return Node(name, command, params)


def _nmea_bridges() -> list[Node]:
    port = free_port()
    server = {"url": f"tcp-l://127.0.0.1:{port}", "listens": False}
    client = {"url": f"tcp://127.0.0.1:{port}", "sends": False}
    return [
        _node("bridge1", server, {"fix": SOURCE_TOPIC}),
        _node("bridge2", client, {}, f"bridge2_output/fix:={SINK_TOPIC}"),
    ]


NMEA_ROWS = (
    BridgeRow(
        "NMEA GGA over TCP",
        "nmea",
        "nav_sat_fix",
        GGA_BYTES,
        _nmea_bridges,
        median_limit_ms=1.0,
        p99_limit_ms=3.0,
        mbit_s_limit=20.0,
    ),
)
