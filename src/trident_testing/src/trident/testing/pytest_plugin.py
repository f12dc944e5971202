# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Fixtures for tests of launch files.

In your conftest.py: `pytest_plugins = ["trident.testing.pytest_plugin"]`
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from trident.testing.gazebo import Gazebo
from trident.testing.launch import Launch
from trident.testing.master import Ros

_SHOWN = 6000  # characters of each log of a failed test


@pytest.fixture(scope="session")
def session_ros(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Ros]:
    """The master of this process."""
    session = Ros(tmp_path_factory.mktemp("ros"))
    yield session
    session.shutdown()


@pytest.fixture
def ros(session_ros: Ros) -> Iterator[Ros]:
    """The master, empty again after each test."""
    yield session_ros
    session_ros.clean()


@pytest.fixture
def launch(ros: Ros) -> Iterator[Callable[..., Launch]]:
    """Starts launch files, see `Launch`; they end with the test, and must end cleanly."""
    with ExitStack() as stack:
        yield lambda *words, **args: stack.enter_context(Launch(ros, *words, **args))


@pytest.fixture
def start_gazebo(ros: Ros) -> Callable[..., Gazebo]:
    """Starts a server without a launch file, see `Gazebo`, and returns when it serves."""

    def start(*args: Any, **options: Any) -> Gazebo:
        return Gazebo(ros, *args, **options).ready()

    return start


@pytest.fixture
def gazebo(start_gazebo: Callable[..., Gazebo], request: pytest.FixtureRequest) -> Gazebo:
    """A paused server on RotorS' basic world; indirect parameters are its options."""
    return start_gazebo(**getattr(request, "param", {}))


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: Any) -> Generator[None, Any, None]:
    """Shows the logs of what a failed test had started."""
    outcome = yield
    report = outcome.get_result()
    session = getattr(item, "funcargs", {}).get("ros")
    if report.when == "call" and report.failed and session is not None:
        for process in session.programs:
            name = Path(process.log_file).name
            report.sections.append((name, process.log[-_SHOWN:]))
