# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A node that ends for a reason that nobody has foreseen leaves its map."""

from __future__ import annotations

import signal
from pathlib import Path

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Pose2D
from nav_msgs.srv import GetMap
from scan_bag import diagnosed, play, service, start_slam
from slam_toolbox_msgs.srv import DeserializePoseGraph
from trident.testing import Process, Ros, eventually, recorder

SCANS = 30


def mapped(
    ros: Ros, bag: Path, package: str, node: str, *words: str, space: str = "/slam"
) -> Process:
    """A node that has used the scans of the drive; `space`: where its services are."""
    process = start_slam(ros, package, node, *words, name="slam")
    service(f"{space}/dynamic_map", GetMap)
    with recorder("/diagnostics", DiagnosticArray) as seen:
        play(ros, bag, "--rate", "5")
        eventually(lambda: int(diagnosed(seen, "scans used") or 0) > SCANS // 2, "scans")
    return process


@pytest.mark.parametrize("fault", [signal.SIGSEGV, signal.SIGABRT])
def test_a_fault_leaves_the_session_and_the_map(
    ros: Ros, bag: Path, tmp_path: Path, fault: signal.Signals
) -> None:
    kept = tmp_path / "kept.posegraph"
    words = [f"_autosave_file:={kept}", "_autosave_interval:=0.0"]
    process = mapped(ros, bag, "slam_toolbox", "sync_slam_toolbox_node", *words)
    before = service("/slam/dynamic_map", GetMap)().map
    process.send(fault)
    assert process.wait() == -fault, process.log
    rescued = tmp_path / "kept_rescued"
    assert rescued.with_suffix(".pgm").stat().st_size > 1000
    assert not kept.exists(), "what was kept before is not overwritten"

    ros.clean()
    start_slam(ros, "slam_toolbox", "sync_slam_toolbox_node", name="slam")
    service("/slam/deserialize_map", DeserializePoseGraph)(str(rescued), 1, Pose2D())
    after = service("/slam/dynamic_map", GetMap)().map
    assert (after.info.width, after.info.height) == (before.info.width, before.info.height)
    assert after.data == before.data


def test_a_method_without_sessions_leaves_its_map(ros: Ros, bag: Path) -> None:
    words = ["_base_frame:=base_footprint"]
    process = mapped(ros, bag, "hector_mapping", "hector_mapping", *words, space="")
    process.send(signal.SIGSEGV)
    assert process.wait() == -signal.SIGSEGV
    assert (Path(ros.env["ROS_HOME"]) / "slam_rescued.pgm").stat().st_size > 1000
