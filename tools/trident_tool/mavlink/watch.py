# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Shows what is said over MAVLink: messages per second of each sender."""

from __future__ import annotations

import json
import socket
import subprocess
import threading
import time
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from trident_tool.mavlink.address import Address

_BLOCK = 65536


class Sender(NamedTuple):
    """Who says what.

    Attributes:
        system: id of the vehicle or ground station.
        component: id of its part.
        message: name of the type.
    """

    system: int
    component: int
    message: str


class Board:
    """Counts messages and keeps the last of each; filled by one thread and shown by another."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._counts: Counter[Sender] = Counter()
        self._last: dict[Sender, Mapping[str, Any]] = {}

    def add(self, row: Mapping[str, Any]) -> None:
        """A line of mavlink_decode; lines that are no message are left out."""
        if "name" not in row:
            return
        sender = Sender(row["system"], row["component"], row["name"])
        with self._lock:
            self._counts[sender] += 1
            self._last[sender] = row.get("fields", {})

    def table(self, seconds: float) -> str:
        """What came since the last call, ``seconds`` ago: a line for each sender and message."""
        with self._lock:
            counts, self._counts = self._counts, Counter()
            last = dict(self._last)
        lines = [f"{'system':>6} {'comp':>4} {'message':<28} {'Hz':>7}  last"]
        for sender in sorted(last):
            rate = counts[sender] / seconds
            fields = ", ".join(f"{key} {_short(value)}" for key, value in last[sender].items())
            head = f"{sender.system:>6} {sender.component:>4} {sender.message:<28} {rate:>7.1f}"
            lines.append(f"{head}  {fields[:100]}")
        return "\n".join(lines)


def _short(value: object) -> str:
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, list):
        return f"[{len(value)}]"
    return str(value)


def _pump(link: socket.socket, decoder: subprocess.Popen[bytes]) -> None:
    """Hands what is received to the decoder, until either ends."""
    assert decoder.stdin is not None
    try:
        while block := link.recv(_BLOCK):
            decoder.stdin.write(block)
            decoder.stdin.flush()
    except OSError:
        pass  # the socket or the pipe was closed
    decoder.stdin.close()


def _collect(decoder: subprocess.Popen[bytes], board: Board) -> None:
    assert decoder.stdout is not None
    for line in decoder.stdout:
        board.add(json.loads(line))


def watch(decoder_path: Path, environment: Mapping[str, str], address: Address, count: int) -> int:
    """Prints a table each second, ``count`` times or, if 0, until interrupted.

    Returns:
        The exit code: 1 when nothing was said.

    Raises:
        TridentError: nothing listens at the address, or its port is taken.
    """
    board, heard = Board(), False
    with address.connected() if address.kind == "tcp" else address.bound() as link:
        decoder = subprocess.Popen(
            [decoder_path, "--mavlink1"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=dict(environment),
        )
        threading.Thread(target=_pump, args=(link, decoder), daemon=True).start()
        threading.Thread(target=_collect, args=(decoder, board), daemon=True).start()
        try:
            tables = 0
            while (tables < count or count == 0) and decoder.poll() is None:
                time.sleep(1.0)
                table = board.table(1.0)
                heard = heard or "\n" in table
                print(table, end="\n\n", flush=True)
                tables += 1
        finally:
            decoder.terminate()
            decoder.wait()
    return 0 if heard else 1
