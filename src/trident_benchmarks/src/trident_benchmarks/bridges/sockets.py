# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Sockets of UDP as the kernel lists them."""

from __future__ import annotations

from pathlib import Path

_LISTS = (Path("/proc/net/udp"), Path("/proc/net/udp6"))
_ADDRESS, _DROPS = 1, -1  # columns


def drops_of(text: str, port: int) -> int:
    """Datagrams that did not fit the receive buffers of the sockets on a port.

    This is the counter that a socket itself gets by SO_RXQ_OVFL (socket(7)).

    Args:
        text: of /proc/net/udp.
        port: local.
    """
    rows = [line.split() for line in text.splitlines()[1:]]
    return sum(int(row[_DROPS]) for row in rows if int(row[_ADDRESS].split(":")[1], 16) == port)


def kernel_drops(port: int) -> int:
    """The same of this computer, now."""
    return sum(drops_of(path.read_text("utf-8"), port) for path in _LISTS if path.exists())
