# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""NMEA 0183 between two nodes: each position is a GGA sentence over TCP."""

from __future__ import annotations

from trident_base.ports import free_port
from trident_eval.ros_paths import program

from trident_benchmarks.bridges.limits import at_least, at_most
from trident_benchmarks.bridges.rows import NO_LOSS, SINK_TOPIC, SOURCE_TOPIC, BridgeRow, Node

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
        (
            at_most("median_ms", 0.25),
            at_most("over_echo_ms", 0.15),
            at_most("p99_ms", 1.0),
            at_least("messages_s", 30_000),
            at_least("mbit_s", 20.0),
            NO_LOSS,
        ),
        bulk_rate=40_000.0,
    ),
)
