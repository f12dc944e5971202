# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Messages as entities: where, when, what; and back from a file."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from trident_eval.core.errors import EvalError

pytest.importorskip("rerun", reason="rerun-sdk is not installed (./trident setup)")
pytest.importorskip("rospy", reason="ROS is not installed")

import rerun as rr
import rospy
from gazebo_msgs.msg import ModelStates
from geometry_msgs.msg import (
    Point,
    Pose,
    PoseStamped,
    Quaternion,
    Transform,
    TransformStamped,
    Vector3,
)
from nav_msgs.msg import OccupancyGrid, Odometry
from nav_msgs.msg import Path as PathMessage
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import CameraInfo, Image, LaserScan
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage
from trident_viewer.to_rerun import __main__ as node
from trident_viewer.to_rerun import archetypes
from trident_viewer.to_rerun.converter import Converter, Item
from trident_viewer.to_rerun.frames import FrameTree
from trident_viewer.to_rerun.recorder import Recorder
from trident_viewer.to_rerun.trail import Trail

from trident_msgs.msg import BoundingBox, BoundingBoxes

QUARTER = Quaternion(0, 0, math.sqrt(0.5), math.sqrt(0.5))


@pytest.fixture(autouse=True)
def strict() -> Any:
    """What rerun does not take is an error, not a warning."""
    rr.set_strict_mode(True)
    yield
    rr.set_strict_mode(False)


def header(frame: str, stamp_s: float = 0.0) -> Header:
    return Header(frame_id=frame, stamp=rospy.Time.from_sec(stamp_s))


def transform(parent: str, child: str, stamp_s: float = 0.0, x: float = 0.0) -> TFMessage:
    stamped = TransformStamped(header(parent, stamp_s), child, Transform(Vector3(x, 0, 0), QUARTER))
    return TFMessage([stamped])


def tf(converter: Converter, now_s: float, *message: Any) -> list[Item]:
    return converter.items("/tf", "tf2_msgs/TFMessage", transform(*message), now_s)


def settled() -> Converter:
    """Of a robot with a lidar, 1 s after its frames were published."""
    converter = Converter()
    static = transform("base", "lidar", 0.0, 0.5)
    converter.items("/tf_static", "tf2_msgs/TFMessage", static, 1.0)
    tf(converter, 1.0, "odom", "base", 0.9)
    tf(converter, 2.0, "odom", "base", 1.9)
    return converter


def scan(frame: str, stamp_s: float) -> LaserScan:
    return LaserScan(header(frame, stamp_s), 0, 0, 0.1, 0, 0, 0.1, 9.0, [1.0, 2.0, math.nan], [])


def test_a_frame_is_below_its_parent_whatever_comes_first() -> None:
    tree = FrameTree()
    assert tree.path("/lidar") == ("lidar",)
    assert tree.add("base", "lidar", 1.0)
    assert tree.add("odom", "/base", 2.0)
    assert tree.changed_s == 2.0
    assert not tree.add("odom", "base", 3.0)
    assert tree.changed_s == 2.0
    assert tree.path("lidar") == ("odom", "base", "lidar")
    tree.add("lidar", "odom", 4.0)
    assert len(tree.path("lidar")) == 3, "a circle is cut"


def test_transforms_wait_until_the_frames_are_known() -> None:
    converter = Converter()
    static = transform("base", "lidar", 0.0, 0.5)
    assert not converter.items("/tf_static", "tf2_msgs/TFMessage", static, 1.0)
    assert not tf(converter, 1.1, "odom", "base", 1.05)
    assert converter.has_to_wait("sensor_msgs/LaserScan", 1.2)
    assert not converter.has_to_wait("gazebo_msgs/ModelStates", 1.2), "in no frame"
    items = tf(converter, 1.5, "odom", "base", 1.45)
    assert not converter.has_to_wait("sensor_msgs/LaserScan", 1.5)
    found = {item.path: item.stamp_s for item in items}
    assert found[("odom", "base", "lidar")] is None, "static"
    stamps = [item.stamp_s for item in items if item.path == ("odom", "base")]
    assert stamps == pytest.approx([1.05, 1.45]), "also the one that came before"
    assert found[("odom",)] is None, "the up direction"


