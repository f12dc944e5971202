# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

for module in ("rospy", "gazebo_msgs.srv", "trident_msgs.srv", "mav_msgs.msg"):
    pytest.importorskip(module, reason=f"{module} is not built, or the workspace is not sourced")

# Imported, not named in pytest_plugins: that is for the conftest.py of the root folder only.
from trident.testing.pytest_plugin import (  # noqa: E402
    gazebo,
    launch,
    pytest_runtest_makereport,
    ros,
    session_ros,
    start_gazebo,
)
from trident_runs import Trident  # noqa: E402

__all__ = ["gazebo", "launch", "pytest_runtest_makereport", "ros", "session_ros", "start_gazebo"]


@pytest.fixture(scope="module")
def trident() -> Iterator[Trident]:
    """Calls of ./trident, whose run folders are taken away after the module's tests."""
    caller = Trident()
    yield caller
    caller.clean()
