# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""When a planned flight sends, and when it takes the world's time for reset."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

pytest.importorskip("rospy", reason="ROS is not installed")
pytest.importorskip("trident_msgs.srv", reason="trident_msgs is not built or sourced")

from trident_fleet.core.files.formation_file import FormationSource
from trident_fleet.core.schedule import FeedConfig
from trident_fleet.core.settings import FleetSettings, fleet_of_names
from trident_fleet.nodes import flights
from trident_fleet.nodes.flights import FlightContext, formation_flight
from trident_fleet.nodes.setpoint_topic import SetpointTopic
from trident_fleet.nodes.world_link import SimulatorClient

PERIOD_NS = FeedConfig().period_ns
SPAWN = np.array([[0.0, 0.0, 0.1]])
ROWS = np.array([[[0.0, 0.0, 1.0]], [[1.0, 0.0, 1.0]]])


class World:
    """Stands where the simulator would: hands out clocks, and keeps what is sent."""

    is_lockstep = True

    def __init__(self) -> None:
        self.sent: list[bytes] = []
        self.restarts = 0
        self.tick: Callable[[int], None] = lambda now_ns: None
        self.while_connecting: Callable[[], None] = lambda: None

    def close_states(self) -> None: ...

    def enroll(self, end_ns: int = 0) -> int:
        return PERIOD_NS

    def on_clock(self, callback: Callable[[int], None]) -> Any:
        self.tick = callback
        return object()

    def wait_for_publisher(self, subscribers: list[Any]) -> None:
        self.while_connecting()

    def publish(self, message: bytes) -> None:
        self.sent.append(message)

    def restart(self) -> None:
        self.restarts += 1

    def context(self) -> FlightContext:
        vehicles = fleet_of_names(["UAV1"])
        return FlightContext(
            settings=FleetSettings(FormationSource(Path("rows.txt"))),
            vehicles=vehicles,
            fed=vehicles,
            topics=[cast(SetpointTopic, self)],
            link=cast(SimulatorClient, self),
            record=lambda record: None,
            restart=self.restart,
        )


class LateLock:
    """A lock that the thread of the clock gets first, once, as on a loaded machine."""

    def __init__(self, first: Callable[[], None]) -> None:
        self._lock = threading.Lock()
        self._first: Callable[[], None] | None = first

    def __enter__(self) -> None:
        first, self._first = self._first, None
        if first is not None:
            first()
        self._lock.acquire()

    def __exit__(self, *_: object) -> None:
        self._lock.release()


@pytest.fixture
def world() -> World:
    return World()


def flight_in(world: World) -> flights.Flight:
    return formation_flight(ROWS)(world.context(), SPAWN, PERIOD_NS)


def test_a_clock_that_runs_as_the_flight_begins_is_no_reset(
    world: World, monkeypatch: pytest.MonkeyPatch
) -> None:
    def let_time_run() -> None:
        for index in range(10):
            world.tick(index * PERIOD_NS)

    # The first to ask for the lock is the thread that begins the flight.
    late = SimpleNamespace(Lock=lambda: LateLock(let_time_run))
    monkeypatch.setattr(flights, "threading", late)
    flight_in(world).begin()
    assert world.restarts == 0
    assert len(set(world.sent)) == len(world.sent) > 10


def test_time_that_goes_back_by_more_than_a_period_is_a_reset(world: World) -> None:
    flight_in(world).begin()
    world.tick(20 * PERIOD_NS)
    world.tick(19 * PERIOD_NS)
    assert world.restarts == 0, "clocks of one period may overtake each other"
    count = len(world.sent)
    world.tick(19 * PERIOD_NS - 1)
    assert world.restarts == 1
    assert len(world.sent) == count, "nothing of the old flight is sent any more"


def test_clocks_before_the_start_are_no_reset(world: World) -> None:
    flight_in(world).begin()
    world.tick(0)
    world.tick(PERIOD_NS)
    assert world.restarts == 0
