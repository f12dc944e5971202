# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Messages between a sweep and its fork server: JSON, a line each, over a socket."""

from __future__ import annotations

import json
import select
import socket
from typing import Any

_CHUNK = 65536


class Channel:
    """One end; `closed` once the other has gone."""

    def __init__(self, end: socket.socket) -> None:
        """Take over a connected stream socket."""
        self._socket = end
        self._rest = b""
        self.closed = False

    def fileno(self) -> int:
        """For select."""
        return self._socket.fileno()

    def send(self, message: dict[str, Any]) -> None:
        """Sends a message; one that nobody is there for is dropped, and `closed` says so."""
        try:
            self._socket.sendall(json.dumps(message).encode() + b"\n")
        except OSError:
            self.closed = True

    def receive(self, timeout_s: float) -> list[dict[str, Any]]:
        """The messages that are there; waits for the first, at most so long [s]."""
        messages = self._split()
        while not messages and not self.closed:
            if not select.select([self._socket], [], [], timeout_s)[0]:
                break
            self._read()
            messages = self._split()
        return messages

    def close(self) -> None:
        """Closes this end."""
        self.closed = True
        self._socket.close()

    def _read(self) -> None:
        try:
            data = self._socket.recv(_CHUNK)
        except OSError:
            data = b""
        self._rest += data
        self.closed = not data

    def _split(self) -> list[dict[str, Any]]:
        *lines, self._rest = self._rest.split(b"\n")
        return [json.loads(line) for line in lines]
