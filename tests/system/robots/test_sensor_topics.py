# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What subscribers hear of a robot with many sensors: clouds, compressed images, services."""

from __future__ import annotations

import io
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
import rospy
import tf2_ros
from harness import Launch, eventually, recorder
from PIL import Image as Picture
from sensor_msgs.msg import CameraInfo, CompressedImage, Image, Imu, PointCloud2, PointField
from std_msgs.msg import Float64
from std_srvs.srv import Empty
from tf2_msgs.msg import TFMessage

Start = Callable[..., Launch]
HALF_ROOM_M = 5.0
ROBOT = """<?xml version="1.0"?>
<robot name="explorer" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="$(find trident_description)/urdf/my_nav_robot.urdf.xacro"/>
  <xacro:velodyne_vlp16 link="velodyne" parent="base_link" x="0" y="0" z="0.2"/>
  <gazebo>
    <plugin name="imu" filename="libgazebo_ros_imu.so">
      <bodyName>base_footprint</bodyName>
      <topicName>imu</topicName>
      <updateRate>50</updateRate>
    </plugin>
  </gazebo>
</robot>
"""
LAUNCH = """<launch>
  <arg name="paused"/>
  <include file="$(find trident_bringup)/launch/sim/world.launch">
    <arg name="world" value="room"/>
    <arg name="paused" value="$(arg paused)"/>
  </include>
  <include file="$(find trident_bringup)/launch/robot/ground_robot.launch">
    <arg name="robot" value="explorer"/>
    <arg name="description" value="{robot}"/>
  </include>
</launch>
"""
POINT = np.dtype(
    [(name, "<f4") for name in ("x", "y", "z", "intensity")] + [("ring", "<u2"), ("time", "<f4")]
)


@pytest.fixture
def explorer(launch: Start, tmp_path: Path) -> Launch:
    """A robot in the room with lidar of many rings, RGB-D camera and IMU, paused."""
    robot = tmp_path / "explorer.urdf.xacro"
    robot.write_text(ROBOT, encoding="utf-8")
    file = tmp_path / "explorer.launch"
    file.write_text(LAUNCH.format(robot=robot), encoding="utf-8")
    return launch(file, paused=True).spawned("explorer")


def at_stamp(messages: list[Image], stamp: rospy.Time) -> Image:
    (found,) = (message for message in messages if message.header.stamp == stamp)
    return found


def check_cloud(cloud: PointCloud2) -> npt.NDArray[np.void]:
    """A VLP-16's points, their geometry checked against their rings and times."""
    assert [(field.name, field.offset) for field in cloud.fields] == [
        (name, POINT.fields[name][1]) for name in POINT.names
    ]
    assert cloud.fields[4].datatype == PointField.UINT16
    assert (cloud.point_step, cloud.height, cloud.header.frame_id) == (22, 1, "velodyne")
    points = np.frombuffer(cloud.data, dtype=POINT)
    assert len(points) == cloud.width > 16_000
    level = np.hypot(points["x"], points["y"])
    elevation = np.degrees(np.arctan2(points["z"], level))
    assert elevation == pytest.approx(-15.0 + 2.0 * points["ring"], abs=0.01)
    assert np.all(np.diff(points["time"]) > 0.0)
    assert 0.0 <= points["time"][0] < points["time"][-1] < 0.1
    turn = np.arctan2(points["y"], points["x"]) - 2.0 * np.pi * 10.0 * points["time"]
    assert np.abs(np.remainder(turn + np.pi, 2.0 * np.pi) - np.pi).max() < 1e-3
    return points


