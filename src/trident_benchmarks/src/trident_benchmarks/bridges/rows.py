# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The rows of `./trident bench bridges`: which two processes stand between source and sink.

A protocol has its rows in a file of its own, which all_rows.py names: how its two nodes are
started, which messages they carry, and what is asked of them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, NamedTuple

from trident_base.ports import free_port
from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import program

from trident_benchmarks.bridges.limits import Limit, at_most
from trident_benchmarks.processes import Master, Processes

#: Topics of source and sink; the two nodes are remapped to them.
SOURCE_TOPIC = "/bench/source"
SINK_TOPIC = "/bench/sink"
#: Name of the row that others are compared with.
ECHO = "roscpp relays"
#: UDP may lose one message of ten thousand, TCP none.
UDP_LOSS = at_most("lost_share", 1e-4)
NO_LOSS = at_most("lost", 0)


class MissingDataError(EvalError):
    """A row cannot be measured: data that is not part of the project is not there."""


class Node(NamedTuple):
    """A process of a row.

    Attributes:
        name: of its log.
        command: words of its command line, remappings to SOURCE_TOPIC or SINK_TOPIC included.
        params: parameters of the master that are set before it starts, by absolute name.
        udp_port: that it has bound; 0: none.
    """

    name: str
    command: list[str]
    params: Mapping[str, object] = MappingProxyType({})
    udp_port: int = 0


@dataclass(frozen=True)
class BridgeRow:
    """What stands between source and sink.

    Attributes:
        name: of the row.
        protocol: mavlink, nmea, modbus; ros and udp are what they are compared with.
        message: what the source publishes, a name of carriers.h in trident_bridges/ros/latency:
            bytes, float32, float64, odometry, nav_sat_fix or tlog.
        wire_bytes: of the protocol, per message.
        nodes: makes both, the source's first; called once for each measurement.
        limits: what is asked.
        rate: of the latency's measurement [Hz].
        size: of the message bytes.
        bulk_rate: of the throughput's measurement [Hz]; 0: as fast as `window` lets.
        window: messages on their path at once, for a throughput without a rate; 1: a protocol that
            carries the newest value only.
        bulk: messages, for a throughput without a rate.
        words: makes further words for source and sink.
    """

    name: str
    protocol: str
    message: str
    wire_bytes: float
    nodes: Callable[[], list[Node]]
    limits: tuple[Limit, ...] = (NO_LOSS,)
    rate: float = 500.0
    size: int = 280
    bulk_rate: float = 0.0
    window: int = 256
    bulk: int = 200_000
    words: Callable[[], list[str]] = list


class Bench(NamedTuple):
    """Where rows start their processes.

    Attributes:
        processes: what has been started.
        master: that runs there.
    """

    processes: Processes
    master: Master


@dataclass(frozen=True)
class OtherRow:
    """A row that needs no source and no sink.

    Attributes:
        name: of the row.
        protocol: mavlink, nmea, modbus.
        measure: figures, by the names of limits.py, from a share of the whole measurement.
        limits: what is asked.
    """

    name: str
    protocol: str
    measure: Callable[[Bench, float], dict[str, Any]]
    limits: tuple[Limit, ...] = ()


Row = BridgeRow | OtherRow


def _probe(part: str, *words: str) -> list[str]:
    return [program("trident_bridges", "latency_probe"), part, *words]


def _relays() -> list[Node]:
    """Two processes that publish what they get: plain roscpp, three hops."""
    between = "/bench/between"
    return [
        Node("relay1", _probe("relay", "--in", SOURCE_TOPIC, "--out", between)),
        Node("relay2", _probe("relay", "--in", between, "--out", SINK_TOPIC)),
    ]


def udp_urls(near: int, far: int) -> tuple[str, str]:
    """URLs of two ends of UDP on this computer, by their ports."""
    host = "127.0.0.1"
    return f"udp://{host}:{near}@{host}:{far}", f"udp://{host}:{far}@{host}:{near}"


def _udp_bridges() -> list[Node]:
    """Bytes in datagrams, without a protocol."""
    first, second = free_port(), free_port()
    near, far = udp_urls(first, second)
    unused = "/bench/unused"

    def node(name: str, port: int, url: str, topic_in: str, topic_out: str) -> Node:
        words = ["--url", url, "--in", topic_in, "--out", topic_out, f"__name:={name}"]
        return Node(name, _probe("bridge", *words), udp_port=port)

    return [
        node("bridge1", first, near, SOURCE_TOPIC, unused),
        node("bridge2", second, far, unused, SINK_TOPIC),
    ]


ROWS = (
    BridgeRow(ECHO, "ros", "bytes", 280, _relays),
    BridgeRow("bytes over UDP", "udp", "bytes", 280, _udp_bridges, (UDP_LOSS,)),
)
