# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Ports that vehicles send their telemetry to: what comes is counted."""

from __future__ import annotations

import selectors
import socket
import struct
import threading
from collections.abc import Iterator
from types import TracebackType
from typing import NamedTuple

_BUFFER_BYTES = 4 << 20
_LOOK_S = 0.1
_LONGEST = 2048
_START2 = 0xFD  # of a packet of MAVLink 2
_HEADER = 10  # bytes of it
_SYSTEM_AT, _ID_AT = 5, 7
_CHECKSUM, _SIGNATURE = 2, 13  # bytes behind its payload
_ATTITUDE = 30  # its payload begins with time_boot_ms


class Heard(NamedTuple):
    """What has come so far.

    Attributes:
        packets: of all vehicles at all ports.
        bytes: of these.
        sim_s: newest time of the world that a vehicle has reported.
    """

    packets: int
    bytes: int
    sim_s: float


def packets_of(datagram: bytes) -> Iterator[bytes]:
    """Packets of MAVLink 2, up to the first bytes that begin no other one."""
    at = 0
    while len(datagram) - at > _HEADER and datagram[at] == _START2:
        size = _HEADER + datagram[at + 1] + _CHECKSUM + _SIGNATURE * (datagram[at + 2] & 1)
        yield datagram[at : at + size]
        at += size


def attitude_time_s(packet: bytes) -> float | None:
    """Time since boot of an ATTITUDE; None: it is another message.

    Args:
        packet: of MAVLink 2. Zeros at the end of its payload may be left out.
    """
    if int.from_bytes(packet[_ID_AT:_HEADER], "little") != _ATTITUDE:
        return None
    payload = packet[_HEADER : _HEADER + packet[1]].ljust(4, b"\0")
    return float(struct.unpack_from("<I", payload)[0]) * 1e-3


class TelemetryListener:
    """A ground station that says nothing, and a port for each vehicle; use it in `with`."""

    def __init__(self) -> None:
        self._selector = selectors.DefaultSelector()
        self._sockets: list[socket.socket] = []
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._listen)
        self._packets = self._bytes = 0
        self._sim_s = 0.0
        self._systems: set[int] = set()
        self.port = self.add_port()

    def __enter__(self) -> TelemetryListener:
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._over.set()
        self._thread.join()
        self._selector.close()
        for one in self._sockets:
            one.close()

    def add_port(self) -> int:
        """One more UDP port of loopback, which is listened to from now on."""
        one = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        one.bind(("127.0.0.1", 0))
        one.setblocking(False)
        one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _BUFFER_BYTES)
        self._sockets.append(one)
        self._selector.register(one, selectors.EVENT_READ)
        return int(one.getsockname()[1])

    def systems(self) -> set[int]:
        """Ids of the vehicles that have been heard."""
        return set(self._systems)

    def snapshot(self) -> Heard:
        """What has come so far."""
        return Heard(self._packets, self._bytes, self._sim_s)

    def _listen(self) -> None:
        while not self._over.is_set():
            for key, _ in self._selector.select(_LOOK_S):
                self._read(key.fileobj)

    def _read(self, one: object) -> None:
        assert isinstance(one, socket.socket)
        while True:
            try:
                datagram = one.recv(_LONGEST)
            except BlockingIOError:
                return
            self._bytes += len(datagram)
            for packet in packets_of(datagram):
                self._note(packet)

    def _note(self, packet: bytes) -> None:
        self._packets += 1
        time_s = attitude_time_s(packet)
        if time_s is not None:
            self._systems.add(packet[_SYSTEM_AT])
            self._sim_s = max(self._sim_s, time_s)
