# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Clients of other projects read and write every table of modbus_server_node, over TCP and RTU."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest
from peers import PEERS, Libmodbus, Peer, Pymodbus
from plc import make_line, start_node, write_map
from sensor_msgs.msg import BatteryState
from std_msgs.msg import Bool, Float32, Float64
from trident.testing import Ros, eventually, recorder

TRANSPORTS = ("tcp", "rtu")
Publish = Callable[[str, Any], None]


@pytest.fixture
def connect(ros: Ros, tmp_path: Path) -> Iterator[Callable[[str, str], Peer]]:
    """Starts a device, and connects a client to it, which is closed with the test."""
    with ExitStack() as stack:

        def make(name: str, transport: str) -> Peer:
            line = make_line(transport, ros, tmp_path)
            stack.callback(line.close)
            start_node(ros, "server", write_map(tmp_path, "device.yaml", line, is_device=True), "v")
            peer: Peer = PEERS[name](line)
            stack.callback(peer.close)
            return peer

        yield make


def real(words: list[int]) -> float:
    """Value of two registers, the most significant first."""
    return float(struct.unpack(">f", struct.pack(">HH", *words))[0])


@pytest.mark.parametrize("transport", TRANSPORTS)
@pytest.mark.parametrize("name", PEERS)
def test_every_table_is_read(
    connect: Callable[[str, str], Peer], publish: Publish, name: str, transport: str
) -> None:
    peer = connect(name, transport)
    publish("/v/leak", Bool(True))
    publish("/v/rpm", Float64(-123.4))
    publish("/v/alarms/fire", Bool(True))
    publish("/v/alarms/flood", Bool(True))
    publish("/v/battery", BatteryState(voltage=25.5, cell_voltage=[4.0, 4.25]))
    eventually(lambda: peer.read("discrete", 0, 2) == [1, 1], "the leak")
    eventually(lambda: peer.read("input", 0, 1) == [65536 - 123], "the speed")
    eventually(lambda: peer.read("input", 5, 1) == [0b101], "the alarms")
    eventually(lambda: real(peer.read("input", 1, 2)) == 25.5, "the voltage")
    eventually(lambda: real(peer.read("input", 3, 2)[::-1]) == 4.25, "the cell's voltage")
    assert peer.read("input", 6, 3) == [0x6F74, 0x7465, 0x7200]
    assert peer.read("coil", 0, 10) == [0] * 10
    assert peer.read("holding", 10, 20) == [0] * 20


@pytest.mark.parametrize("transport", TRANSPORTS)
@pytest.mark.parametrize("name", PEERS)
def test_every_table_is_written(
    connect: Callable[[str, str], Peer], name: str, transport: str
) -> None:
    peer = connect(name, transport)
    with (
        recorder("/v/pump", Bool) as pump,
        recorder("/v/speed", Float32) as speed,
        recorder("/v/setpoint", Float32) as setpoint,
    ):
        for topic in (pump, speed, setpoint):
            topic.connected()
        assert peer.write("coil", 0, [1])
        assert peer.write("coil", 1, [1, 0, 1, 0, 0, 0, 0, 0, 1])
        assert peer.write("holding", 0, [5000])
        assert peer.write("holding", 1, list(struct.unpack(">HH", struct.pack(">f", 2.5))))
        assert peer.write("holding", 10, list(range(20)))
        assert pump.received()[0].data
        assert setpoint.received()[0].data == 2.5
        assert speed.received()[0].data == pytest.approx(50.0)
        assert peer.read("coil", 0, 10) == [1, 1, 0, 1, 0, 0, 0, 0, 0, 1]
        assert peer.read("holding", 10, 20) == list(range(20))
        assert not peer.write("holding", 0, [20000]), "out of range"
        assert not peer.write("holding", 100, [1]), "not there"
        # The writer falls silent.
        eventually(lambda: speed.messages[-1].data == 0.0, "the safe speed")


@pytest.mark.parametrize("transport", TRANSPORTS)
@pytest.mark.parametrize("name", ["libmodbus", "pymodbus"])
def test_masks_and_writes_with_reads_are_executed(
    connect: Callable[[str, str], Peer], name: str, transport: str
) -> None:
    peer = connect(name, transport)
    assert isinstance(peer, Libmodbus | Pymodbus)
    if isinstance(peer, Libmodbus):
        mask, write_and_read = peer.mask, peer.write_and_read
    else:

        def mask(address: int, and_mask: int, or_mask: int) -> bool:
            return bool(peer.ask("mask", address, and_mask, or_mask))

        def write_and_read(address: int, values: list[int], read: int) -> list[int]:
            return list(peer.ask("write_and_read", address, values, read))

    assert peer.write("holding", 10, [0x12])
    assert mask(10, 0xF2, 0x25)
    assert peer.read("holding", 10, 1) == [0x17]
    assert write_and_read(10, [7, 8], 3) == [7, 8, 0]


@pytest.mark.parametrize("transport", TRANSPORTS)
def test_a_device_says_who_it_is(connect: Callable[[str, str], Peer], transport: str) -> None:
    peer = connect("pymodbus", transport)
    assert isinstance(peer, Pymodbus)
    assert peer.ask("identity") == {"0": "Trident", "1": "trident_bridges", "2": "0.1.0"}


def test_exceptions_have_the_codes_of_the_protocol(connect: Callable[[str, str], Peer]) -> None:
    peer = connect("pymodbus", "tcp")
    assert isinstance(peer, Pymodbus)
    assert peer.ask("exception", 0, 20000) == 3
    assert peer.ask("exception", 99, 1) == 2
    assert peer.ask("exception", 1, 1) == 2, "half of a value"
    assert peer.ask("exception", 10, 1) == 0
