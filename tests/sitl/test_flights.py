# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""An outside autopilot takes the iris off, holds it at 3 m and lands it, in lockstep."""

from __future__ import annotations

import os
import signal
import threading
from pathlib import Path

import numpy as np
import pytest
from conftest import StartStandIn, make_world
from trident.testing import eventually

import trident_sim

AUTOPILOTS = ["px4", "ardupilot"]
LANDED_S = 17.0
WAITS = 300  # each of 1 ms: no step takes so long


def waits_of(thread: threading.Thread) -> int:
    """How often it has given its processor up, to wait for something."""
    status = Path(f"/proc/self/task/{thread.native_id}/status").read_text(encoding="ascii")
    return int(status.split("\nvoluntary_ctxt_switches:")[1].split()[0])


def step_until_it_is_continued(world: trident_sim.World, pid: int, end_s: float) -> None:
    """Steps, which must wait for a stopped process, and continues that once they do."""
    flight = threading.Thread(target=world.step_until, args=(end_s,))
    flight.start()
    before = waits_of(flight)
    eventually(lambda: waits_of(flight) > before + WAITS, "the world waits")
    os.kill(pid, signal.SIGCONT)
    flight.join()


def height(world: trident_sim.World, name: str = "iris0") -> float:
    """Of the model's frame [m]."""
    return float(world.model(name).position[2])


@pytest.mark.parametrize("autopilot", AUTOPILOTS)
def test_iris_takes_off_holds_3_m_and_lands(autopilot: str, start: StartStandIn) -> None:
    world, ports = make_world(autopilot)
    start(autopilot, ports[0])
    ground = height(world)
    world.step_until(7.0)
    held = []
    while world.time < 9.8:
        world.step(10)
        held.append(world.model("iris0").position)
    offset = np.array(held) - np.array([0.0, 0.0, ground + 3.0])
    assert np.abs(offset[:, 2]).max() < 0.5
    assert np.abs(offset[:, :2]).max() < 1.0
    world.step_until(LANDED_S)
    assert height(world) == pytest.approx(ground, abs=0.05)
    assert np.linalg.norm(world.model("iris0").linear_velocity) < 0.02


@pytest.mark.parametrize("autopilot", AUTOPILOTS)
def test_a_flight_is_equal_to_the_bit_though_its_autopilot_was_stopped(
    autopilot: str, start: StartStandIn
) -> None:
    hashes = set()
    for is_stopped in (False, True):
        world, ports = make_world(autopilot)
        process = start(autopilot, ports[0])
        world.step_until(2.5)
        if is_stopped:
            process.send_signal(signal.SIGSTOP)
            os.waitpid(process.pid, os.WUNTRACED)  # it has stopped
            step_until_it_is_continued(world, process.pid, 4.0)
        world.step_until(4.0)
        hashes.add(world.state_hash())
        assert height(world) > 0.5
    assert len(hashes) == 1


@pytest.mark.parametrize("autopilot", AUTOPILOTS)
def test_six_fly_at_once_and_equal_to_the_bit(autopilot: str, start: StartStandIn) -> None:
    hashes = set()
    for _ in range(2):
        world, ports = make_world(autopilot, count=6)
        for port in ports:
            start(autopilot, port)
        world.step_until(4.0)
        assert all(height(world, f"iris{i}") > 1.0 for i in range(6))
        hashes.add(world.state_hash())
    assert len(hashes) == 1


def test_one_that_is_started_again_flies(start: StartStandIn) -> None:
    world, ports = make_world("px4")
    first = start("px4", ports[0])
    world.step_until(1.0)
    os.kill(first.pid, signal.SIGKILL)
    first.wait()
    ground = height(world)
    start("px4", ports[0])
    world.step_until(6.0)
    assert height(world) > ground + 1.0


def test_a_control_that_is_no_number_is_one_message_and_the_flight_continues(
    start: StartStandIn,
) -> None:
    world, ports = make_world("px4")
    start("px4", ports[0], "--nan-at", "900")
    with pytest.warns(trident_sim.SimulationWarning, match="'rotor0' is nan, legal: finite"):
        world.step_until(5.0)
    assert height(world) > 2.0
    assert sum("nan" in message.text for message in world.messages) == 1


def test_one_that_boots_is_given_time_until_its_first_answer(start: StartStandIn) -> None:
    world, ports = make_world("px4")
    start("px4", ports[0], "--silent", "50")
    world.step_until(0.4)
    assert world.time == pytest.approx(0.4)
