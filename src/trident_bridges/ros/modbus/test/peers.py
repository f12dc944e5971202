# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Clients of other projects behind one interface: libmodbus, mbpoll (made of it), pymodbus."""

from __future__ import annotations

import ctypes
import ctypes.util
import json
import re
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import Any, ClassVar, Protocol

import pytest
from plc import Line, run
from trident.testing.clients import clients_python

UNIT = 7


class Peer(Protocol):
    """A client of another project."""

    def read(self, table: str, address: int, count: int) -> list[int]:
        """Bits or registers of a table: coil, discrete, input, holding."""

    def write(self, table: str, address: int, values: Sequence[int]) -> bool:
        """Whether the device has taken bits or registers."""

    def close(self) -> None:
        """Ends the connection."""


class Libmodbus:
    """The library itself, by ctypes."""

    _READ: ClassVar = {
        "coil": "modbus_read_bits",
        "discrete": "modbus_read_input_bits",
        "input": "modbus_read_input_registers",
        "holding": "modbus_read_registers",
    }

    def __init__(self, line: Line) -> None:
        name = ctypes.util.find_library("modbus")
        if name is None:
            pytest.skip("SKIPPED: libmodbus is not installed: ./trident setup")
        self._library: Any = ctypes.CDLL(name, use_errno=True)
        for function in ("modbus_new_tcp", "modbus_new_rtu"):
            getattr(self._library, function).restype = ctypes.c_void_p
        if line.port:
            context = self._library.modbus_new_tcp(b"127.0.0.1", line.port)
        else:
            parity = ctypes.c_char(b"N")
            context = self._library.modbus_new_rtu(line.client.encode(), 115200, parity, 8, 1)
        self._context = ctypes.c_void_p(context)
        self._library.modbus_set_slave(self._context, UNIT)
        self._library.modbus_set_response_timeout(self._context, 5, 0)
        assert self._library.modbus_connect(self._context) == 0

    def read(self, table: str, address: int, count: int) -> list[int]:
        """See Peer."""
        is_bit = table in ("coil", "discrete")
        values = ((ctypes.c_uint8 if is_bit else ctypes.c_uint16) * count)()
        done = getattr(self._library, self._READ[table])(self._context, address, count, values)
        return list(values) if done == count else []

    def write(self, table: str, address: int, values: Sequence[int]) -> bool:
        """See Peer."""
        if len(values) == 1:
            name = "modbus_write_bit" if table == "coil" else "modbus_write_register"
            return bool(getattr(self._library, name)(self._context, address, values[0]) == 1)
        is_bit = table == "coil"
        array = ((ctypes.c_uint8 if is_bit else ctypes.c_uint16) * len(values))(*values)
        name = "modbus_write_bits" if is_bit else "modbus_write_registers"
        done = getattr(self._library, name)(self._context, address, len(values), array)
        return bool(done == len(values))

    def mask(self, address: int, and_mask: int, or_mask: int) -> bool:
        """Function 22."""
        function = self._library.modbus_mask_write_register
        return bool(function(self._context, address, and_mask, or_mask) == 1)

    def write_and_read(self, address: int, values: Sequence[int], read: int) -> list[int]:
        """Function 23: what is read behind what is written, from `address` on."""
        sent = (ctypes.c_uint16 * len(values))(*values)
        got = (ctypes.c_uint16 * read)()
        function = self._library.modbus_write_and_read_registers
        done = function(self._context, address, len(values), sent, address, read, got)
        return list(got) if done == read else []

    def close(self) -> None:
        """See Peer."""
        self._library.modbus_close(self._context)
        self._library.modbus_free(self._context)


class Mbpoll:
    """The command-line program, once for each request."""

    _TYPE: ClassVar = {"coil": "0", "discrete": "1", "input": "3", "holding": "4"}

    def __init__(self, line: Line) -> None:
        where = ["-m", "tcp", "-p", str(line.port)] if line.port else ["-m", "rtu", "-b", "115200"]
        self._options = ["mbpoll", *where, "-a", str(UNIT), "-0", "-o", "5"]
        if not line.port:
            self._options += ["-P", "none"]
        self._where = "127.0.0.1" if line.port else line.client

    def read(self, table: str, address: int, count: int) -> list[int]:
        """See Peer."""
        words = ["-1", "-t", self._TYPE[table], "-r", str(address), "-c", str(count), self._where]
        output = run([*self._options, *words])
        return [int(value) % 65536 for value in re.findall(r"^\[\d+\]:\s+(-?\d+)", output, re.M)]

    def write(self, table: str, address: int, values: Sequence[int]) -> bool:
        """See Peer."""
        words = ["-t", self._TYPE[table], "-r", str(address), self._where, *map(str, values)]
        done = subprocess.run([*self._options, *words], capture_output=True, check=False)
        return done.returncode == 0

    def close(self) -> None:
        """See Peer."""


class Pymodbus:
    """A process of .venv-clients that executes what it reads."""

    def __init__(self, line: Line) -> None:
        script = Path(__file__).parent / "ask_by_pymodbus.py"
        where = [str(line.port)] if line.port else [line.client]
        self._process = subprocess.Popen(
            [clients_python("pymodbus"), script, *where],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )

    def ask(self, function: str, *arguments: object) -> Any:
        """What the client returns; None: an exception of the device."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(json.dumps([function, *arguments]) + "\n")
        self._process.stdin.flush()
        return json.loads(self._process.stdout.readline())

    def read(self, table: str, address: int, count: int) -> list[int]:
        """See Peer."""
        return [int(value) for value in self.ask("read", table, address, count) or []]

    def write(self, table: str, address: int, values: Sequence[int]) -> bool:
        """See Peer."""
        return self.ask("write", table, address, list(values)) is not None

    def close(self) -> None:
        """See Peer."""
        self._process.communicate(timeout=60)


PEERS: dict[str, type[Libmodbus] | type[Mbpoll] | type[Pymodbus]] = {
    "libmodbus": Libmodbus,
    "mbpoll": Mbpoll,
    "pymodbus": Pymodbus,
}
