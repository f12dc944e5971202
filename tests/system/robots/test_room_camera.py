# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a robot's RGB-D camera says of a room whose walls are known."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from harness import Launch, recorder
from sensor_msgs.msg import CameraInfo, Image, PointCloud2

Start = Callable[..., Launch]
#: From the camera, 0.12 m ahead of the robot at the world's origin, to the eastern wall.
WALL_M = 5.0 - 0.12
WIDTH, HEIGHT = 320, 240


def test_the_camera_of_a_robot_sees_the_room(launch: Start) -> None:
    run = launch("trident_bringup", "robot_in_room.launch", paused=True).spawned("my_nav_robot")
    with (
        recorder("/camera/rgb/image_raw", Image) as images,
        recorder("/camera/rgb/camera_info", CameraInfo) as infos,
        recorder("/camera/depth/image_raw", Image) as depths,
        recorder("/camera/depth/points", PointCloud2) as clouds,
    ):
        topics = (images, infos, depths, clouds)
        run.step_and_receive(67, 15, lambda: min(len(topic.messages) for topic in topics))
    stamps = [message.header.stamp.to_nsec() for message in images.messages]
    assert {b - a for a, b in pairwise(stamps)} <= {66_000_000, 67_000_000}, "15 Hz"
    for topic in (infos, depths, clouds):
        assert [message.header.stamp.to_nsec() for message in topic.messages] == stamps
        assert topic.messages[-1].header.frame_id == "camera_optical_frame"
    image, info, depth = images.messages[-1], infos.messages[-1], depths.messages[-1]
    assert (image.encoding, image.width, image.height) == ("rgb8", WIDTH, HEIGHT)
    assert len(image.data) == image.step * HEIGHT == 3 * WIDTH * HEIGHT
    assert info.distortion_model == "plumb_bob"
    assert info.K[0] == pytest.approx(WIDTH / 2.0 / np.tan(1.0472 / 2.0), rel=1e-6)
    assert (depth.encoding, depth.step) == ("32FC1", 4 * WIDTH)
    meters = np.frombuffer(depth.data, dtype="<f4").reshape(HEIGHT, WIDTH)
    # The middle looks level at the wall; the robot may have settled by a milliradian.
    assert meters[HEIGHT // 2, WIDTH // 2] == pytest.approx(WALL_M, abs=0.01)
    assert np.isnan(meters[0]).all(), "over the wall there is nothing"
    assert np.nanmin(meters) > 0.1
    cloud = clouds.messages[-1]
    assert [field.name for field in cloud.fields] == ["x", "y", "z", "rgb"]
    points = np.frombuffer(cloud.data, dtype="<f4").reshape(HEIGHT, WIDTH, cloud.point_step // 4)
    assert np.array_equal(points[..., 2], meters, equal_nan=True)
