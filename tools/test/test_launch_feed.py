# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What roslaunch says of a launch file."""

from __future__ import annotations

from pathlib import Path

import pytest
from trident_tool.launch.launch_feed import lacks_state_publisher, nodes_of
from trident_tool.workspace import TridentError

CALL = ["roslaunch", "--disable-title", "a.launch", "x:=1"]


@pytest.fixture
def env(tmp_path: Path) -> dict[str, str]:
    """With a roslaunch that describes one robot."""
    program = tmp_path / "roslaunch"
    program.write_text(
        """#!/bin/sh
[ "$2 $3" = "a.launch x:=1" ] || { echo "unused args [$3]" >&2; exit 1; }
case $1 in
  --nodes) printf 'a warning\\n/gazebo\\n/UAV1/spawn\\n';;
  --dump-params) printf "/gazebo/seed: 0\\n/robot_description: '<robot/>'\\n";;
esac
""",
        encoding="utf-8",
    )
    program.chmod(0o755)
    return {"PATH": f"{tmp_path}:/usr/bin:/bin"}


def test_nodes_are_those_that_roslaunch_names(
    env: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", env["PATH"])
    assert nodes_of(CALL, env) == ["/gazebo", "/UAV1/spawn"]
    with pytest.raises(TridentError, match=r"roslaunch --nodes a.launch y:=2: unused args"):
        nodes_of(["roslaunch", "a.launch", "y:=2"], env)


def test_a_described_robot_needs_somebody_who_places_its_links(
    env: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", env["PATH"])
    assert lacks_state_publisher(CALL, ["/gazebo"], env)
    assert not lacks_state_publisher(CALL, ["/gazebo", "/r/robot_state_publisher"], env)
