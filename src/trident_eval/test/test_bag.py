# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import NAMES, START_S, Run
from trident_eval.__main__ import main

rosbag = pytest.importorskip("rosbag")
rospy = pytest.importorskip("rospy")

from geometry_msgs.msg import PoseStamped, Transform, Vector3  # noqa: E402
from nav_msgs.msg import Odometry  # noqa: E402
from trajectory_msgs.msg import (  # noqa: E402
    MultiDOFJointTrajectory,
    MultiDOFJointTrajectoryPoint,
)
from trident_eval.bag import read_bag  # noqa: E402


def odometry(stamp: float, point: np.ndarray) -> Odometry:
    message = Odometry()
    message.header.stamp = rospy.Time.from_sec(stamp)
    position = message.pose.pose.position
    position.x, position.y, position.z = point
    return message


def trajectory(stamp: float, points: list[tuple[float, np.ndarray]]) -> MultiDOFJointTrajectory:
    message = MultiDOFJointTrajectory()
    message.header.stamp = rospy.Time.from_sec(stamp)
    for after, place in points:
        point = MultiDOFJointTrajectoryPoint(transforms=[Transform(translation=Vector3(*place))])
        point.time_from_start = rospy.Duration.from_sec(after)
        message.points.append(point)
    return message


def pose(stamp: float, point: np.ndarray) -> PoseStamped:
    message = PoseStamped()
    message.header.stamp = rospy.Time.from_sec(stamp)
    message.pose.position.x, message.pose.position.y, message.pose.position.z = point
    return message


@pytest.fixture
def bag(tmp_path: Path) -> Path:
    """Two vehicles, 2 s; one is commanded by trajectories, one by poses."""
    path = tmp_path / "run.bag"
    with rosbag.Bag(str(path), "w") as out:
        for step in range(41):
            now = 1.0 + 0.05 * step
            at = rospy.Time.from_sec(now)
            for index, name in enumerate(NAMES[:2]):
                where = np.array([0.1 * step, 2.0 * index, 1.0])
                out.write(f"/{name}/odometry_sensor1/odometry", odometry(now, where), at)
        for second in range(3):
            at = rospy.Time.from_sec(1.0 + second)
            first = [(0.1 * k, np.array([second + 0.1 * k, 0.0, 1.0])) for k in range(20)]
            out.write("/UAV1/command/trajectory", trajectory(1.0 + second, first), at)
            out.write("/UAV2/command/pose", pose(1.5 + second, np.array([second, 2.0, 1.0])), at)
        out.write("/UAV1/imu", odometry(1.0, np.zeros(3)), rospy.Time.from_sec(1.0))
    return path


def test_odometry_and_the_command_of_each_instant_are_read(bag: Path) -> None:
    scene = read_bag(bag)
    assert scene.tracks.names == ["UAV1", "UAV2"]
    assert len(scene.tracks.time) == 41
    np.testing.assert_allclose(scene.tracks.position[10], [[1.0, 0, 1], [1.0, 2, 1]], atol=1e-9)
    assert scene.commanded is not None
    at = {
        round(t, 2): command for t, command in zip(scene.tracks.time, scene.commanded, strict=True)
    }
    assert at[1.55][0, 0] == pytest.approx(0.5)
    # The second message replaces the rest of the first one.
    assert at[2.05][0, 0] == pytest.approx(1.0)
    assert np.isnan(at[1.45][1]).all()
    np.testing.assert_allclose(at[2.45][1], [0.0, 2.0, 1.0])
    np.testing.assert_allclose(at[2.5][1], [1.0, 2.0, 1.0])


def test_a_bag_can_be_drawn(bag: Path) -> None:
    assert main(["report", str(bag)]) == 0
    folder = bag.parent / "run_report"
    assert (folder / "paths.png").stat().st_size > 10_000
    assert (folder / "report.html").exists()


