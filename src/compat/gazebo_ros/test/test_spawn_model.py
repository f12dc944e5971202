# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""spawn_model and gazebo_interface against a node that has the simulator's services."""

from __future__ import annotations

import json
import math
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from trident.testing import LIMIT_S, PYTHON, RosProcesses, eventually, output_of, program

HERE = Path(__file__).parent


class Simulation(RosProcesses):
    """A master, a simulator that only takes notes, and spawners."""

    def __init__(self, folder: Path) -> None:
        self.log = folder / "calls.jsonl"
        super().__init__(folder)

    def start_simulator(self, *models: str) -> None:
        self.start([PYTHON, str(HERE / "fake_simulator.py"), str(self.log), *models])

    def spawn(self, arguments: str, **options: Any) -> tuple[int, str]:
        """Runs spawn_model to its end; returns exit code and output."""
        return self.run([program("gazebo_ros", "spawn_model"), *arguments.split()], **options)

    def start_spawner(self, arguments: str, **options: Any) -> subprocess.Popen[str]:
        """Starts spawn_model and returns once the master knows it."""
        command = [program("gazebo_ros", "spawn_model"), *arguments.split()]
        return self.start_node("/spawner", command, **options)

    def calls(self) -> list[dict[str, Any]]:
        """What the simulator was asked, in order."""
        text = self.log.read_text() if self.log.exists() else ""
        return [json.loads(line) for line in text.splitlines()]


@pytest.fixture
def ros(tmp_path: Path) -> Iterator[Simulation]:
    simulation = Simulation(tmp_path)
    yield simulation
    simulation.close()


def test_spawns_a_parameter_under_the_namespace_of_the_node(ros: Simulation) -> None:
    ros.start_simulator()
    ros.set_param("/UAV1/robot_description", "<robot/>")
    code, output = ros.spawn(
        "-param robot_description -urdf -x 1 -y -2 -z 0.1 -Y 1.5707963267948966 -model firefly"
        " __name:=spawn_firefly",
        env={"ROS_NAMESPACE": "/UAV1"},
    )
    assert code == 0, output
    assert "SpawnModel: Successfully spawned entity" in output
    (call,) = ros.calls()
    half = math.sqrt(0.5)
    assert call["orientation"] == pytest.approx([0.0, 0.0, half, half])
    del call["orientation"]
    assert call == {
        "call": "spawn_urdf",
        "model": "firefly",
        "xml": "<robot/>",
        "namespace": "/UAV1",
        "frame": "",
        "position": [1.0, -2.0, 0.1],
    }


def test_waits_on_the_wall_clock_while_simulated_time_stands_still(ros: Simulation) -> None:
    ros.set_param("/use_sim_time", True)
    process = ros.start_spawner("-stdin -sdf -model box -robot_namespace /r", stdin=subprocess.PIPE)
    assert process.stdin is not None
    process.stdin.write("<sdf/>")
    process.stdin.close()
    ros.start_simulator()
    assert process.wait(LIMIT_S) == 0
    (call,) = ros.calls()
    assert (call["call"], call["xml"], call["namespace"]) == ("spawn_sdf", "<sdf/>", "/r")


def test_sets_joints_then_unpauses(ros: Simulation, tmp_path: Path) -> None:
    ros.start_simulator("table")
    file = tmp_path / "arm.urdf"
    file.write_text('<mesh filename="package://a/b.stl"/>')
    code, output = ros.spawn(
        f"-file {file} -urdf -model arm -J j1 0.5 -J j2 -1 -unpause"
        " -wait table -package_to_model -reference_frame table::top"
    )
    assert code == 0, output
    spawn, configure, unpause = ros.calls()
    assert spawn["xml"] == '<mesh filename="model://a/b.stl"/>'
    assert spawn["frame"] == "table::top"
    assert configure == {
        "call": "configure",
        "model": "arm",
        "names": ["j1", "j2"],
        "positions": [0.5, -1.0],
    }
    assert unpause == {"call": "unpause"}


def test_database_model_is_an_include(ros: Simulation) -> None:
    ros.start_simulator()
    assert ros.spawn("-database coke_can -sdf -model can")[0] == 0
    assert "<uri>model://coke_can</uri>" in ros.calls()[0]["xml"]


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ("-file /nowhere.urdf -urdf -model m", "file '/nowhere.urdf' does not exist"),
        ("-param nothing -urdf -model m", "parameter '/nothing' is not set"),
        ("-stdin -sdf -model m", "no text on standard input"),
        ("-database box -sdf -model bad", "SpawnModel: Failure - entity already exists."),
        ("-urdf -model m", "one of -file, -param, -database, -stdin is needed"),
    ],
)
def test_failures_give_one_line_and_exit_code_1(ros: Simulation, arguments: str, text: str) -> None:
    ros.start_simulator()
    code, output = ros.spawn(arguments, stdin=subprocess.DEVNULL)
    assert code == 1
    assert text in output
    assert len(output.splitlines()) == 1, output


def test_b_stays_and_deletes_the_model_when_it_is_ended(ros: Simulation) -> None:
    ros.start_simulator()
    process = ros.start_spawner("-database box -sdf -model box -b")
    eventually(lambda: len(ros.calls()) == 1, "the spawn")
    assert ros.spawn("-database box -sdf -model other")[0] == 0  # one without -b ends
    assert process.poll() is None
    process.send_signal(signal.SIGINT)
    assert process.wait(LIMIT_S) == 0
    assert ros.calls()[2] == {"call": "delete", "model": "box"}


def test_a_signal_ends_the_wait_for_a_simulator(ros: Simulation) -> None:
    process = ros.start_spawner("-database box -sdf -model box")
    process.send_signal(signal.SIGTERM)
    assert process.wait(5.0) == 1
    assert ros.calls() == []


def test_python_clients_call_the_services(ros: Simulation) -> None:
    ros.start_simulator()
    script = """
import rospy
from geometry_msgs.msg import Pose
from gazebo_ros import gazebo_interface as g
rospy.init_node("client")
print(g.spawn_urdf_model_client("a", "<robot/>", "/ns", Pose(), "f", "/gazebo"))
print(g.spawn_sdf_model_client("bad", "<sdf/>", "", Pose(), "", "/gazebo"))
print(g.set_model_configuration_client("a", "", ["j"], [0.5], "/gazebo"))
"""
    process = ros.start([PYTHON, "-c", script], stderr=sys.stderr)
    output = output_of(process)
    results = [line for line in output.splitlines() if line in ("True", "False")]
    assert results == ["True", "False", "True"]
    assert [call["call"] for call in ros.calls()] == ["spawn_urdf", "spawn_sdf", "configure"]
