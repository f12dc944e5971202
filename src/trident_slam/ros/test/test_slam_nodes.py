# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The nodes under their upstream names, fed from a bag."""

from __future__ import annotations

import math
import subprocess
from pathlib import Path

import numpy as np
import pytest
import rospy
import tf2_ros
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Pose2D, PoseWithCovarianceStamped
from nav_msgs.msg import OccupancyGrid
from scan_bag import SCAN_PERIOD_S, diagnosed, path, play, service, start_slam, write_bag
from slam_toolbox_msgs.srv import (
    DeserializePoseGraph,
    LoopClosure,
    Pause,
    Reset,
    SaveMap,
    SerializePoseGraph,
    ToggleInteractive,
)
from std_msgs.msg import String
from trident.testing import LIMIT_S, Ros, eventually, program, recorder

SCANS = 60


@pytest.fixture(scope="module")
def imu_bag(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("imu_bag") / "drive.bag"
    write_bag(path, SCANS, imu_s=math.inf)
    return path


def offline(
    bag: Path, out: Path, *more: str, method: str = "graph_slam_2d"
) -> subprocess.CompletedProcess[str]:
    words = [program("trident_slam", "slam_offline_bag"), str(bag), "--method", method, *more]
    return subprocess.run([*words, "--out", str(out)], capture_output=True, text=True, check=False)


def test_a_replayed_bag_gives_the_map_of_the_offline_runner(
    ros: Ros, imu_bag: Path, tmp_path: Path
) -> None:
    done = offline(imu_bag, tmp_path / "offline", "--imu", "/imu")
    assert done.returncode == 0, done.stderr
    node = start_slam(
        ros, "slam_toolbox", "sync_slam_toolbox_node", "_imu_topic:=/imu", name="slam_toolbox"
    )
    save = service("/slam_toolbox/save_map", SaveMap)
    with (
        recorder("/diagnostics", DiagnosticArray) as seen,
        recorder("/map", OccupancyGrid) as maps,
    ):
        play(ros, imu_bag, "--rate", "5")
        eventually(lambda: diagnosed(seen, "scans used") == str(SCANS), "all scans")
        save(String(str(tmp_path / "live")))
        live = (tmp_path / "live.pgm").read_bytes()
        assert live == (tmp_path / "offline" / "map.pgm").read_bytes()
        assert len(np.unique(np.frombuffer(live, np.uint8))) >= 3
        eventually(lambda: bool(maps.messages), "a map")
        assert maps.messages[0].header.frame_id == "map"
        assert diagnosed(seen, "scans left out") == "0"
        assert diagnosed(seen, "scans without gyro") == "0"
    session = str(tmp_path / "session")
    service("/slam_toolbox/serialize_map", SerializePoseGraph)(session)
    load = service("/slam_toolbox/deserialize_map", DeserializePoseGraph)
    load(session, 1, Pose2D())
    save(String(str(tmp_path / "again")))
    # Saving closes loops once more, so that a few cells may be others.
    pixels = [
        np.frombuffer(data, np.uint8) for data in (live, (tmp_path / "again.pgm").read_bytes())
    ]
    assert pixels[0].shape == pixels[1].shape
    assert np.mean(pixels[0] == pixels[1]) > 0.98
    Path(session + ".posegraph").write_bytes(b"damaged")
    with pytest.raises(rospy.ServiceException):
        load(session, 2, Pose2D())
    assert node.running, node.log


def test_a_config_file_takes_nothing_from_a_node(ros: Ros, bag: Path, tmp_path: Path) -> None:
    config, autosave = tmp_path / "graph.yaml", tmp_path / "autosave.posegraph"
    config.write_text("mode: mapping\nresolution: 0.1\n")
    words = [f"_config_file:={config}", f"_autosave_file:={autosave}", "_autosave_interval:=0.5"]
    node = start_slam(ros, "slam_toolbox", "sync_slam_toolbox_node", *words, name="slam_toolbox")
    place = rospy.Publisher("/initialpose", PoseWithCovarianceStamped, queue_size=1)
    with (
        recorder("/diagnostics", DiagnosticArray) as seen,
        recorder("/map", OccupancyGrid) as maps,
    ):
        play(ros, bag, "--rate", "5")
        eventually(lambda: diagnosed(seen, "scans used") == str(SCANS), "all scans")
        eventually(lambda: bool(maps.messages), "a map")
    assert maps.messages[0].info.resolution == pytest.approx(0.1)
    assert autosave.exists()
    session = str(tmp_path / "session")
    service("/slam_toolbox/serialize_map", SerializePoseGraph)(session)
    service("/slam_toolbox/deserialize_map", DeserializePoseGraph)(session, 2, Pose2D(x=0.1))
    service("/slam_toolbox/toggle_interactive_mode", ToggleInteractive)()
    service("/slam_toolbox/manual_loop_closure", LoopClosure)()
    far = PoseWithCovarianceStamped()
    far.pose.pose.position.x, far.pose.pose.orientation.w = 5000.0, 1.0
    eventually(lambda: place.get_num_connections() == 1, "the node")
    place.publish(far)
    # A pose that no map can continue from is refused by the map, not by the method.
    node.eventually_logs("initialpose: pose (5000, 0) m, 0 rad is ")
    node.stop()
    # What kind of node it is decides, not the file.
    start_slam(
        ros,
        "slam_toolbox",
        "localization_slam_toolbox_node",
        f"_config_file:={config}",
        f"_map_file_name:={session}",
        name="localization",
    )
    with pytest.raises(rospy.ServiceException, match="not while localizing"):
        service("/localization/toggle_interactive_mode", ToggleInteractive)()


def test_an_imu_puts_sweeps_right(imu_bag: Path, tmp_path: Path) -> None:
    poses = {}
    for name, more in {"with": ("--imu", "/imu"), "without": ()}.items():
        done = offline(imu_bag, tmp_path / name, *more)
        assert done.returncode == 0, done.stderr
        assert "gyro" not in done.stderr
        poses[name] = np.loadtxt(tmp_path / name / "trajectory.tum")
    truth = path(0.02 + SCAN_PERIOD_S * np.arange(SCANS))
    cos, sin = math.cos(truth[0, 2]), math.sin(truth[0, 2])
    start = (truth[:, :2] - truth[0, :2]) @ np.array([[cos, -sin], [sin, cos]])
    assert np.abs(poses["with"][:, 1:3] - start).max() < 0.05
    assert not np.array_equal(poses["with"], poses["without"])


def test_odometry_is_not_needed(imu_bag: Path, tmp_path: Path) -> None:
    truth = path(0.02 + SCAN_PERIOD_S * np.arange(SCANS))
    cos, sin = math.cos(truth[0, 2]), math.sin(truth[0, 2])
    start = (truth[:, :2] - truth[0, :2]) @ np.array([[cos, -sin], [sin, cos]])
    done = offline(imu_bag, tmp_path / "none", "--odom-frame", "")
    assert done.returncode == 0, done.stderr
    poses = np.loadtxt(tmp_path / "none" / "trajectory.tum")
    assert np.abs(poses[:, 1:3] - start).max() < 0.08
    refused = offline(imu_bag, tmp_path / "refused", "--no-odometry", method="odometry")
    assert refused.returncode == 1
    assert "--no-odometry: odometry needs odometry; legal: graph_slam_2d" in refused.stderr


def test_an_imu_that_ends_is_reported_and_mapping_continues(tmp_path: Path) -> None:
    short = tmp_path / "short.bag"
    write_bag(short, 40, imu_s=2.0)
    done = offline(short, tmp_path / "out", "--imu", "/imu")
    assert done.returncode == 0, done.stderr
    assert len((tmp_path / "out" / "trajectory.tum").read_text().splitlines()) == 40
    assert "has no gyro: the newest rate is" in done.stderr
    assert "left out" not in done.stderr
    unknown = offline(short, tmp_path / "unknown", "--imu", "/imu2")
    assert unknown.returncode == 1
    assert "no topic /imu2 of sensor_msgs/Imu; there are: /imu" in unknown.stderr


def test_the_services_of_slam_toolbox(ros: Ros, bag: Path, transforms: tf2_ros.Buffer) -> None:
    start_slam(ros, "slam_toolbox", "async_slam_toolbox_node", name="slam_toolbox")
    pause = service("/slam_toolbox/pause_new_measurements", Pause)
    with recorder("/diagnostics", DiagnosticArray) as seen:
        play(ros, bag, "--duration", "2")
        eventually(lambda: int(diagnosed(seen, "scans used") or 0) > 5, "scans")
        eventually(lambda: transforms.can_transform("map", "odom", rospy.Time()), "map -> odom")
        shift = transforms.lookup_transform("map", "odom", rospy.Time()).transform.translation
        assert abs(shift.x) < 0.1
        assert abs(shift.y) < 0.1
        assert pause().status
        eventually(lambda: "paused" in str(seen.messages[-1].status), "the pause")
        assert service("/slam_toolbox/reset", Reset)(False).result == 0
        # The bag begins again, two seconds before its last scan.
        play(ros, bag, "--duration", "1")
        eventually(lambda: "time went back by" in diagnosed(seen, "last problem"), "the bag loop")


def test_a_late_transform_is_named(ros: Ros, tmp_path: Path) -> None:
    late = tmp_path / "late.bag"
    write_bag(late, 30, tf_delay_s=0.5)
    node = start_slam(ros, "gmapping", "slam_gmapping", "_base_frame:=base_footprint")
    rospy.wait_for_service("/dynamic_map", LIMIT_S)
    with recorder("/diagnostics", DiagnosticArray) as seen:
        play(ros, late)
        eventually(lambda: int(diagnosed(seen, "scans left out") or 0) > 10, "what was late")
        assert "transform odom -> base_footprint is" in diagnosed(seen, "last problem")
    node.eventually_logs("is left out: transform odom -> base_footprint is")


@pytest.mark.parametrize(
    ("parameter", "error"),
    [
        ("_resolution:=-1.0", "resolution"),
        ("_throttle_scans:=0", "throttle_scans: 0 is out of range; must be a whole number in [1,"),
        ("_bag_loop:=never", "must be one of ignore, restart, continue, but is the text 'never'"),
        ("_method:=karto", "unknown SLAM method 'karto'"),
        ("_solver_plugin:=solver_plugins::SpaSolver", "unknown solver 'solver_plugins::SpaSolver'"),
        # The node ends while its services are still advertised.
        ("_map_file_name:=/no/such/session", "/no/such/session.posegraph"),
    ],
)
def test_a_bad_parameter_is_one_line(ros: Ros, parameter: str, error: str) -> None:
    node = ros.launch([program("slam_toolbox", "async_slam_toolbox_node"), parameter])
    assert node.wait() == 1
    assert error in node.log


def test_a_request_that_fails_says_why(ros: Ros) -> None:
    words = ["__name:=slam_toolbox", "_method:=odometry"]
    node = ros.launch([program("slam_toolbox", "sync_slam_toolbox_node"), *words])
    serialize = service("/slam_toolbox/serialize_map", SerializePoseGraph)
    with pytest.raises(rospy.ServiceException, match="this method cannot keep sessions"):
        serialize("session")
    node.eventually_logs("this method cannot keep sessions")
