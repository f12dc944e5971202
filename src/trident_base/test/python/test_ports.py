# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import socket
from pathlib import Path

import pytest
from trident_base.ports import free_port

from trident_base import ports


def test_a_free_port_can_be_listened_on() -> None:
    with socket.socket() as server:
        server.bind(("", free_port()))
        server.listen()


def test_the_system_gives_it_to_nobody_else() -> None:
    low, high = (int(word) for word in ports._EPHEMERAL.read_text(encoding="ascii").split())
    assert not any(low <= free_port() <= high for _ in range(50))


def test_one_that_is_taken_is_not_chosen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    limits = tmp_path / "ip_local_port_range"
    with socket.socket() as server:
        server.bind(("", free_port()))
        server.listen()
        taken = server.getsockname()[1]
        limits.write_text(f"{taken + 1} 65535\n", encoding="ascii")
        monkeypatch.setattr(ports, "_EPHEMERAL", limits)
        monkeypatch.setattr(ports, "_FIRST", taken)
        with pytest.raises(OSError, match="no free port found"):
            free_port()
