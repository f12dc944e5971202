# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from typing import Any

import pytest

pytest.importorskip("rospy", reason="the workspace is not sourced")

import rospy
from trident.testing import Ros

# Imported, not named in pytest_plugins: that is for the conftest.py of the root folder only.
from trident.testing.pytest_plugin import (
    pytest_runtest_makereport,
    ros,
    session_ros,
)

__all__ = ["pytest_runtest_makereport", "ros", "session_ros"]


@pytest.fixture
def publish(ros: Ros) -> Iterator[Callable[[str, Any], None]]:
    """Publishes a message on a topic, for all who subscribe until the test ends."""
    del ros
    publishers: dict[str, Any] = {}
    with ExitStack() as stack:

        def send(topic: str, message: Any) -> None:
            if topic not in publishers:
                publishers[topic] = rospy.Publisher(topic, type(message), queue_size=10, latch=True)
                stack.callback(publishers[topic].unregister)
            publishers[topic].publish(message)

        yield send
