# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from trident_benchmarks.slam import live
from trident_benchmarks.slam.live_drive import (
    BEAMS,
    RANGE_MAX,
    Drive,
    cast,
    corridors,
    poses,
    samples,
    walls,
    write_log,
)
from trident_benchmarks.slam.live_waits import waits

SMALL = Drive(blocks=1, step=0.5)
WAIT = {"count": 1, "median_ms": 1.0, "p99_ms": 2.0, "max_ms": 99.0}


def test_beams_hit_the_nearest_wall_that_faces_them() -> None:
    room = np.array([[2.0, -3.0], [2.0, 3.0]])[::-1]  # free space to its right: at smaller x
    away = np.array([1.0, 0.0])
    ranges = cast(np.array([room, room + away, room[::-1] - away]), np.zeros(3))
    assert ranges[BEAMS // 2] == pytest.approx(2.0)
    assert ranges[BEAMS // 2 + 45] == pytest.approx(2.0 * math.sqrt(2.0), rel=1e-5)
    assert np.isinf(ranges[0])


def test_the_drive_goes_along_all_corridors_without_jumps() -> None:
    drive = Drive(blocks=2)
    path = poses(drive)
    distances = np.linalg.norm(np.diff(path[:, :2], axis=0), axis=1)
    assert distances.max() < 1.01 * drive.step
    assert distances.sum() == pytest.approx(4 * corridors(drive)[-1].sum(), rel=0.01)
    assert np.abs(np.remainder(np.diff(path[:, 2]) + math.pi, 2 * math.pi) - math.pi).max() < 0.13
    for place in path[::40]:  # never in a wall
        assert cast(walls(drive), place).min() > 0.9


def test_odometry_drifts_and_scans_repeat() -> None:
    again = [one.ranges for one in islice(samples(SMALL), 5)]
    whole = list(samples(SMALL))
    assert np.array_equal(again, [one.ranges for one in whole[:5]])
    off = np.linalg.norm(whole[-1].odometry[:2] - whole[-1].truth[:2])
    assert 0.1 < off < 10.0


def test_a_log_holds_a_line_per_scan(tmp_path: Path) -> None:
    log = tmp_path / "drive.log"
    assert write_log(SMALL, log) == len(poses(SMALL))
    words = log.read_text().splitlines()[3].split()
    assert words[0] == "ROBOTLASER1"
    assert int(words[8]) == BEAMS
    assert max(map(float, words[9 : 9 + BEAMS])) <= RANGE_MAX


def test_a_scan_that_was_replaced_waits_for_the_newer_one() -> None:
    odometry = np.array([1.0, 2.0, 0.5])
    sent = [(10, 1.0, odometry), (20, 1.05, odometry), (30, 1.10, odometry)]
    poses_by_stamp = {10: np.array([1.0, 2.0, 0.5]), 30: np.array([1.1, 2.0, 0.5])}
    same, moved = np.zeros(3), np.array([0.1, 0.0, 0.0])
    heard = [(0.9, moved), (0.95, same), (1.01, same), (1.12, moved), (1.14, moved)]
    assert waits(sent, poses_by_stamp, heard) == pytest.approx([0.01, 0.07, 0.02])
    assert waits(sent, poses_by_stamp, heard[:3]) == pytest.approx([0.01, math.inf, math.inf])


def test_the_verdict_is_about_the_longest_wait_of_both() -> None:
    core = {"wait": WAIT, "map_snapshot": WAIT, "map": WAIT, "session_snapshot": WAIT}
    core |= {"session": WAIT, "nodes": 5000, "realigned": 3, "loops_after": 9, "last_error_m": 0.1}
    core |= {"rss_idle_mb": 50.0, "rss_live_mb": 90.0}
    row = {"core": core, "node": {**WAIT, "node_rss_mb": 70.0}}
    assert live.is_satisfied(row)
    assert "| scan to map -> odom, over ROS | 1 | 1.0 | 2.0 | 99.0 |" in live.table(row)
    row["node"]["max_ms"] = 101.0
    assert not live.is_satisfied(row)
