# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A Modbus device and its client under hostile messages."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count
from pathlib import Path
from typing import Any

import pytest
from hostile import Asked, answers_on, started
from sensor_msgs.msg import BatteryState
from std_msgs.msg import Float32, Float64
from trident.testing import Ros, program
from trident_base.ports import free_port

#: What the device measures is what its client publishes, and the reverse.
MAP = """unit: 1
transport: {{kind: tcp, host: 127.0.0.1, port: {port}}}
poll: 50.0
registers:
  - {{name: level, table: input, address: 0, type: float32,
     topic: level, message: std_msgs/Float64}}
  - {{name: force, table: holding, address: 0, type: float32, access: write,
     topic: force, message: std_msgs/Float64}}
"""


def device_and_client(ros: Ros, folder: Path) -> dict[str, Any]:
    """Both, started with one map."""
    file = folder / "plc.yaml"
    file.write_text(MAP.format(port=free_port()), encoding="utf-8")
    processes = {}
    for name, kind in (("client", "client"), ("plc", "server")):
        ros.set_param(f"/{name}/{name}", {"map": str(file)})
        command = [program("trident_bridges", f"modbus_{kind}_node"), f"__name:={name}"]
        processes[name] = started(ros, f"/{name}/{name}", [*command, f"__ns:=/{name}"])
    return processes


def changing() -> Callable[[], Float64]:
    """Another number each time: both ends pass on what has changed."""
    numbers = count(1)
    return lambda: Float64(float(next(numbers)))


@pytest.mark.fuzzes("trident_bridges/modbus_server_node")
def test_device(ros: Ros, tmp_path: Path) -> None:
    device = device_and_client(ros, tmp_path)["plc"]
    answers_on(device, "/plc/plc", Asked("/plc/level", changing(), "/client/level", Float64))


@pytest.mark.fuzzes("trident_bridges/modbus_client_node")
def test_client(ros: Ros, tmp_path: Path) -> None:
    client = device_and_client(ros, tmp_path)["client"]
    answers_on(client, "/client/client", Asked("/client/force", changing(), "/plc/force", Float64))


#: What the vessel of the next two nodes measures.
OTTER = str(Path(__file__).parents[2] / "config" / "bridges" / "otter_plc.yaml")
THRUST = "/boat/thrusters/left_thrust"


def thrust() -> Float32:
    return Float32(20.0)


@pytest.mark.fuzzes("trident_bridges/vessel_plant.py")
def test_plant(ros: Ros) -> None:
    command = [program("trident_bridges", "vessel_plant.py"), "__name:=plant", "__ns:=/boat"]
    process = started(ros, "/boat/plant", command)
    answers_on(process, "/boat/plant", Asked(THRUST, thrust, "/boat/battery", BatteryState))


@pytest.mark.fuzzes("trident_bridges/plc_pilot.py")
def test_pilot(ros: Ros, tmp_path: Path) -> None:
    ros.set_param(
        "/bridge/pilot",
        {"plan": [[0.0, 60.0, 60.0]], "vessel": "boat", "map": OTTER, "out_dir": str(tmp_path)},
    )
    command = [program("trident_bridges", "plc_pilot.py"), "__name:=pilot", "__ns:=/bridge"]
    process = started(ros, "/bridge/pilot", command)
    speed = "/bridge/thrusters/left_thrust_cmd"
    answers_on(process, "/bridge/pilot", Asked(THRUST, thrust, speed, Float32))
