# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Stand-ins for PX4 and ArduPilot, and worlds that they fly in, in this process."""

from __future__ import annotations

import socket
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import trident_sim

REPOSITORY = Path(__file__).resolve().parents[2]
STAND_INS = REPOSITORY / "src" / "trident_bridges" / "test_support"
MODEL = REPOSITORY / "src" / "trident_description" / "sdf" / "sitl_iris.sdf.xacro"

StartStandIn = Callable[..., subprocess.Popen[bytes]]


def free_port(kind: socket.SocketKind) -> int:
    """A port of loopback that nobody has at present."""
    with socket.socket(socket.AF_INET, kind) as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


def iris(autopilot: str, port: int) -> str:
    """SDF of an iris whose autopilot is at `port`."""
    text = trident_sim.expand_xacro(MODEL, autopilot=autopilot)
    own = "<mavlink_tcp_port>4560<" if autopilot == "px4" else "<fdm_port_in>9002<"
    assert own in text
    return text.replace(own, own.split(">")[0] + f">{port}<")


def make_world(autopilot: str, count: int = 1) -> tuple[trident_sim.World, list[int]]:
    """A world with `count` irises, 2 m apart, and the ports of their autopilots."""
    world = trident_sim.World(REPOSITORY / "worlds" / f"{autopilot}.world", seed=7, timing="direct")
    kind = socket.SOCK_STREAM if autopilot == "px4" else socket.SOCK_DGRAM
    ports = []
    for i in range(count):
        ports.append(free_port(kind))
        world.spawn(f"iris{i}", sdf=iris(autopilot, ports[-1]), pose=(2.0 * i, 0.0, 0.06))
    return world, ports


@pytest.fixture
def start() -> Iterator[StartStandIn]:
    """Starts stand-ins by autopilot, port and further options; they end with the test."""
    running: list[subprocess.Popen[bytes]] = []

    def start_one(autopilot: str, port: int, *options: str) -> subprocess.Popen[bytes]:
        program = STAND_INS / f"{autopilot}_stand_in.py"
        command = [sys.executable, str(program), "--port", str(port), *options]
        running.append(subprocess.Popen(command))
        return running[-1]

    yield start_one
    for process in running:
        process.kill()
        process.wait()
