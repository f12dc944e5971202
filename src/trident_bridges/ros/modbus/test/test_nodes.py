# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""modbus_server_node and modbus_client_node with each other, and with what goes wrong."""

from __future__ import annotations

import socket
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from plc import Line, make_line, start_node, write_map
from sensor_msgs.msg import BatteryState
from std_msgs.msg import Bool, Float32, Float64, String, UInt16MultiArray
from trident.testing import Process, Ros, eventually, program, recorder

Publish = Callable[[str, Any], None]


def start_pair(ros: Ros, folder: Path, transport: str) -> tuple[Process, Process, Line]:
    """A device in /v, its client in /c."""
    line = make_line(transport, ros, folder)
    line.close()  # both nodes hold their ends
    server = start_node(ros, "server", write_map(folder, "s.yaml", line, is_device=True), "v")
    client = start_node(ros, "client", write_map(folder, "c.yaml", line, is_device=False), "c")
    eventually(lambda: "unit 7 answers" in client.log, "the first answer")
    return server, client, line


@pytest.mark.parametrize("transport", ["tcp", "rtu"])
def test_what_the_device_measures_is_published_by_its_client(
    ros: Ros, tmp_path: Path, publish: Publish, transport: str
) -> None:
    start_pair(ros, tmp_path, transport)
    publish("/v/rpm", Float64(321.0))
    publish("/v/battery", BatteryState(voltage=25.5, cell_voltage=[1.0, 4.25]))
    publish("/v/alarms/flood", Bool(True))
    with (
        recorder("/c/rpm", Float64) as rpms,
        recorder("/c/battery", BatteryState) as batteries,
        recorder("/c/alarms/flood", Bool) as floods,
        recorder("/c/alarms/fire", Bool) as fires,
    ):
        eventually(lambda: any(m.data == 321.0 for m in rpms.messages), "the speed")
        eventually(lambda: any(m.voltage == 25.5 for m in batteries.messages), "the voltage")
        eventually(lambda: any(m.data for m in floods.messages), "the flood")
        state = batteries.messages[-1]
        assert list(state.cell_voltage) == [0.0, 4.25]
        assert state.header.stamp.to_sec() > 0
        assert not any(m.data for m in fires.messages)


@pytest.mark.parametrize("transport", ["tcp", "rtu"])
def test_commands_go_from_the_clients_topics_to_the_devices(
    ros: Ros, tmp_path: Path, publish: Publish, transport: str
) -> None:
    start_pair(ros, tmp_path, transport)
    with (
        recorder("/v/setpoint", Float32) as setpoints,
        recorder("/v/row", UInt16MultiArray) as rows,
        recorder("/c/setpoint/state", Float32) as states,
    ):
        publish("/c/setpoint", Float32(2.5))
        publish("/c/row", UInt16MultiArray(data=list(range(100, 120))))
        eventually(lambda: any(m.data == 2.5 for m in setpoints.messages), "the set-point")
        eventually(
            lambda: any(list(m.data) == list(range(100, 120)) for m in rows.messages), "the row"
        )
        eventually(lambda: any(m.data == 2.5 for m in states.messages), "the state")


def test_a_device_falls_back_to_safe_values_when_its_client_dies(
    ros: Ros, tmp_path: Path, publish: Publish
) -> None:
    server, client, _ = start_pair(ros, tmp_path, "tcp")
    with recorder("/v/speed", Float32) as speeds:
        speeds.connected()

        def is_heard() -> bool:
            publish("/c/speed", Float32(42.0))
            return any(m.data == 42.0 for m in speeds.messages)

        eventually(is_heard, "the command")
        client.popen.kill()
        eventually(lambda: speeds.messages[-1].data == 0.0, "the safe speed")
    assert "'speed' (holding 0) is 0, its safe value: no write for 0.3 s" in server.log


def test_a_client_finds_a_device_that_comes_later_and_again(ros: Ros, tmp_path: Path) -> None:
    line = make_line("tcp", ros, tmp_path)
    client = start_node(ros, "client", write_map(tmp_path, "c.yaml", line, is_device=False), "c")
    device = write_map(tmp_path, "s.yaml", line, is_device=True)
    for count in (1, 2):
        server = start_node(ros, "server", device, "v")
        eventually(lambda n=count: client.log.count("unit 7 answers") == n, "an answer")  # type: ignore[misc]
        server.popen.kill()
        server.popen.wait()
        eventually(lambda n=count: client.log.count("does not answer") == n, "silence")  # type: ignore[misc]


def test_a_topic_of_another_type_is_named(ros: Ros, tmp_path: Path, publish: Publish) -> None:
    server, _, _ = start_pair(ros, tmp_path, "tcp")
    publish("/v/rpm", String("fast"))
    eventually(
        lambda: "/v/rpm: it is of type std_msgs/String, legal: std_msgs/Float64" in server.log,
        "a message about it",
    )


def test_what_is_no_modbus_ends_its_connection_and_is_counted(ros: Ros, tmp_path: Path) -> None:
    server, _, line = start_pair(ros, tmp_path, "tcp")
    with recorder("/diagnostics", DiagnosticArray) as diagnostics:
        diagnostics.connected(publishers=2)
        with socket.create_connection(("127.0.0.1", line.port)) as stranger:
            stranger.sendall(b"GET / HTTP/1.1\r\n\r\n")
            assert stranger.recv(100) == b""
        eventually(lambda: "MBAP protocol 21536, legal: 0" in server.log, "a message")
        eventually(
            lambda: any(
                status.name == "v/plc: no Modbus TCP"
                for array in diagnostics.messages
                for status in array.status
            ),
            "the diagnostics",
        )
        eventually(
            lambda: any(
                status.name == "v/plc: modbus" and status.values[0].value == "1"
                for array in diagnostics.messages
                for status in array.status
            ),
            "the status with one client",
        )


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("scale: 0.01", "scale: 0"), "registers[9].scale: 0, legal: "),
        (("voltage", "voltages"), "has no field 'voltages'; did you mean 'voltage'?"),
        (("BatteryState", "BateryState"), "unknown message type of package sensor_msgs: "),
        (("std_msgs/Float32", "nonsense/Float32"), "no package nonsense"),
        (("address: 3, type", "address: 2, type"), "takes addresses 2 to 3, of which 'volt'"),
    ],
)
def test_a_wrong_map_is_refused_with_file_and_line(
    ros: Ros, tmp_path: Path, change: tuple[str, str], message: str
) -> None:
    path = Path(write_map(tmp_path, "bad.yaml", Line(port=1), is_device=True))
    path.write_text(path.read_text(encoding="utf-8").replace(*change), encoding="utf-8")
    node = ros.launch([program("trident_bridges", "modbus_server_node"), f"_map:={path}"])
    eventually(lambda: node.popen.poll() is not None, "the end of the node")
    assert node.popen.returncode == 1
    assert f"{path}:" in node.log
    assert message in node.log


def test_a_remote_address_must_be_allowed(ros: Ros, tmp_path: Path) -> None:
    path = Path(write_map(tmp_path, "m.yaml", Line(port=1502), is_device=True))
    node = ros.launch(
        [program("trident_bridges", "modbus_server_node"), f"_map:={path}", "_host:=0.0.0.0"]
    )
    eventually(lambda: node.popen.poll() is not None, "the end of the node")
    assert "allow_remote" in node.log
