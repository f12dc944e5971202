# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The controller nodes as processes: answers, parameters, signals, restarts of the simulator."""

from __future__ import annotations

import signal
import socket
import struct
import subprocess
import time
import xmlrpc.client
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml
from trident.testing import RosProcesses, eventually, program

RESOURCE = Path(__file__).resolve().parents[2] / "rotors_gazebo" / "resource"
LEE = "lee_position_controller_node"
ATTITUDE = "roll_pitch_yawrate_thrust_controller_node"
CLEAN_END_S = 1.0
NAMESPACE = {"ROS_NAMESPACE": "/UAV1"}
ROTOR = {
    "angle": 0.0,
    "arm_length": 0.2,
    "rotor_force_constant": 8e-6,
    "rotor_moment_constant": 0.016,
    "direction": 1,
}


@pytest.fixture
def ros(tmp_path: Path) -> Iterator[RosProcesses]:
    processes = RosProcesses(tmp_path)
    yield processes
    processes.close()


def firefly_parameters(gains: str = "lee_controller_firefly.yaml") -> dict[str, Any]:
    """Gains and vehicle as the launch files load them."""
    merged: dict[str, Any] = {}
    for name in (gains, "firefly.yaml"):
        merged.update(yaml.safe_load((RESOURCE / name).read_text()))
    return merged


def start_controller(
    ros: RosProcesses, name: str = LEE, parameters: dict[str, Any] | None = None
) -> subprocess.Popen[str]:
    ros.set_param(f"/UAV1/{name}", parameters or firefly_parameters())
    return ros.start_node(f"/UAV1/{name}", [program("rotors_control", name)], env=NAMESPACE)


def end(process: subprocess.Popen[str], how: signal.Signals) -> float:
    """Sends a signal; returns the wall time until the process has ended [s]."""
    begin = time.monotonic()
    process.send_signal(how)
    process.wait(10.0)
    return time.monotonic() - begin


def test_answers_equal_the_core_over_two_lives_of_the_simulator(ros: RosProcesses) -> None:
    ros.set_param("/use_sim_time", True)
    controller = start_controller(ros)
    check = program("rotors_control", "lee_node_check")
    for _ in range(2):
        code, output = ros.run([check], env=NAMESPACE)
        assert code == 0, output
        assert "6 tests ran" in output.replace("from 1 test suite ", "")
    assert controller.poll() is None


def test_does_not_listen_to_the_clock(ros: RosProcesses) -> None:
    ros.set_param("/use_sim_time", True)
    start_controller(ros)

    def subscribed() -> list[str]:
        _, _, (_publishers, subscribers, _services) = ros.master.getSystemState("/test")
        return [topic for topic, _ in subscribers]

    eventually(lambda: "/UAV1/odometry" in subscribed(), "the subscription of the odometry")
    assert "/clock" not in subscribed()


@pytest.mark.parametrize("vehicle", ["firefly", "hummingbird", "iris"])
@pytest.mark.parametrize(
    ("name", "prefix"),
    [(LEE, "lee_controller"), (ATTITUDE, "roll_pitch_yawrate_thrust_controller")],
)
def test_every_shipped_parameter_file_is_complete(
    ros: RosProcesses, name: str, prefix: str, vehicle: str
) -> None:
    parameters = firefly_parameters(f"{prefix}_{vehicle}.yaml")
    parameters.update(yaml.safe_load((RESOURCE / f"{vehicle}.yaml").read_text()))
    process = start_controller(ros, name, parameters)
    eventually(lambda: "odometry" in str(ros.master.getSystemState("/test")), "its subscriptions")
    end(process, signal.SIGTERM)
    assert process.stdout is not None
    assert process.stdout.read() == ""


class RawSubscriber:
    """Connects to a topic of a node and reads only on request."""

    def __init__(self, ros: RosProcesses, node: str, topic: str, md5: str) -> None:
        def is_advertised() -> bool:
            _, _, (publishers, _subscribers, _services) = ros.master.getSystemState("/test")
            return [topic, [node]] in publishers

        # A node is known, and offers any topic, before it has advertised it.
        eventually(is_advertised, f"{topic} of {node}")
        slave = xmlrpc.client.ServerProxy(ros.master.lookupNode("/test", node)[2])
        reply: Any = slave.requestTopic("/raw", topic, [["TCPROS"]])
        _, host, port = reply[2]
        self._socket = socket.socket()
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        self._socket.connect((host, port))
        fields = [f"topic={topic}", "callerid=/raw", f"md5sum={md5}", "type=mav_msgs/Actuators"]
        header = b"".join(struct.pack("<I", len(field)) + field.encode() for field in fields)
        self._socket.sendall(struct.pack("<I", len(header)) + header)
        self._socket.settimeout(1.0)
        answer = self.frame()  # the publisher's half of the handshake
        assert b"error=" not in answer, answer

    def frame(self) -> bytes:
        """The next length-prefixed block; empty when none comes."""
        prefix = self._read(4)
        return self._read(struct.unpack("<I", prefix)[0]) if prefix else b""

    def _read(self, count: int) -> bytes:
        data = b""
        while len(data) < count:
            try:
                part = self._socket.recv(count - len(data))
                assert part, f"the node has closed the stream, {len(data)} of {count} bytes read"
                data += part
            except TimeoutError:
                assert not data, "the stream ends inside a message"
                return b""
        return data


