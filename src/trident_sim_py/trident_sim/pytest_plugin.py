# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The fixtures `world` and `make_world` for tests of your own.

In your conftest.py: `pytest_plugins = ["trident_sim.pytest_plugin"]`
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from typing import Any

import pytest

from trident_sim.world import World

DEFAULT_WORLD = "package://rotors_gazebo/worlds/basic.world"
_WORLDS = pytest.StashKey[list[World]]()
_MARKER = (
    "world(world, *, seed, timing, folders, plugins): what the fixture `world` loads, as the"
    " arguments of trident_sim.World; default: RotorS' basic.world, a ground plane"
)


def pytest_configure(config: pytest.Config) -> None:
    """Make the marker known."""
    config.addinivalue_line("markers", _MARKER)


@pytest.fixture
def make_world(request: pytest.FixtureRequest) -> Callable[..., World]:
    """Makes worlds, with the arguments of `trident_sim.World`, for tests that need several."""
    worlds = request.node.stash.setdefault(_WORLDS, [])

    def make(world: Any = DEFAULT_WORLD, **options: Any) -> World:
        options.setdefault("strict", True)  # what is odd in a file fails a test
        worlds.append(World(world, **options))
        return worlds[-1]

    return make


@pytest.fixture
def world(request: pytest.FixtureRequest, make_world: Callable[..., World]) -> World:
    """A world of the test's own, at time zero; `@pytest.mark.world(...)` says which."""
    marker = request.node.get_closest_marker("world")
    return make_world(*marker.args, **marker.kwargs) if marker else make_world()


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, Any, None]:
    """Shows how the worlds of a failed test were left."""
    outcome = yield
    report = outcome.get_result()
    if report.when == "call" and report.failed:
        for world in item.stash.get(_WORLDS, []):
            report.sections.append((f"world '{world.name}'", describe(world)))


def describe(world: World) -> str:
    """Time, hash, moving models and messages of a world, a line each."""
    lines = [f"{world.time:g} s, {world.step_count} steps, seed {world.seed}"]
    for name, model in world.models.items():
        if not model.is_static:
            x, y, z = model.position
            vx, vy, vz = model.linear_velocity
            lines.append(
                f"{name}: at ({x:.4f}, {y:.4f}, {z:.4f}) m, ({vx:.4f}, {vy:.4f}, {vz:.4f}) m/s"
            )
    lines += [f"{one.time:g} s {one.severity}: {one.text}" for one in world.messages]
    return "\n".join([*lines, f"state hash {world.state_hash()}"])
