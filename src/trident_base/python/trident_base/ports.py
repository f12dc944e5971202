# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Ports for servers that are about to start."""

from __future__ import annotations

import random
import socket
from pathlib import Path

_EPHEMERAL = Path("/proc/sys/net/ipv4/ip_local_port_range")
_FIRST = 11400  # beyond ROS and Gazebo
_TRIES = 100


def free_port() -> int:
    """A TCP port that nobody listens on, and that the system gives to nobody who asks for any.

    One that it gives to all would be taken by another node between this call and the bind of the
    server it is for, which then would be taken for that server.

    Raises:
        OSError: all that were tried are taken.
    """
    end = int(_EPHEMERAL.read_text(encoding="ascii").split()[0])
    ports = range(_FIRST, end) if end > _FIRST else range(1024, 65536)
    chosen = random.SystemRandom()
    for _ in range(_TRIES):
        port = chosen.choice(ports)
        with socket.socket() as probe:
            try:
                probe.bind(("", port))
            except OSError:
                continue
            return port
    raise OSError(f"no free port found from {ports.start} to {ports.stop - 1}")
