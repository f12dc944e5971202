# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack

import pytest

pytest.importorskip("rospy", reason="the workspace is not sourced")

from boat import Boat, Client
from trident.testing import Ros

# Imported, not named in pytest_plugins: that is for the conftest.py of the root folder only.
from trident.testing.pytest_plugin import (
    pytest_runtest_makereport,
    ros,
    session_ros,
)

__all__ = ["pytest_runtest_makereport", "ros", "session_ros"]


@pytest.fixture
def boat() -> Iterator[Boat]:
    result = Boat()
    yield result
    result.close()


@pytest.fixture
def client(ros: Ros) -> Iterator[Callable[[int], Client]]:
    """Connects clients, which are closed with the test."""
    with ExitStack() as stack:

        def connect(port: int) -> Client:
            result = Client(port)
            stack.callback(result.close)
            return result

        yield connect
