# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip("rospy", reason="the workspace is not sourced")

import tf2_ros
from scan_bag import write_bag
from trident.testing import Ros
from trident.testing.pytest_plugin import (
    pytest_runtest_makereport,
    ros,
    session_ros,
)

__all__ = ["bag", "pytest_runtest_makereport", "ros", "session_ros", "transforms"]


@pytest.fixture(scope="module")
def bag(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A drive of as many scans as the module's `SCANS` says."""
    path = tmp_path_factory.mktemp("bag") / "drive.bag"
    write_bag(path, request.module.SCANS)
    return path


@pytest.fixture
def transforms(ros: Ros) -> Iterator[tf2_ros.Buffer]:
    """All transforms that are published while the test runs."""
    buffer = tf2_ros.Buffer()
    listener = tf2_ros.TransformListener(buffer)
    yield buffer
    listener.unregister()