def test_a_tree_that_gets_another_root_is_shown_again_below_it() -> None:
    converter = settled()
    tf(converter, 3.0, "map", "odom", 2.9)
    items = tf(converter, 3.5, "map", "odom", 3.4)
    assert ("map", "odom", "base", "lidar") in {item.path for item in items}
    items = converter.items("/scan", "sensor_msgs/LaserScan", scan("lidar", 3.6), 3.7)
    assert [item.path for item in items] == [("map", "odom", "base", "lidar", "scan")]


def test_data_are_where_and_when_they_were_measured() -> None:
    items = settled().items("/front/scan", "sensor_msgs/LaserScan", scan("lidar", 2.25), 2.5)
    assert [(item.path, item.stamp_s) for item in items] == [
        (("odom", "base", "lidar", "front.scan"), 2.25)
    ]
    assert len(items[0].content.positions.as_arrow_array()) == 2


def test_pictures_are_below_the_camera_of_their_namespace() -> None:
    converter = settled()
    converter.know_camera("/r/eye/camera_info")
    info = CameraInfo(header=header("base", 2.0), width=4, height=2, K=[3, 0, 2, 0, 3, 1, 0, 0, 1])
    items = converter.items("/r/eye/camera_info", "sensor_msgs/CameraInfo", info, 2.5)
    assert [item.path for item in items] == [("odom", "base", "r.eye")]
    assert not converter.items("/r/eye/camera_info", "sensor_msgs/CameraInfo", info, 2.6), "again"
    info.K = [0.0] * 9
    assert not converter.items("/r/eye/camera_info", "sensor_msgs/CameraInfo", info, 2.7)
    boxes = BoundingBoxes(header("base", 2.2), [BoundingBox(1, "crate", 2, 3, 2, 5, 3)])
    kind = "trident_msgs/BoundingBoxes"
    item = converter.items("/r/eye/segmentation/boxes", kind, boxes, 2.5)[-1]
    assert item.path == ("odom", "base", "r.eye", "segmentation.boxes")
    assert item.content.half_sizes.as_arrow_array().to_pylist() == [[0.5, 1.5]]
    image = Image(header("base", 2.2), 1, 1, "rgb8", 0, 3, b"abc")
    item = converter.items("/other/image_raw", "sensor_msgs/Image", image, 2.5)[-1]
    assert item.path == ("odom", "base", "other", "image_raw")


def test_models_are_shown_when_they_have_moved() -> None:
    converter = Converter()
    still, going = Pose(orientation=Quaternion(w=1)), Pose(Point(1, 2, 3), QUARTER)
    states = ModelStates(name=["wall", "robot"], pose=[still, going])
    kind = "gazebo_msgs/ModelStates"
    first = {item.path for item in converter.items("/gazebo/model_states", kind, states, 1.0)}
    assert first >= {("world", "wall"), ("world", "robot"), ("world", "robot", "name")}
    states.pose[1] = Pose(Point(1.5, 2, 3), QUARTER)
    assert not converter.items("/gazebo/model_states", kind, states, 1.001), "too soon"
    items = converter.items("/gazebo/model_states", kind, states, 1.02)
    assert [(item.path, item.stamp_s) for item in items] == [(("world", "robot"), 1.02)]


def test_odometry_leaves_a_trail() -> None:
    converter = settled()
    lengths = []
    for step in range(40):
        odometry = Odometry(header=header("odom", 2.5 + step))
        odometry.pose.pose.position.x = 0.03 * step
        items = converter.items("/odom", "nav_msgs/Odometry", odometry, 2.5 + step)
        lengths += [item.stamp_s for item in items if item.path == ("odom", "odom")]
    assert lengths == [2.5 + step for step in range(0, 40, 2)], "5 cm apart, at least"


