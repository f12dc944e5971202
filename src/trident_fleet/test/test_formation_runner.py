# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A formation runner ends when its node does, whatever it is about to do."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import rospy
from trident_fleet.core.settings import FleetSettings, FormationSource
from trident_fleet.nodes import formation_runner
from trident_fleet.nodes.formation_runner import FormationRunner
from trident_fleet.nodes.world_link import SpawnState

LIMIT_S = 30.0


class Link:
    """A simulator that is there at once, without lockstep."""

    is_lockstep = False

    def __init__(self, *_: Any) -> None:
        self.on_wait: Callable[[], None] = lambda: None

    def wait_for_simulator(self) -> bool:
        self.on_wait()
        return True

    def wait_for_spawn(self) -> SpawnState:
        return SpawnState(0, np.zeros((0, 3)))

    def on_clock(self, callback: Callable[[int], None]) -> Any:
        callback(0)
        return Subscriber()


class Subscriber:
    def unregister(self) -> None:
        pass


class Flight:
    def begin(self) -> list[Any]:
        return []

    def watch(self) -> None:
        pass


def test_a_shutdown_between_two_flights_ends_the_node(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(formation_runner, "SimulatorClient", Link)
    hooks: list[Callable[[], None]] = []
    monkeypatch.setattr(rospy, "on_shutdown", hooks.append)
    settings = FleetSettings(FormationSource("none"))
    runner = FormationRunner(settings, [], [], lambda *_: Flight(), None)  # type: ignore[arg-type]

    def shut_down() -> None:
        # As rospy does: the hooks are called first, is_shutdown() knows of it last.
        monkeypatch.setattr(rospy.core, "is_shutdown_requested", lambda: True)
        for hook in hooks:
            hook()

    link: Any = runner._context.link
    link.on_wait = shut_down
    thread = threading.Thread(target=runner.run, daemon=True)
    thread.start()
    thread.join(LIMIT_S)
    assert not thread.is_alive()
