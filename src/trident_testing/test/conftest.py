# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from trident.testing.pytest_plugin import (
    gazebo,
    launch,
    pytest_runtest_makereport,
    ros,
    session_ros,
    start_gazebo,
)

__all__ = ["gazebo", "launch", "pytest_runtest_makereport", "ros", "session_ros", "start_gazebo"]
