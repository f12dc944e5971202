# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What is wrong with scans, bags and sessions: each counted, and no harm to the map."""

from __future__ import annotations

import json
import math
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import rosbag
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Pose2D, PoseWithCovarianceStamped
from nav_msgs.msg import OccupancyGrid
from nav_msgs.srv import GetMap
from scan_bag import diagnosed, play, service, start_slam
from sensor_msgs.msg import LaserScan
from slam_toolbox_msgs.srv import DeserializePoseGraph, SerializePoseGraph
from trident.testing import Ros, eventually, program, recorder

SCANS = 40

#: What is done to every tenth scan.
HARM: list[Callable[[LaserScan], None]] = [
    lambda scan: setattr(scan, "ranges", [math.nan] * len(scan.ranges)),
    lambda scan: setattr(scan, "ranges", [math.inf] * len(scan.ranges)),
    lambda scan: setattr(scan, "ranges", [0.0] * len(scan.ranges)),
    lambda scan: setattr(scan, "ranges", scan.ranges[:90]),
]


def harmed(good: Path, bad: Path) -> None:
    """A copy of a bag in which some scans are bad ones."""
    scans = 0
    with rosbag.Bag(str(good)) as source, rosbag.Bag(str(bad), "w") as sink:
        for topic, message, stamp in source.read_messages():
            if topic == "/scan":
                scans += 1
                if scans % 10 == 5:
                    message.ranges = list(message.ranges)
                    HARM[scans // 10](message)
            sink.write(topic, message, stamp)


def shared_walls(a: OccupancyGrid, b: OccupancyGrid) -> float:
    """The part of a's walls that is also a wall of b, within a cell."""

    def walls(grid: OccupancyGrid) -> np.ndarray:
        cells = np.array(grid.data, np.int8).reshape(grid.info.height, grid.info.width)
        rows, columns = np.nonzero(cells == 100)
        origin = grid.info.origin.position
        places = np.column_stack([columns, rows]) + 0.5
        return places * grid.info.resolution + np.array([origin.x, origin.y])

    ours, theirs = walls(a), walls(b)
    nearest = np.array([np.abs(theirs - place).max(axis=1).min() for place in ours])
    return float(np.mean(nearest < 1.5 * a.info.resolution))


def test_bad_scans_are_counted_and_do_no_harm(ros: Ros, bag: Path, tmp_path: Path) -> None:
    bad = tmp_path / "bad.bag"
    harmed(bag, bad)
    node = start_slam(
        ros, "slam_toolbox", "sync_slam_toolbox_node", "_bag_loop:=restart", name="slam_toolbox"
    )
    whole = service("/slam_toolbox/dynamic_map", GetMap)
    with recorder("/diagnostics", DiagnosticArray) as seen:
        play(ros, bag, "--rate", "5")
        eventually(lambda: diagnosed(seen, "scans used") == str(SCANS), "all scans")
        assert diagnosed(seen, "problems") == "0"
        expected = whole().map
        # Time goes back: the map begins again, as the parameter says.
        play(ros, bad, "--rate", "5")
        eventually(lambda: diagnosed(seen, "scans used") == str(2 * SCANS), "all scans")
        eventually(lambda: diagnosed(seen, "problems") == str(1 + len(HARM)), "the problems")
        found = whole().map
        assert shared_walls(found, expected) > 0.9
        assert shared_walls(expected, found) > 0.9
        node.eventually_logs("time went back by")
        assert "90 beams from" in diagnosed(seen, "last problem")

        session = str(tmp_path / "session")
        service("/slam_toolbox/serialize_map", SerializePoseGraph)(session)
        Path(session + ".posegraph").write_bytes(Path(session + ".posegraph").read_bytes()[:-100])
        with pytest.raises(rospy.ServiceException):
            service("/slam_toolbox/deserialize_map", DeserializePoseGraph)(session, 1, Pose2D())
        eventually(lambda: diagnosed(seen, "problems") == str(2 + len(HARM)), "the damaged file")
        assert "session.posegraph" in diagnosed(seen, "last problem")
        assert whole().map.data == found.data

        place = rospy.Publisher("/initialpose", PoseWithCovarianceStamped, queue_size=1)
        eventually(lambda: place.get_num_connections() == 1, "the node")
        place.publish(PoseWithCovarianceStamped())  # a quaternion of length 0
        eventually(lambda: "quaternion of length 0" in diagnosed(seen, "last problem"), "the pose")
    # Each kind of problem once, not each scan.
    assert node.log.count("0 of 180 beams have a return") == 1
    assert node.log.count("90 beams from") == 1


def offline(log: Path, out: Path, *more: str) -> subprocess.CompletedProcess[str]:
    name = "slam_offline_bag" if log.suffix == ".bag" else "slam_offline"
    words = [
        program("trident_slam", name),
        str(log),
        "--method",
        "graph_slam_2d",
        "--out",
        str(out),
        *more,
    ]
    return subprocess.run(words, capture_output=True, text=True, check=False)


def scans_of(out: Path) -> int:
    return len((out / "trajectory.tum").read_text("utf-8").splitlines())


def test_a_truncated_bag_is_read_as_far_as_it_is_whole(bag: Path, tmp_path: Path) -> None:
    cut, out = tmp_path / "cut.bag", tmp_path / "out"
    assert offline(bag, out).returncode == 0
    whole = scans_of(out)
    size = bag.stat().st_size * 2 // 3
    cut.write_bytes(bag.read_bytes()[:size])
    done = offline(cut, out)
    assert done.returncode == 0, done.stderr
    assert f"warning: {cut}: damaged at offset {size}: the file ends within a chunk" in done.stderr
    assert 0.5 * whole < scans_of(out) < 0.8 * whole


def test_a_bag_of_which_nothing_is_left_is_one_error(bag: Path, tmp_path: Path) -> None:
    cut = tmp_path / "cut.bag"
    for size in (4500, 20, 0):
        cut.write_bytes(bag.read_bytes()[:size])
        done = offline(cut, tmp_path / "out")
        assert done.returncode == 1
        assert str(cut) in done.stderr
        assert len(done.stderr.strip().splitlines()) == 1, done.stderr
    assert not (tmp_path / "out" / "map.pgm").exists()


def rewritten(good: Path, new: Path, topics: dict[str, list[str]]) -> Path:
    """A copy of a bag whose topics got other names: none, one or several each."""
    with rosbag.Bag(str(good)) as source, rosbag.Bag(str(new), "w") as sink:
        for topic, message, stamp in source.read_messages():
            for name in topics.get(topic, [topic]):
                sink.write(name, message, stamp)
    return new


def test_a_bag_without_odometry_is_mapped_as_no_odometry_asks(bag: Path, tmp_path: Path) -> None:
    bare = rewritten(bag, tmp_path / "bare.bag", {"/tf": []})
    done = offline(bare, tmp_path / "found")
    assert done.returncode == 0, done.stderr
    assert "neither odom -> base_footprint in /tf nor a topic of nav_msgs/Odometry" in done.stderr
    assert "poses come from the scans alone, as with --no-odometry" in done.stderr
    assert "stood still" not in done.stderr
    timing = json.loads((tmp_path / "found" / "timing.json").read_text("utf-8"))
    assert timing["odometry_calibration"] == {}
    assert offline(bare, tmp_path / "asked", "--no-odometry").returncode == 0
    texts = [(tmp_path / out / "trajectory.tum").read_text("utf-8") for out in ("found", "asked")]
    assert texts[0] == texts[1]


def test_the_topics_that_were_chosen_are_printed(bag: Path, tmp_path: Path) -> None:
    two = rewritten(bag, tmp_path / "two.bag", {"/scan": ["/scan", "/scan_2"]})
    done = offline(two, tmp_path / "out")
    assert "scans: /scan; odometry: odom -> base_footprint in /tf\n" in done.stderr
    done = offline(two, tmp_path / "out", "--scan", "/scan_2", "--no-odometry")
    assert "scans: /scan_2\n" in done.stderr
    named = rewritten(bag, tmp_path / "named.bag", {"/scan": ["/front", "/rear"]})
    done = offline(named, tmp_path / "out")
    assert done.returncode == 1
    assert "several topics of sensor_msgs/LaserScan: /front, /rear" in done.stderr


@pytest.mark.parametrize("name", ["slam_offline", "slam_offline_bag"])
def test_help_names_the_program(name: str) -> None:
    words = [program("trident_slam", name), "--help"]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    assert done.stdout.startswith(f"usage: {name} FILE --method NAME")


def test_a_recording_that_was_not_ended_is_read(bag: Path, tmp_path: Path) -> None:
    unfinished, out = tmp_path / "drive.bag", tmp_path / "out"
    recording = rosbag.Bag(str(unfinished), "w")
    with rosbag.Bag(str(bag)) as source:
        for topic, message, stamp in source.read_messages():
            recording.write(topic, message, stamp)
    recording.flush()
    data = unfinished.read_bytes()
    recording.close()
    unfinished.write_bytes(data)
    done = offline(unfinished, out)
    assert done.returncode == 0, done.stderr
    whole = tmp_path / "whole"
    assert offline(bag, whole).returncode == 0
    assert scans_of(out) > 0.9 * scans_of(whole)


@pytest.mark.parametrize("compression", ["none", "bz2", "lz4"])
def test_a_damaged_bag_crashes_nothing_and_says_where(
    bag: Path, tmp_path: Path, compression: str
) -> None:
    packed, bad = tmp_path / "packed.bag", tmp_path / "bad.bag"
    with (
        rosbag.Bag(str(bag)) as source,
        rosbag.Bag(str(packed), "w", compression=compression, chunk_threshold=50_000) as target,
    ):
        for topic, message, stamp in source.read_messages():
            target.write(topic, message, stamp)
    good = packed.read_bytes()
    random = np.random.default_rng(7)
    for _ in range(6):
        data = bytearray(good)
        for place in random.integers(13, len(data), 40):
            data[place] = int(random.integers(0, 256))
        bad.write_bytes(bytes(data))
        done = offline(bad, tmp_path / "out")
        assert done.returncode in (0, 1), f"{done.returncode}: {done.stderr}"
        assert "offset" in done.stderr or "scan" in done.stderr


def test_a_bag_without_scans_is_one_error(tmp_path: Path) -> None:
    empty = tmp_path / "empty.bag"
    rosbag.Bag(str(empty), "w").close()
    done = offline(empty, tmp_path / "out")
    assert done.returncode == 1
    assert "has no topic of sensor_msgs/LaserScan" in done.stderr


def test_a_truncated_log_gives_the_map_of_what_is_there(tmp_path: Path) -> None:
    line = "FLASER 5 1.0 2.0 3.0 2.0 1.0 {x} 0 0 {x} 0 0 {t} host {t}\n"
    whole = "".join(line.format(x=0.1 * i, t=i) for i in range(6))
    log = tmp_path / "cut.log"
    log.write_text(whole[:-40])
    done = offline(log, tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert f"{log}:6" in done.stderr
    assert len((tmp_path / "out" / "trajectory.tum").read_text().splitlines()) == 5
