# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

pytest.importorskip("rospy", reason="the workspace is not sourced")

# Imported, not named in pytest_plugins: that is for the conftest.py of the root folder only.
from trident.testing.pytest_plugin import (
    pytest_runtest_makereport,
    ros,
    session_ros,
)

__all__ = ["pytest_runtest_makereport", "ros", "session_ros"]
