# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A bare TCPROS subscriber: what has arrived on a connection, without rospy's threads."""

from __future__ import annotations

import select
import socket
import struct
import xmlrpc.client
from typing import Any

from harness import LIMIT_S


class RawSubscriber:
    """One connection to the one publisher of a topic."""

    def __init__(self, master: Any, topic: str, message_type: Any) -> None:
        self.message_type = message_type
        publishers = dict(master.getSystemState("/raw_subscriber")[2][0])[topic]
        uri = master.lookupNode("/raw_subscriber", publishers[0])[2]
        protocol = xmlrpc.client.ServerProxy(uri).requestTopic(
            "/raw_subscriber", topic, [["TCPROS"]]
        )[2]
        self._socket = socket.create_connection((protocol[1], protocol[2]), timeout=LIMIT_S)
        fields = {
            "callerid": "/raw_subscriber",
            "topic": topic,
            "type": message_type._type,
            "md5sum": message_type._md5sum,
            "tcp_nodelay": "1",
        }
        entries = [f"{name}={value}".encode() for name, value in fields.items()]
        body = b"".join(struct.pack("<I", len(entry)) + entry for entry in entries)
        self._socket.sendall(struct.pack("<I", len(body)) + body)
        self.header = self._block()

    def _exactly(self, size: int) -> bytes:
        data = b""
        while len(data) < size:
            part = self._socket.recv(size - len(data))
            assert part, "the publisher closed the connection"
            data += part
        return data

    def _block(self) -> bytes:
        return self._exactly(struct.unpack("<I", self._exactly(4))[0])

    def arrived(self) -> bool:
        """Whether the next message has begun to arrive."""
        return bool(select.select([self._socket], [], [], 0.0)[0])

    def next(self) -> Any:
        """The next message; waits for it."""
        return self.message_type().deserialize(self._block())

    def close(self) -> None:
        self._socket.close()
