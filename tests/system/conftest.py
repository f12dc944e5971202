# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import sys
from collections.abc import Callable, Generator, Iterator
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parent))

for module in ("rospy", "gazebo_msgs.srv", "trident_msgs.srv", "mav_msgs.msg"):
    pytest.importorskip(module, reason=f"{module} is not built, or the workspace is not sourced")

from harness import Gazebo, Ros  # noqa: E402

_SHOWN = 6000  # characters of each log of a failed test


@pytest.fixture(scope="session")
def session_ros(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Ros]:
    session = Ros(tmp_path_factory.mktemp("ros"))
    yield session
    session.shutdown()


@pytest.fixture
def ros(session_ros: Ros) -> Iterator[Ros]:
    """The master, empty again after each test."""
    yield session_ros
    session_ros.clean()


@pytest.fixture
def start_gazebo(ros: Ros) -> Callable[..., Gazebo]:
    """Starts a server and returns when it serves."""

    def start(*args: Any, **options: Any) -> Gazebo:
        return Gazebo(ros, *args, **options).ready()

    return start


@pytest.fixture
def gazebo(start_gazebo: Callable[..., Gazebo], request: pytest.FixtureRequest) -> Gazebo:
    """A paused server on the basic world; indirect parameters are its options."""
    return start_gazebo(**getattr(request, "param", {}))


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: Any) -> Generator[None, Any, None]:
    """Shows the logs of what a failed test had started."""
    outcome = yield
    report = outcome.get_result()
    session = getattr(item, "funcargs", {}).get("ros")
    if report.when == "call" and report.failed and session is not None:
        for process in session.programs:
            report.sections.append((process.log_file.name, process.log[-_SHOWN:]))
