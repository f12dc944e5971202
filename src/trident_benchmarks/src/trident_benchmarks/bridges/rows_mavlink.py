# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""MAVLink over UDP between two mavros_node, as a companion computer and a vehicle have it."""

from __future__ import annotations

import os
from pathlib import Path

from trident_base.ports import free_port
from trident_eval.ros_paths import program

from trident_benchmarks.bridges.limits import at_least, at_most
from trident_benchmarks.bridges.rows import (
    SINK_TOPIC,
    SOURCE_TOPIC,
    UDP_LOSS,
    BridgeRow,
    MissingDataError,
    Node,
    udp_urls,
)

#: Header, payload without the zeros at its end, checksum.
ODOMETRY_BYTES = 10 + 232 + 2
#: Mean of the packets of TLOG.
TLOG_BYTES = 32.07
TLOG = Path("mavlink") / "vtol.tlog"
_DATA = "TRIDENT_DATA"
_ODOMETRY_RATE_HZ = 32_000.0
_TLOG_RATE_HZ = 37_000.0
#: What one of them may send the other: the rate is what is measured.
_MAX_PEER_RATE_HZ = 1e6


def _mavros(number: int, url: str, udp_port: int, remaps: dict[str, str]) -> Node:
    """One of two nodes, 1 or 2, each of which has the other's system as its vehicle."""
    name = f"bridge{number}"
    params: dict[str, object] = {
        f"/{name}/fcu_url": url,
        f"/{name}/system_id": number,
        f"/{name}/target_system_id": 3 - number,
        f"/{name}/max_peer_rate": _MAX_PEER_RATE_HZ,
    }
    words = [f"__name:={name}", *(f"{topic}:={to}" for topic, to in remaps.items())]
    return Node(name, [program("mavros", "mavros_node"), *words], params, udp_port)


def _two_mavros(near: dict[str, str], far: dict[str, str]) -> list[Node]:
    ports = free_port(), free_port()
    urls = udp_urls(*ports)
    return [_mavros(1, urls[0], ports[0], near), _mavros(2, urls[1], ports[1], far)]


def _odometry() -> list[Node]:
    """Topic odometry/out of one becomes odometry/in of the other."""
    return _two_mavros(
        {"/bridge1/odometry/out": SOURCE_TOPIC}, {"/bridge2/odometry/in": SINK_TOPIC}
    )


def _packets() -> list[Node]:
    """Whole packets, by the topics mavlink/to and mavlink/from."""
    return _two_mavros(
        {"/mavlink/from": "/bench/unused1", "/mavlink/to": SOURCE_TOPIC},
        {"/mavlink/from": SINK_TOPIC, "/mavlink/to": "/bench/unused2"},
    )


def _tlog_words() -> list[str]:
    data = os.environ.get(_DATA)
    if not data:
        raise MissingDataError(f"{_DATA} names no folder of data; {TLOG} is not replayed")
    file = Path(data) / TLOG
    if not file.is_file():
        raise MissingDataError(f"{file} is not there; it is not replayed")
    return ["--tlog", str(file)]


MAVLINK_ROWS = (
    BridgeRow(
        "MAVLink ODOMETRY over UDP",
        "mavlink",
        "odometry",
        ODOMETRY_BYTES,
        _odometry,
        (
            at_most("median_ms", 0.25),
            at_most("over_echo_ms", 0.15),
            at_most("p99_ms", 1.0),
            at_least("mbit_s", 60.0),
            UDP_LOSS,
        ),
        bulk_rate=_ODOMETRY_RATE_HZ,
    ),
    BridgeRow(
        "MAVLink telemetry over UDP",
        "mavlink",
        "tlog",
        TLOG_BYTES,
        _packets,
        (at_least("messages_s", 35_000), UDP_LOSS),
        bulk_rate=_TLOG_RATE_HZ,
        words=_tlog_words,
    ),
)
