# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What the package promises in addition to physics: no ROS, types and documentation that fit."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from conftest import WORLD

import trident_sim

PACKAGE = Path(trident_sim.__file__).resolve().parent


@pytest.mark.parametrize("python", ["/usr/bin/python3", sys.executable])
def test_no_ros_is_imported(python: str) -> None:
    code = f"""
import sys, trident_sim
world = trident_sim.World({WORLD!r})
world.step(10)
ros = [name for name in sys.modules if name.partition(".")[0] in
       ("rospy", "roslib", "rosgraph", "rospkg", "genpy", "roslaunch", "xacro")]
print(world.step_count, ros)
"""
    result = subprocess.run([python, "-c", code], capture_output=True, text=True, check=True)
    assert result.stdout == "10 []\n"


def test_public_names_are_documented_and_say_where_they_belong() -> None:
    for name in trident_sim.__all__:
        item = getattr(trident_sim, name)
        assert item.__doc__, name
        assert item.__module__.partition(".")[0] == "trident_sim", name


def test_typed() -> None:
    assert (PACKAGE / "py.typed").is_file()