def test_a_trail_is_of_bounded_length() -> None:
    trail = Trail()
    added = sum(trail.add(0.05001 * k, 0.0, 0.0) for k in range(5000))
    assert added < 5000
    assert 100 < len(trail.places) <= 512
    np.testing.assert_array_equal(trail.places[0], [0, 0, 0])
    assert trail.places[-1, 0] > 0.05 * 4900
    assert np.all(np.diff(trail.places[:, 0]) > 0.05)


def test_the_first_row_of_a_map_is_at_its_origin() -> None:
    picture = archetypes.map_picture(np.array([[0, 100], [-1, 50]], np.int16))
    np.testing.assert_array_equal(picture[..., 0], [[128, 127], [254, 0]])
    grid = OccupancyGrid()
    grid.info.width, grid.info.height, grid.info.resolution = 2, 1, 0.5
    grid.info.origin = Pose(Point(3, 4, 0), QUARTER)
    grid.data = [0, 100]
    mesh = archetypes.of_grid(grid)
    corners = np.array(mesh.vertex_positions.as_arrow_array().to_pylist())
    np.testing.assert_allclose(corners, [[3, 4, 0], [3, 5, 0], [2.5, 5, 0], [2.5, 4, 0]], atol=1e-6)
    grid.data = [0]
    with pytest.raises(EvalError, match="map of 1 cells, legal: 1 x 2"):
        archetypes.of_grid(grid)


@pytest.mark.parametrize(
    ("encoding", "data", "kind"),
    [
        ("rgb8", bytes(6), rr.Image),
        ("bgra8", bytes(8), rr.Image),
        ("mono8", bytes(2), rr.Image),
        ("32FC1", np.array([1.5, np.nan], "<f4").tobytes(), rr.DepthImage),
        ("16UC1", np.array([1500, 0], "<u2").tobytes(), rr.DepthImage),
        ("mono16", np.array([1, 2], "<u2").tobytes(), rr.SegmentationImage),
    ],
)
def test_images_of_every_encoding(encoding: str, data: bytes, kind: type) -> None:
    padded = data + b"\x07"
    image = Image(Header(), 1, 2, encoding, 0, len(padded), padded)
    shown = archetypes.of_image(image)
    assert isinstance(shown, kind)
    assert bytes(shown.buffer.as_arrow_array().to_pylist()[0]) == data
    image.data = padded[:-1]
    with pytest.raises(EvalError, match=r"image of \d+ bytes, legal: 1 rows"):
        archetypes.of_image(image)
    image.encoding = "yuv422"
    with pytest.raises(EvalError, match="encoding 'yuv422', legal: rgb8, bgr8"):
        archetypes.of_image(image)


def test_depths_of_a_big_endian_machine() -> None:
    data = np.array([1.5, 2.5], ">f4").tobytes()
    shown = archetypes.of_image(Image(Header(), 1, 2, "32FC1", 1, 8, data))
    read = np.frombuffer(bytes(shown.buffer.as_arrow_array().to_pylist()[0]), "<f4")
    np.testing.assert_array_equal(read, [1.5, 2.5])


