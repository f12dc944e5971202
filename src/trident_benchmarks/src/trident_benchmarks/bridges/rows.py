# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The rows of `./trident bench bridges`: which two processes stand between source and sink.

A protocol has a BridgeRow in a file of its own, which all_rows.py names: how its two nodes are
started, and which messages they carry.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import NamedTuple

from trident_base.ports import free_port
from trident_eval.ros_paths import program

#: Topics of source and sink; the two nodes are remapped to them.
SOURCE_TOPIC = "/bench/source"
SINK_TOPIC = "/bench/sink"


class Node(NamedTuple):
    """A process of a row.

    Attributes:
        name: of its log.
        command: words of its command line, remappings to SOURCE_TOPIC or SINK_TOPIC included.
        params: parameters of the master that are set before it starts, by absolute name.
    """

    name: str
    command: list[str]
    params: Mapping[str, object] = MappingProxyType({})


class BridgeRow(NamedTuple):
    """What stands between source and sink.

    Attributes:
        name: of the row.
        protocol: mavlink, nmea, modbus; ros and udp are what they are compared with.
        message: what the source publishes, a name of carriers.h in trident_bridges/ros/latency:
            bytes, float32, float64, odometry or nav_sat_fix.
        wire_bytes: of the protocol, per message.
        nodes: makes both, the source's first; called once for each measurement.
        rate: of the latency's measurement [Hz].
        size: of the message bytes.
        median_limit_ms, p99_limit_ms: what is asked; None: nothing.
        mbit_s_limit: throughput that is asked, of wire_bytes; None: nothing.
        window: messages on their path at once, for throughput; 1: a protocol that carries the
            newest value only.
        bulk: messages, for throughput.
    """

    name: str
    protocol: str
    message: str
    wire_bytes: int
    nodes: Callable[[], list[Node]]
    rate: float = 500.0
    size: int = 280
    median_limit_ms: float | None = None
    p99_limit_ms: float | None = None
    mbit_s_limit: float | None = None
    window: int = 256
    bulk: int = 200_000


def _probe(part: str, *words: str) -> list[str]:
    return [program("trident_bridges", "latency_probe"), part, *words]


def _relays() -> list[Node]:
    """Two processes that publish what they get: plain roscpp, three hops."""
    between = "/bench/between"
    return [
        Node("relay1", _probe("relay", "--in", SOURCE_TOPIC, "--out", between)),
        Node("relay2", _probe("relay", "--in", between, "--out", SINK_TOPIC)),
    ]


def _udp_bridges() -> list[Node]:
    """Bytes in datagrams, without a protocol."""
    first, second = free_port(), free_port()
    near = f"udp://127.0.0.1:{first}@127.0.0.1:{second}"
    far = f"udp://127.0.0.1:{second}@127.0.0.1:{first}"
    unused = "/bench/unused"
    return [
        _udp_bridge("bridge1", near, SOURCE_TOPIC, unused),
        _udp_bridge("bridge2", far, unused, SINK_TOPIC),
    ]


def _udp_bridge(name: str, url: str, topic_in: str, topic_out: str) -> Node:
    words = ["--url", url, "--in", topic_in, "--out", topic_out, f"__name:={name}"]
    return Node(name, _probe("bridge", *words))


ROWS = (
    BridgeRow("roscpp relays", "ros", "bytes", 280, _relays),
    BridgeRow("bytes over UDP", "udp", "bytes", 280, _udp_bridges),
)
