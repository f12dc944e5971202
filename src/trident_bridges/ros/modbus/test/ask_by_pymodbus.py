# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Executes requests by pymodbus: JSON lists on standard input, a value on standard output each.

Run by the Python of .venv-clients; its argument is a TCP port or a serial device.
"""

from __future__ import annotations

import json
import sys
from typing import Any

from pymodbus.client import ModbusSerialClient, ModbusTcpClient

UNIT = 7


class Asker:
    """One connection."""

    def __init__(self, where: str) -> None:
        if where.isdigit():
            self.client: Any = ModbusTcpClient("127.0.0.1", port=int(where), timeout=10)
        else:
            self.client = ModbusSerialClient(where, baudrate=115200, timeout=10)
        assert self.client.connect()

    def read(self, table: str, address: int, count: int) -> Any:
        """Bits or registers."""
        function = {
            "coil": self.client.read_coils,
            "discrete": self.client.read_discrete_inputs,
            "input": self.client.read_input_registers,
            "holding": self.client.read_holding_registers,
        }[table]
        answer = function(address, count=count, device_id=UNIT)
        if answer.isError():
            return None
        return answer.bits[:count] if table in ("coil", "discrete") else answer.registers

    def write(self, table: str, address: int, values: list[int]) -> Any:
        """Bits or registers."""
        if table == "coil":
            bits = [bool(value) for value in values]
            if len(bits) == 1:
                answer = self.client.write_coil(address, bits[0], device_id=UNIT)
            else:
                answer = self.client.write_coils(address, bits, device_id=UNIT)
        elif len(values) == 1:
            answer = self.client.write_register(address, values[0], device_id=UNIT)
        else:
            answer = self.client.write_registers(address, values, device_id=UNIT)
        return None if answer.isError() else True

    def exception(self, address: int, value: int) -> int:
        """Code of the exception that a write of a register has; 0: none."""
        answer = self.client.write_register(address, value, device_id=UNIT)
        return int(answer.exception_code) if answer.isError() else 0

    def mask(self, address: int, and_mask: int, or_mask: int) -> bool:
        """Function 22."""
        answer = self.client.mask_write_register(
            address=address, and_mask=and_mask, or_mask=or_mask, device_id=UNIT
        )
        return not answer.isError()

    def write_and_read(self, address: int, values: list[int], read: int) -> Any:
        """Function 23."""
        answer = self.client.readwrite_registers(
            read_address=address,
            read_count=read,
            write_address=address,
            values=values,
            device_id=UNIT,
        )
        return None if answer.isError() else answer.registers

    def identity(self) -> dict[int, str]:
        """Function 43 / 14: the basic objects."""
        answer = self.client.read_device_information(read_code=1, device_id=UNIT)
        return {number: text.decode() for number, text in answer.information.items()}


def main() -> None:
    """Serves standard input."""
    asker = Asker(sys.argv[1])
    for line in sys.stdin:
        function, *arguments = json.loads(line)
        print(json.dumps(getattr(asker, function)(*arguments)), flush=True)


if __name__ == "__main__":
    main()