def test_what_was_written_is_in_the_file(tmp_path: Path) -> None:
    file = tmp_path / "seen.rrd"
    converter = settled()
    recorder = Recorder(file, viewer=False)
    places = [PoseStamped(pose=Pose(position=Point(k, 0, 0))) for k in (1, 2)]
    path = PathMessage(header("odom", 2.5), places)
    messages = [
        ("/tf", "tf2_msgs/TFMessage", transform("odom", "base", 2.25, 7.0)),
        ("/scan", "sensor_msgs/LaserScan", scan("lidar", 2.5)),
        ("/plan", "nav_msgs/Path", path),
        ("/rosout", "rosgraph_msgs/Log", Log(header("", 2.5), 4, "/gazebo", "m", "", "", 0, [])),
    ]
    for topic, kind, message in messages:
        for item in converter.items(topic, kind, message, 2.5):
            recorder.log(item)
    recorder.close()
    recording = rr.dataframe.load_recording(str(file))

    def rows(entity: str, component: str) -> list[Any]:
        view = recording.view(index="sim_time", contents=entity)
        return (
            view.select("sim_time", f"{entity}:{component}")
            .read_all()
            .to_pydict()[f"{entity}:{component}"]
        )

    assert rows("/odom/base", "Translation3D") == [[[7.0, 0.0, 0.0]]]
    points = np.array(rows("/odom/base/lidar/scan", "Position3D")[0])
    np.testing.assert_allclose(
        points, [[1, 0, 0], [2 * np.cos(0.1), 2 * np.sin(0.1), 0]], atol=1e-6
    )
    assert len(rows("/odom/plan", "LineStrip3D")[0][0]) == 2
    assert rows("/log/gazebo", "Text") == [["m"]]
    times = recording.view(index="sim_time", contents="/odom/base").select().read_all()
    assert [t.value for t in times.column("sim_time")] == [2_250_000_000]


class ListRecorder(Recorder):
    """Keeps items in memory."""

    def __init__(self) -> None:
        super().__init__(file=None, viewer=False)
        self.items: list[Item] = []

    def log(self, item: Item) -> None:
        self.items.append(item)

    def stamps(self, *path: str) -> list[float | None]:
        return [item.stamp_s for item in self.items if item.path == path]


def scans_of(stream: node.Stream, times: list[float]) -> None:
    for now_s in times:
        stream.write(("/scan", "sensor_msgs/LaserScan", scan("lidar", now_s - 0.1), now_s))


def tf_of(stream: node.Stream, parent: str, child: str, now_s: float) -> None:
    message = transform(parent, child, now_s)
    stream.write(("/tf", "tf2_msgs/TFMessage", message, now_s))


def test_no_scan_is_lost_while_frames_come() -> None:
    record = ListRecorder()
    stream = node.Stream(record, re.compile(""))
    tf_of(stream, "odom", "lidar", 1.0)
    scans_of(stream, [1.1, 1.25])
    tf_of(stream, "odom", "wheel", 1.3)
    scans_of(stream, [1.35, 1.45])
    assert record.stamps("odom", "lidar", "scan") == pytest.approx([1.0, 1.15])
    scans_of(stream, [1.55])
    assert record.stamps("odom", "lidar", "scan") == pytest.approx([1.0, 1.15, 1.25, 1.35, 1.45])


def test_frames_that_never_settle_hold_scans_for_two_seconds_at_most() -> None:
    record = ListRecorder()
    stream = node.Stream(record, re.compile(""))
    times = [1.0 + 0.1 * k for k in range(40)]
    for k, now_s in enumerate(times):
        tf_of(stream, "lidar", f"part{k}", now_s)
        scans_of(stream, [now_s])
    shown = record.stamps("lidar", "scan")
    assert shown == pytest.approx([now_s - 0.1 for now_s in times[: len(shown)]])
    assert len(shown) >= 20


@pytest.mark.parametrize(
    ("words", "what"),
    [
        ([], "neither --out nor --viewer"),
        (["--out", "a.bag"], "--out a.bag: suffix '.bag', legal: .rrd"),
        (["--out", "a.rrd", "--seconds", "-1"], "--seconds -1, legal: more than 0"),
        (["--out", "a.rrd", "--seconds", "nan"], "--seconds nan, legal: more than 0"),
        (["--out", "a.rrd", "--topics", "("], r"--topics '\(', legal: a regex"),
    ],
)
def test_bad_options_of_the_node_are_refused(words: list[str], what: str) -> None:
    with pytest.raises(EvalError, match=what):
        node._checked(node._parser().parse_args(words))


def test_a_file_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    file = tmp_path / "none" / "seen.rrd"
    with pytest.raises(EvalError, match=re.escape(f"{file}: cannot be written: No such file")):
        Recorder(file, viewer=False)