def test_clouds_with_rings_and_times_and_their_transforms(explorer: Launch) -> None:
    buffer = tf2_ros.Buffer(debug=False)
    listener = tf2_ros.TransformListener(buffer)
    with (
        recorder("/tf", TFMessage, publishers=2),  # then the listener hears them, too
        recorder("/velodyne_points", PointCloud2) as clouds,
    ):
        explorer.step_and_receive(100, 13, lambda: len(clouds.messages))
    stamps = [message.header.stamp for message in clouds.messages]
    assert {(b - a).to_nsec() for a, b in pairwise(stamps)} == {100_000_000}
    points = check_cloud(clouds.messages[-1])
    stamp = stamps[-1]
    last_point = stamp + rospy.Duration.from_sec(float(points["time"][-1]))
    for time in (stamp, last_point):
        eventually(lambda time=time: buffer.can_transform("odom", "velodyne", time), "its place")
    place = buffer.lookup_transform("odom", "velodyne", stamp).transform
    listener.unregister()
    assert abs(place.rotation.z) < 0.01, "it stands as it was spawned, along x"
    x, y = points["x"] + place.translation.x, points["y"] + place.translation.y
    z = points["z"] + place.translation.z
    inside = np.maximum(np.abs(x), np.abs(y))
    assert inside.max() < HALF_ROOM_M + 0.06, "nothing is seen beyond the walls"
    on_wall = np.abs(inside - HALF_ROOM_M) < 0.05
    on_floor = np.abs(z) < 0.05
    assert (on_wall | on_floor).mean() > 0.7
    assert on_wall.mean() > 0.2


def depths_of(message: CompressedImage) -> npt.NDArray[np.float64]:
    """Metres, as compressed_depth_image_transport's subscriber works them out."""
    kind = int(np.frombuffer(message.data, "<i4", 1)[0])
    a, b = np.frombuffer(message.data, "<f4", 2, offset=4).astype(float)
    assert kind == 0
    inverse = np.asarray(Picture.open(io.BytesIO(message.data[12:]))).astype(np.float64)
    return np.where(inverse > 0.0, a / np.where(inverse > 0.0, inverse - b, 1.0), np.nan)


def test_compressed_images_and_what_is_set_on_sensors(explorer: Launch) -> None:
    with (
        recorder("/camera/rgb/image_raw", Image) as images,
        recorder("/camera/rgb/image_raw/compressed", CompressedImage) as pictures,
        recorder("/camera/depth/image_raw", Image) as depths,
        recorder("/camera/depth/image_raw/compressedDepth", CompressedImage) as squeezed,
        recorder("/camera/rgb/camera_info", CameraInfo) as infos,
        recorder("/imu", Imu) as imus,
    ):
        explorer.step(500)
        topics = (images, pictures, depths, squeezed, infos, imus)
        eventually(lambda: all(len(topic.messages) >= 7 for topic in topics), "all that were taken")
        picture, depth = pictures.messages[-1], squeezed.messages[-1]
        assert (picture.format, picture.header.frame_id) == (
            "rgb8; jpeg compressed bgr8",
            "camera_optical_frame",
        )
        raw = at_stamp(images.messages, picture.header.stamp)
        expected = np.frombuffer(raw.data, np.uint8).reshape(raw.height, raw.width, 3)
        decoded = np.asarray(Picture.open(io.BytesIO(picture.data)).convert("RGB"))
        assert decoded.shape == expected.shape
        assert np.abs(decoded.astype(int) - expected.astype(int)).mean() < 4.0
        assert len(picture.data) < len(raw.data) / 5
        raw = at_stamp(depths.messages, depth.header.stamp)
        meters = np.frombuffer(raw.data, "<f4").reshape(raw.height, raw.width)
        seen = np.isfinite(meters)
        assert depth.format == "32FC1; compressedDepth png"
        assert depths_of(depth)[seen] == pytest.approx(meters[seen], abs=0.01)
        assert np.isnan(depths_of(depth)[~seen]).all()

        rospy.ServiceProxy("/imu/calibrate", Empty)()
        angle = rospy.Publisher("/camera/set_hfov", Float64, queue_size=1, latch=True)
        eventually(lambda: angle.get_num_connections() > 0, "a reader of /camera/set_hfov")
        angle.publish(0.5)
        focal = infos.messages[-1].width / 2.0 / np.tan(0.25)
        explorer.step_until(lambda: infos.messages[-1].K[0] == pytest.approx(focal), "a zoom")
        angle.unregister()
