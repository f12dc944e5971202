# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A device of all four tables as a node, over TCP or a pair of pseudo-terminals."""

from __future__ import annotations

import os
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from trident.testing import Process, Ros, eventually, program
from trident_base.ports import free_port

REGISTERS = """
registers:
  - {name: pump, table: coil, address: 0, access: read_write, topic: pump}
  - {name: lamps, table: coil, address: 1, count: 9, access: read_write}
  - {name: leak, table: discrete, address: 0, topic: leak}
  - {name: door, table: discrete, address: 1, initial: 1}
  - {name: rpm, table: input, address: 0, type: int16, topic: rpm, message: std_msgs/Float64}
  - {name: volt, table: input, address: 1, type: float32, topic: battery, field: voltage,
     message: sensor_msgs/BatteryState}
  - {name: cell, table: input, address: 3, type: float32, words: little, topic: battery,
     field: 'cell_voltage[1]', message: sensor_msgs/BatteryState}
  - {name: alarms, table: input, address: 5, type: bits(fire - flood), topic: alarms}
  - {name: model, table: input, address: 6, type: string(6), initial: otter}
  - {name: speed, table: holding, address: 0, type: int16, scale: 0.01, access: write, min: -100,
     max: 100, safe: 0, timeout: 0.3, topic: speed, message: std_msgs/Float32}
  - {name: setpoint, table: holding, address: 1, type: float32, access: read_write, topic: setpoint}
  - {name: row, table: holding, address: 10, count: 20, access: read_write, topic: row}
"""

TCP = "transport: {{kind: tcp, port: {port}}}\n"
RTU = "transport: {{kind: rtu, device: {device}, baud: 115200, parity: none, jitter: 0.05}}\n"


@dataclass
class Line:
    """Where a device is: a TCP port, or the two ends of a serial line.

    Attributes:
        port: of TCP; 0: a line.
        device: end of the line that a device has.
        client: end of the line that a client has.
        held: descriptors of both ends, to be closed with close().
    """

    port: int = 0
    device: str = ""
    client: str = ""
    held: list[int] = field(default_factory=list)

    def close(self) -> None:
        """Lets go of a serial line."""
        while self.held:
            os.close(self.held.pop())

    def transport(self, is_device: bool) -> str:
        """The transport of a map file."""
        if self.port:
            return TCP.format(port=self.port)
        return RTU.format(device=self.device if is_device else self.client)


def make_line(kind: str, ros: Ros, folder: Path) -> Line:
    """A free TCP port, or a line that socat makes of two pseudo-terminals."""
    if kind == "tcp":
        return Line(port=free_port())
    ends = [folder / name for name in ("device", "client")]
    ros.launch(["socat", *(f"pty,raw,echo=0,link={end}" for end in ends)])
    eventually(lambda: all(end.exists() for end in ends), "the serial line")
    # socat stops when nobody has an end open any more, as between two clients.
    held = [os.open(end, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK) for end in ends]
    return Line(device=str(ends[0]), client=str(ends[1]), held=held)


def write_map(folder: Path, name: str, line: Line, *, is_device: bool, head: str = "") -> str:
    """A map file of these registers."""
    path = folder / name
    text = f"unit: 7\npoll: 50\n{head}{line.transport(is_device)}{REGISTERS}"
    path.write_text(text, encoding="utf-8")
    return str(path)


def start_node(ros: Ros, role: str, map_file: str, name_space: str) -> Process:
    """Starts modbus_server_node or modbus_client_node."""
    process = ros.launch(
        [
            program("trident_bridges", f"modbus_{role}_node"),
            f"__ns:={name_space}",
            "__name:=plc",
            f"_map:={map_file}",
        ]
    )
    eventually(lambda: f"{role} of unit 7" in process.log or process.popen.poll() is not None, "it")
    assert process.popen.poll() is None, process.log
    return process


def run(command: list[str]) -> str:
    """Output of a program that succeeds."""
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout
