# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What only the system tests need in addition to trident.testing, and its names in one place."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Mapping
from pathlib import Path

from trident.testing import (
    LIMIT_S,
    SERVICES,
    Gazebo,
    Launch,
    Pilot,
    Process,
    Recorder,
    Ros,
    box_sdf,
    eventually,
    logged_problems,
    package,
    pilot_of,
    pose,
    program,
    recorder,
    vehicle_urdf,
)

__all__ = [
    "LIMIT_S",
    "REPO",
    "SERVICES",
    "Gazebo",
    "Launch",
    "Pilot",
    "Process",
    "Recorder",
    "Ros",
    "box_sdf",
    "environment",
    "eventually",
    "fresh_folder",
    "logged_problems",
    "package",
    "pilot_of",
    "pose",
    "program",
    "recorder",
    "topic_rate",
    "vehicle_urdf",
]

REPO = Path(__file__).resolve().parents[2]


def fresh_folder(path: Path) -> str:
    """Makes the folder, empty."""
    shutil.rmtree(path, ignore_errors=True)
    path.mkdir(parents=True)
    return str(path)


def environment(**changes: str) -> Mapping[str, str]:
    """The environment of the tests with changes."""
    return {**os.environ, **changes}


def topic_rate(ros: Ros, topic: str) -> float:
    """What ``rostopic hz`` says of a topic, in messages per wall second."""
    process = ros.launch(["rostopic", "hz", "--wall-time", topic])
    pattern = re.compile(r"average rate: ([0-9.]+)")
    eventually(lambda: len(pattern.findall(process.log)) >= 2, f"a rate of {topic}")
    process.stop()
    return float(pattern.findall(process.log)[-1])
