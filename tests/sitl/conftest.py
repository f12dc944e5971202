# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Stand-ins for PX4 and ArduPilot, and worlds that they fly in, in this process."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from trident_base.ports import free_port

import trident_sim

REPOSITORY = Path(__file__).resolve().parents[2]
STAND_INS = REPOSITORY / "src" / "trident_bridges" / "test_support"
MODEL = REPOSITORY / "src" / "trident_description" / "sdf" / "sitl_iris.sdf.xacro"

StartStandIn = Callable[..., subprocess.Popen[bytes]]


def make_world(autopilot: str, count: int = 1) -> tuple[trident_sim.World, list[int]]:
    """A world with `count` irises, 2 m apart, and the ports of their autopilots."""
    world = trident_sim.World(REPOSITORY / "worlds" / f"{autopilot}.world", seed=7, timing="direct")
    ports = [free_port() for _ in range(count)]
    for i, port in enumerate(ports):
        sdf = trident_sim.expand_xacro(MODEL, autopilot=autopilot, port=port)
        world.spawn(f"iris{i}", sdf=sdf, pose=(2.0 * i, 0.0, 0.06))
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