def test_a_subscriber_that_does_not_read_delays_nobody_and_gets_whole_messages_later(
    ros: RosProcesses,
) -> None:
    controller = start_controller(ros)
    stalled = RawSubscriber(
        ros, f"/UAV1/{LEE}", "/UAV1/command/motor_speed", "25741daf38ed25442e3a66a855ee8d9c"
    )
    bench = program("trident_control", "controller_round_trip")
    code, output = ros.run([bench, "4", f"/UAV1={controller.pid}"])
    assert code == 0, output
    sequence = -1
    gaps = 0
    while frame := stalled.frame():
        (number,) = struct.unpack_from("<I", frame)
        assert len(frame) == 24 + 6 * 8 + 4  # header, angles, six speeds, normalized
        assert struct.unpack_from("<I", frame, 20) == (6,)
        assert number > sequence
        gaps += number != sequence + 1
        sequence = number
    assert sequence > 0
    if not gaps:
        pytest.skip(f"the sockets' buffers took all {sequence} messages; this machine is too slow")


@pytest.mark.parametrize("name", [LEE, ATTITUDE])
@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGINT])
def test_signals_end_it_within_a_second(ros: RosProcesses, name: str, how: signal.Signals) -> None:
    gains = "roll_pitch_yawrate_thrust_controller_firefly.yaml" if name == ATTITUDE else None
    parameters = firefly_parameters(gains) if gains else firefly_parameters()
    process = start_controller(ros, name, parameters)
    assert end(process, how) < CLEAN_END_S
    assert process.returncode == 0
    assert ros.master.lookupNode("/test", f"/UAV1/{name}")[0] == -1  # it said goodbye


def test_signal_ends_it_within_a_second_though_the_master_is_gone(ros: RosProcesses) -> None:
    process = start_controller(ros)
    ros.master_process.kill()
    ros.master_process.wait()
    assert end(process, signal.SIGTERM) < CLEAN_END_S
    assert process.returncode == 0


def test_signal_ends_it_within_a_second_though_the_master_hangs(ros: RosProcesses) -> None:
    process = start_controller(ros)
    ros.master_process.send_signal(signal.SIGSTOP)
    try:
        assert end(process, signal.SIGTERM) < CLEAN_END_S
    finally:
        ros.master_process.send_signal(signal.SIGCONT)


def test_signal_ends_it_while_it_waits_for_a_master(ros: RosProcesses) -> None:
    process = ros.start(
        [program("rotors_control", LEE)], env={"ROS_MASTER_URI": "http://127.0.0.1:9"}
    )
    assert process.stdout is not None
    assert "Failed to contact master" in process.stdout.readline()
    assert end(process, signal.SIGTERM) < CLEAN_END_S


def test_rosnode_kill_ends_it(ros: RosProcesses) -> None:
    process = start_controller(ros)
    ros.run(["rosnode", "kill", f"/UAV1/{LEE}"])
    eventually(lambda: process.poll() is not None, "the end of the node")
    assert process.returncode == 0


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"mass": -1.0}, f"/UAV1/{LEE}/mass: -1 is out of range; must be a number > 0 kg"),
        ({"mass": "heavy"}, f"/UAV1/{LEE}/mass: must be a number > 0 kg, but is the text"),
        ({"mass": float("nan")}, f"/UAV1/{LEE}/mass: nan is out of range"),
        ({"inertia": {"xx": 0.0}}, "'inertia' is [xx 0,"),
        (
            {"position_gain": {"x": 1, "y": -2, "z": 3}},
            f"/UAV1/{LEE}/position_gain/y: -2 is out of range",
        ),
        (
            {"position_gain": {"x": True}},
            f"/UAV1/{LEE}/position_gain/x: must be a number >= 0, but is true",
        ),
        ({"rotor_configuration": {"0": {"angle": 0.0}}}, "0/arm_length: missing required key"),
        ({"rotor_configuration": {"1": ROTOR}}, "0, 1, 2 ... without a gap"),
        ({"rotor_configuration": [1, 2]}, "rotor_configuration: must be a map"),
        ({"omit_gyroscopic_term": "yes"}, "must be true or false, but is the text 'yes'"),
    ],
)
def test_bad_parameters_give_one_error_and_exit_code_1(
    ros: RosProcesses, change: dict[str, Any], text: str
) -> None:
    ros.set_param(f"/UAV1/{LEE}", {**firefly_parameters(), **change})
    code, output = ros.run([program("rotors_control", LEE)], env=NAMESPACE)
    assert code == 1, output
    assert text in output
    assert len([line for line in output.splitlines() if "FATAL" in line]) == 1


def test_absent_and_unknown_parameters_are_named(ros: RosProcesses) -> None:
    parameters = {**firefly_parameters(), "postion_gain": {"x": 1}}
    del parameters["position_gain"]
    process = start_controller(ros, LEE, parameters)
    assert process.stdout is not None
    lines = [process.stdout.readline() for _ in range(4)]
    for axis, line in zip("xyz", lines, strict=False):
        assert f"/UAV1/{LEE}/position_gain/{axis} is not set, using 6" in line
    assert "postion_gain is unknown, not used; did you mean position_gain?" in lines[3]