def test_sensor_odometry_goes_before_ground_truth(tmp_path: Path) -> None:
    path = tmp_path / "both.bag"
    with rosbag.Bag(str(path), "w") as out:
        for source, x in (("ground_truth", 1.0), ("odometry_sensor1", 2.0)):
            for now in (1.0, 2.0):
                message = odometry(now, np.array([x, 0.0, 1.0]))
                out.write(f"/UAV1/{source}/odometry", message, rospy.Time.from_sec(now))
    assert (read_bag(path).tracks.position[:, 0, 0] == 2.0).all()


@pytest.mark.parametrize("content", [None, b"", b"not a bag at all", bytes(range(128, 256))])
def test_what_is_no_bag_is_refused(
    tmp_path: Path, content: bytes | None, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "x.bag"
    if content is not None:
        path.write_bytes(content)
    assert main(["report", str(path)]) == 2
    assert "legal: a readable, closed rosbag" in capsys.readouterr().err


def test_a_bag_without_odometry_names_its_topics(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "imu.bag"
    with rosbag.Bag(str(path), "w") as out:
        out.write("/UAV1/imu", odometry(1.0, np.zeros(3)), rospy.Time.from_sec(1.0))
    assert main(["report", str(path)]) == 2
    assert "no odometry; topics: /UAV1/imu" in capsys.readouterr().err


def test_what_the_recorder_dropped_is_a_gap_and_no_flight(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "gap.bag"
    with rosbag.Bag(str(path), "w") as out:
        for step in range(41):
            now = 1.0 + 0.05 * step
            for name in NAMES[:2]:
                if name == "UAV2" and 10 < step < 30:
                    continue
                message = odometry(now, np.array([0.05 * step, 0.0, 1.0]))
                out.write(f"/{name}/ground_truth/odometry", message, rospy.Time.from_sec(now))
    position = read_bag(path).tracks.position
    assert np.isfinite(position[:, 0]).all()
    assert np.isfinite(position[[10, 30], 1]).all()
    assert np.isnan(position[11:30, 1]).all()
    assert "1.0 s of the odometry of UAV2 are missing" in capsys.readouterr().err


def test_the_simulators_states_stand_in_for_dropped_odometry(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    fleet_state = pytest.importorskip("trident_msgs.msg").FleetState
    path = tmp_path / "fleet.bag"
    with rosbag.Bag(str(path), "w") as out:
        for step in range(21):
            now = 1.0 + 0.1 * step
            state = fleet_state(name=["UAV1", "box"])
            state.header.stamp = rospy.Time.from_sec(now)
            for x in (0.1 * step, 9.0):
                state.pose.append(pose(now, np.array([x, 0.0, 1.0])).pose)
            out.write("/gazebo/fleet_state", state, rospy.Time.from_sec(now))
            if step < 5 or step > 15:
                message = odometry(now + 0.01, np.array([0.1 * step, 0.0, 1.0]))
                out.write("/UAV1/odometry_sensor1/odometry", message, rospy.Time.from_sec(now))
    tracks = read_bag(path).tracks
    assert tracks.names == ["UAV1"]
    np.testing.assert_allclose(tracks.position[:, 0, 0], tracks.time - 1.0, atol=1e-9)
    assert capsys.readouterr().err == ""


def test_a_bag_of_a_run_gives_the_numbers_of_the_run(planned_run: Run, tmp_path: Path) -> None:
    path = tmp_path / "flight.bag"
    with rosbag.Bag(str(path), "w") as out:
        for now, points in zip(planned_run.time + START_S, planned_run.position, strict=True):
            for name, point in zip(NAMES, points, strict=True):
                at = rospy.Time.from_sec(now)
                out.write(f"/{name}/odometry_sensor1/odometry", odometry(now, point), at)
    separation = read_bag(path).separation()
    assert separation is not None
    i, j = np.triu_indices(3, k=1)
    apart = np.linalg.norm(planned_run.position[:, i] - planned_run.position[:, j], axis=-1)
    np.testing.assert_allclose(separation, apart.min(axis=1), atol=1e-9)
