# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""hovering_example, waypoint_publisher and waypoint_publisher_file in a world that runs fast."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from trident.testing import PYTHON, RosProcesses, eventually, output_of, program

HERE = Path(__file__).parent
NAMESPACE = {"ROS_NAMESPACE": "/UAV1"}


class Vehicle(RosProcesses):
    """A master and a stand-in for simulator and controller in /UAV1."""

    def __init__(self, folder: Path) -> None:
        self.log = folder / "events.jsonl"
        super().__init__(folder)
        self.set_param("/use_sim_time", True)

    def start_simulator(self) -> None:
        command = [PYTHON, str(HERE / "fake_vehicle.py"), str(self.log)]
        self.start_node("/UAV1/vehicle", command, env=NAMESPACE)

    def run_example(self, name: str, *arguments: str) -> tuple[int, str]:
        return self.run([program("rotors_gazebo", name), *arguments], env=NAMESPACE)

    def events(self) -> list[dict[str, Any]]:
        text = self.log.read_text() if self.log.exists() else ""
        return [json.loads(line) for line in text.splitlines()]

    def unpause(self) -> None:
        self.start(["rosservice", "call", "/gazebo/unpause_physics"])
        eventually(lambda: bool(self.events()), "the start of the clock")


@pytest.fixture
def ros(tmp_path: Path) -> Iterator[Vehicle]:
    vehicle = Vehicle(tmp_path)
    yield vehicle
    vehicle.close()


def test_hovering_example_unpauses_then_sends_one_point_that_a_late_listener_gets(
    ros: Vehicle,
) -> None:
    example = ros.start(
        [
            program("rotors_gazebo", "hovering_example"),
            *["_x:=1.5", "_z:=2", f"_yaw:={math.pi / 2}"],
        ],
        env=NAMESPACE,
    )
    ros.start_simulator()  # later than the node: it must try again
    output = output_of(example)
    assert example.returncode == 0, output
    eventually(lambda: len(ros.events()) == 2, "arrival of the trajectory")
    unpause, trajectory = ros.events()
    assert unpause == {"event": "unpause"}
    assert trajectory["stamp"] >= 20.0
    half = math.sqrt(0.5)
    assert trajectory["points"] == [[0.0, 1.5, 0.0, 2.0, pytest.approx(half), pytest.approx(half)]]


def test_hovering_example_gives_up_on_a_simulator_that_never_comes(ros: Vehicle) -> None:
    code, output = ros.run_example("hovering_example")
    assert code == 1
    assert "Could not wake up Gazebo." in output


def test_waypoint_publisher_sends_its_argument(ros: Vehicle) -> None:
    ros.start_simulator()
    ros.unpause()
    code, output = ros.run_example("waypoint_publisher", "1", "-2", "3", "-90", "5")
    assert code == 0, output
    eventually(lambda: len(ros.events()) == 2, "arrival of the trajectory")
    (point,) = ros.events()[1]["points"]
    assert point == pytest.approx([0.0, 1.0, -2.0, 3.0, -math.sqrt(0.5), math.sqrt(0.5)])


def test_waypoint_publisher_file_waits_for_the_simulator_then_sends_all_lines(
    ros: Vehicle,
) -> None:
    ros.start_simulator()
    ros.unpause()
    example = HERE.parent / "resource" / "example_waypoints.txt"
    code, output = ros.run_example("waypoint_publisher_file", str(example))
    assert code == 0, output
    eventually(lambda: len(ros.events()) == 2, "arrival of the trajectory")
    trajectory = ros.events()[1]
    assert trajectory["stamp"] >= 30.0
    lines = [line.split() for line in example.read_text().splitlines() if line[:1].strip("#")]
    assert len(trajectory["points"]) == len(lines)
    elapsed_s = 0.0
    for (time_s, *position, _qz, _qw), (wait_s, *expected) in zip(
        trajectory["points"], lines, strict=True
    ):
        elapsed_s += float(wait_s)
        assert time_s == pytest.approx(elapsed_s)
        assert position == pytest.approx([float(value) for value in expected[:3]])


@pytest.mark.parametrize(
    ("program", "arguments", "text"),
    [
        ("waypoint_publisher", ["1", "2"], "Usage: waypoint_publisher"),
        ("waypoint_publisher", ["1", "2", "up", "0"], "z is 'up': it must be a finite number"),
        ("waypoint_publisher", ["1", "2", "3", "0", "-1"], "delay is -1: it must be >= 0 s"),
        ("waypoint_publisher_file", [], "Usage: waypoint_publisher_file"),
        ("waypoint_publisher_file", ["/nowhere"], "file '/nowhere' does not exist"),
    ],
)
def test_bad_arguments_give_one_error_and_exit_code_1(
    ros: Vehicle, program: str, arguments: list[str], text: str
) -> None:
    code, output = ros.run_example(program, *arguments)
    assert code == 1
    assert text in output
