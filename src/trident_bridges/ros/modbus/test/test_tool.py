# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""modbus_tool: check, print, watch."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from plc import Line, make_line, start_node, write_map
from trident.testing import Ros, package, program

OTTER = package("trident_bringup") / "config/bridges/otter_plc.yaml"


def tool(*words: object) -> tuple[int, str]:
    """Exit code and output of the tool."""
    command = [program("trident_bridges", "modbus_tool"), *map(str, words)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    return done.returncode, done.stdout + done.stderr


def test_maps_that_ship_have_no_errors() -> None:
    maps = sorted(OTTER.parent.glob("*plc*.yaml"))
    assert OTTER in maps
    code, output = tool("check", *maps)
    assert code == 0, output
    assert output.count("no errors") == len(maps)


def test_all_errors_of_a_map_are_printed_with_their_lines(tmp_path: Path) -> None:
    path = tmp_path / "m.yaml"
    path.write_text(
        "registers:\n"
        "  - {name: a, table: input, address: 0, type: int32, scale: 0}\n"
        "  - {name: b, table: input, address: 9, words: up}\n"
        "  - {name: c, table: input, address: 5, type: int32}\n"
        "  - {name: d, table: input, address: 6}\n",
        encoding="utf-8",
    )
    code, output = tool("check", path)
    assert code == 1
    lines = output.splitlines()
    assert [line.split(": ")[0] for line in lines] == [f"{path}:{n}" for n in (2, 3, 5)]


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ("message: std_msgs/Flot64", "did you mean 'Float64'?"),
        ("message: sensor_msgs/BatteryState, field: voltag", "did you mean 'voltage'?"),
        ("message: no_msgs/No", "no package no_msgs"),
        ("count: 3, message: geometry_msgs/Point, field: x", "is no array, count is 3"),
    ],
)
def test_unknown_types_and_fields_are_found(tmp_path: Path, fields: str, message: str) -> None:
    path = tmp_path / "m.yaml"
    path.write_text(
        f"registers:\n  - {{name: a, table: input, address: 0, topic: x, {fields}}}\n",
        encoding="utf-8",
    )
    code, output = tool("check", path)
    assert code == 1
    assert output.startswith(f"{path}:2: registers.a.")
    assert message in output


def test_a_map_is_printed_by_table_and_address() -> None:
    code, output = tool("print", OTTER)
    assert code == 0
    lines = [line.split() for line in output.splitlines()]
    assert ["coil", "0", "lights"] in [line[:3] for line in lines]
    assert lines[-1][-2:] == ["4", "requests"]


@pytest.mark.parametrize("transport", ["tcp", "rtu"])
def test_a_devices_values_are_watched(ros: Ros, tmp_path: Path, transport: str) -> None:
    line = make_line(transport, ros, tmp_path)
    start_node(ros, "server", write_map(tmp_path, "s.yaml", line, is_device=True), "v")
    where = f"127.0.0.1:{line.port}" if line.port else line.client
    device = Line(line.port, line.device, line.client)
    map_file = write_map(tmp_path, "c.yaml", device, is_device=False)
    code, output = tool("watch", where, map_file, "--once", "--seconds", "50")
    line.close()
    assert code == 0, output
    assert "unit 7 answers" in output
    assert "model = 'otter'" in output
    assert "door = 1" in output


@pytest.mark.parametrize("words", [(), ("test", OTTER), ("watch", "here"), ("print",)])
def test_a_wrong_command_line_is_refused(words: tuple[object, ...]) -> None:
    code, output = tool(*words)
    assert code == 1
    assert output.startswith("modbus: ")
