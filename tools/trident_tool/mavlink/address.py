# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Addresses of MAVLink partners on a command line."""

from __future__ import annotations

import ipaddress
import socket
from dataclasses import dataclass

from trident_tool.workspace import TridentError


@dataclass(frozen=True)
class Address:
    """A partner.

    Attributes:
        kind: "tcp" or "udp".
        host: name or number.
        port: 1 to 65535.
    """

    kind: str
    host: str
    port: int

    @staticmethod
    def parse(text: str, *, allow_remote: bool) -> Address:
        """Reads "tcp:HOST:PORT" or "udp:HOST:PORT".

        Raises:
            TridentError: it has another form, or names another computer without allow_remote.
        """
        parts = text.split(":")
        if len(parts) != 3 or parts[0] not in ("tcp", "udp") or not parts[2].isdecimal():
            raise TridentError(f"address {text!r}, legal: tcp:HOST:PORT, udp:HOST:PORT")
        address = Address(parts[0], parts[1], int(parts[2]))
        if not 1 <= address.port <= 65535:
            raise TridentError(f"address {text!r}: port {address.port}, legal: 1 to 65535")
        if not allow_remote and not address.is_loopback():
            raise TridentError(
                f"address {text!r}: host {address.host!r} is another computer, legal: loopback; "
                "--allow-remote lifts this"
            )
        return address

    def is_loopback(self) -> bool:
        """Whether the host is this computer, over its loopback interface."""
        if self.host == "localhost":
            return True
        try:
            return ipaddress.ip_address(self.host).is_loopback
        except ValueError:
            return False

    def connected(self) -> socket.socket:
        """A socket that sends to the partner.

        Raises:
            TridentError: nothing listens there.
        """
        kind = socket.SOCK_STREAM if self.kind == "tcp" else socket.SOCK_DGRAM
        link = socket.socket(socket.AF_INET, kind)
        try:
            link.connect((self.host, self.port))
        except OSError as error:
            link.close()
            raise TridentError(f"{self}: {error.strerror or error}") from error
        return link

    def bound(self) -> socket.socket:
        """A UDP socket that receives what is sent to this address.

        Raises:
            TridentError: another program has the port.
        """
        link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            link.bind((self.host, self.port))
        except OSError as error:
            link.close()
            raise TridentError(f"{self}: {error.strerror or error}") from error
        return link

    def __str__(self) -> str:
        return f"{self.kind}:{self.host}:{self.port}"
