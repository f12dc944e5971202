# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A TCP connection as a capture file: a proxy notes what passes, a writer adds the headers."""

from __future__ import annotations

import selectors
import socket
import struct
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

from trident_base.ports import free_port

# Of the client and of the device in the file; 502 is the port of Modbus.
_ADDRESSES = (bytes([127, 0, 0, 1]), bytes([127, 0, 0, 2]))
_PORTS = (49152, 502)
_LINK_ETHERNET = 1
_SYN, _ACK, _PUSH, _FIN = 0x02, 0x10, 0x08, 0x01
_WINDOW = 65535


@dataclass
class Conversation:
    """What passed the proxy, and where it listens.

    Attributes:
        port: of the proxy.
        pieces: the sender (0: client, 1: device) and bytes of each piece, in order.
    """

    port: int
    pieces: list[tuple[int, bytes]] = field(default_factory=list)


def _relay(listener: socket.socket, target: int, conversation: Conversation) -> None:
    """Serves one client until it, or the device, ends the connection."""
    with ExitStack() as stack:
        client, _ = listener.accept()
        ends = (client, socket.create_connection(("127.0.0.1", target)))
        ready = stack.enter_context(selectors.DefaultSelector())
        for sender, end in enumerate(ends):
            stack.enter_context(end)
            ready.register(end, selectors.EVENT_READ, sender)
        # Who closes while bytes are still unread resets the connection: that is its end, too.
        stack.enter_context(suppress(ConnectionError))
        while True:
            for key, _ in ready.select():
                piece = ends[key.data].recv(4096)
                if not piece:
                    return
                conversation.pieces.append((key.data, piece))
                ends[1 - key.data].sendall(piece)


@contextmanager
def recorded(target: int) -> Iterator[Conversation]:
    """A proxy in front of a TCP port, for one connection, which has ended when this does.

    Args:
        target: TCP port of the device, on this computer.
    """
    with socket.create_server(("127.0.0.1", free_port())) as listener:
        conversation = Conversation(listener.getsockname()[1])
        thread = threading.Thread(target=_relay, args=(listener, target, conversation))
        thread.start()
        yield conversation
        thread.join()


def _checksum(data: bytes) -> int:
    """Of the Internet protocols (RFC 1071)."""
    padded = data + b"\0" * (len(data) % 2)
    total = sum(struct.unpack(f">{len(padded) // 2}H", padded))
    while total > 0xFFFF:
        total = (total & 0xFFFF) + (total >> 16)
    return ~total & 0xFFFF


class _Capture:
    """The frames of one TCP connection, as a file of tcpdump's format."""

    def __init__(self) -> None:
        self.data = struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, _LINK_ETHERNET)
        self._next = [0, 0]  # sequence numbers
        self._frames = 0

    def add(self, sender: int, flags: int, piece: bytes = b"") -> None:
        """A segment of the client (0) or of the device (1)."""
        segment = self._segment(sender, flags, piece)
        packet = self._ip_header(sender, len(segment)) + segment
        frame = b"\2\0\0\0\0" + bytes([2 - sender]) + b"\2\0\0\0\0" + bytes([1 + sender])
        frame += struct.pack(">H", 0x0800) + packet
        self._frames += 1
        time_s, time_us = divmod(1000 * self._frames, 10**6)
        self.data += struct.pack("<IIII", time_s, time_us, len(frame), len(frame)) + frame
        self._next[sender] += len(piece) + bool(flags & (_SYN | _FIN))

    def _segment(self, sender: int, flags: int, piece: bytes) -> bytes:
        acknowledged = self._next[1 - sender] if flags & _ACK else 0
        ports = (_PORTS[sender], _PORTS[1 - sender])
        numbers = (self._next[sender], acknowledged, 5 << 4, flags, _WINDOW)
        pseudo = _ADDRESSES[sender] + _ADDRESSES[1 - sender]
        pseudo += struct.pack(">HH", socket.IPPROTO_TCP, 20 + len(piece))
        blank = struct.pack(">HHIIBBHHH", *ports, *numbers, 0, 0)
        checksum = _checksum(pseudo + blank + piece)
        return struct.pack(">HHIIBBHHH", *ports, *numbers, checksum, 0) + piece

    def _ip_header(self, sender: int, length: int) -> bytes:
        addresses = _ADDRESSES[sender] + _ADDRESSES[1 - sender]
        start = struct.pack(">BBHHHBB", 0x45, 0, 20 + length, self._frames, 0x4000, 64, 6)
        checksum = _checksum(start + b"\0\0" + addresses)
        return start + struct.pack(">H", checksum) + addresses


def write_capture(path: Path, conversation: Conversation) -> None:
    """The whole connection, from its first SYN to its last FIN."""
    capture = _Capture()
    for sender, flags in ((0, _SYN), (1, _SYN | _ACK), (0, _ACK)):
        capture.add(sender, flags)
    for sender, piece in conversation.pieces:
        capture.add(sender, _PUSH | _ACK, piece)
    for sender, flags in ((0, _FIN | _ACK), (1, _FIN | _ACK), (0, _ACK)):
        capture.add(sender, flags)
    path.write_bytes(capture.data)
