# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A robot in a room as a .rrd file, recorded without a display and read back."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from harness import REPO, environment

pytest.importorskip("rerun", reason="rerun-sdk is not installed (./trident setup)")

import rerun as rr

SECONDS = 3.0
BASE = "/odom/base_footprint/base_link"
CAMERA = f"{BASE}/camera_link/camera_optical_frame"
ENTITIES = {
    "/world/my_nav_robot": "Translation3D",
    "/world/walls": "Translation3D",
    "/odom/base_footprint": "Translation3D",
    f"{BASE}/laser_link/scan": "Position3D",
    f"{CAMERA}/camera.rgb": "PinholeProjection",
    f"{CAMERA}/camera.rgb/image_raw": "ImageBuffer",
    f"{CAMERA}/camera.depth/image_raw": "ImageBuffer",
    f"{CAMERA}/camera.depth.points": "Position3D",
    "/odom/odom": "LineStrip3D",
    "/world/ground_truth.odom": "LineStrip3D",
}


def rows(recording: Any, entity: str) -> tuple[np.ndarray, Any]:
    """Simulated times [s] and values (an Arrow array) of the entity's component."""
    column = f"{entity}:{ENTITIES[entity]}"
    view = recording.view(index="sim_time", contents=entity).filter_is_not_null(column)
    table = view.select("sim_time", column).read_all()
    times = [time.value * 1e-9 for time in table.column("sim_time")]
    return np.array(times), table.column(column)


def plan_path(recording: Any, entity: str) -> tuple[np.ndarray, np.ndarray]:
    """Simulated times [s], (n,), and x, y [m], (n, 2), of what moves."""
    times, values = rows(recording, entity)
    return times, np.array([value[0][:2] for value in values.to_pylist()])


def test_a_robot_in_a_room_is_recorded(tmp_path: Path) -> None:
    file = tmp_path / "robot.rrd"
    words = ["robot_in_room.launch", "drive:=waypoints", "--rerun", "--out", str(file)]
    command = [str(REPO / "trident"), "view", *words, "--seconds", f"{SECONDS:g}"]
    env = {name: value for name, value in environment().items() if name != "DISPLAY"}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=env)
    assert done.returncode == 0, done.stderr
    assert f"{file}: {SECONDS:.3f} s" in done.stdout
    recording = rr.dataframe.load_recording(str(file))
    for entity in ENTITIES:
        times, values = rows(recording, entity)
        assert len(values) > 0, entity
        assert np.ptp(times) <= SECONDS + 0.5, entity  # what comes may be older
    times, scans = rows(recording, f"{BASE}/laser_link/scan")
    scans = scans.to_pylist()
    assert len(scans) > 10
    np.testing.assert_allclose(np.diff(times), 0.1, atol=2e-3, err_msg="10 Hz")
    reach = [np.linalg.norm(scan, axis=1) for scan in scans]
    assert all(r.min() > 0.5 and r.max() < 12.0 for r in reach), "within the room"
    at, place = plan_path(recording, "/world/my_nav_robot")
    odometry_at, odometry = plan_path(recording, "/odom/base_footprint")
    assert np.ptp(place, axis=0).max() > 0.1, "it has moved"
    both = (odometry_at >= at[0]) & (odometry_at <= at[-1])
    expected = np.column_stack([np.interp(odometry_at[both], at, column) for column in place.T])
    np.testing.assert_allclose(odometry[both], expected, atol=0.05)
    static = recording.view(index="sim_time", contents=f"{BASE}/laser_link").select_static()
    height = static.read_all().to_pydict()[f"{BASE}/laser_link:Translation3D"][0][0][2]
    assert height == pytest.approx(0.06, abs=0.05), "the lidar is on the robot"
