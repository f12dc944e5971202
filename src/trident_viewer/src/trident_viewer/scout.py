# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Depth cameras in the world, which find the side from which most is to be seen."""

from __future__ import annotations

import math
import os
import threading
from collections.abc import Callable, Sequence

import numpy as np
import numpy.typing as npt
import rospy
from gazebo_msgs.srv import DeleteModel, SpawnModel
from geometry_msgs.msg import Pose, Quaternion
from sensor_msgs.msg import Image
from trident_eval.core.errors import EvalError

from trident_ros import Refusals, quoted
from trident_viewer.framing import Lens, Sphere, Stand, hidden, standing_out

Depth = npt.NDArray[np.float64]

_WIDTH_PX = 160
_MAP_PX = 300
_MAP_FOV_RAD = math.radians(70.0)
_HEIGHTS_M = (15.0, 60.0, 200.0)  # of maps: near ones show walls, far ones all there is
_FAR_M = 2000.0
_LIMIT_S = 300.0
_MAX_STEPS = 20
_CONNECT_S = 0.2
_DEPTH_BYTES = 4  # of a pixel, a float32


def best_of(
    stands: Sequence[Stand], lens: Lens, spheres: Sequence[Sphere], step: Callable[[], None] | None
) -> Stand:
    """The first of some places from which the fewest spheres are hidden.

    Args:
        stands: by preference, one or more.
        lens: of the picture that is to be taken.
        spheres: what is to be seen.
        step: advances the world by a step; None: it runs.

    Raises:
        EvalError: the simulator refuses the cameras, or sends no pictures.
    """
    small = Lens(_WIDTH_PX, max(round(_WIDTH_PX * lens.height / lens.width), 1), lens.fov_rad)
    depths = _look(stands, small, step)
    return min(
        zip(stands, depths, strict=True),
        key=lambda pair: hidden(pair[0], small, spheres, pair[1]),
    )[0]


def features(around: tuple[float, float, float], step: Callable[[], None] | None) -> list[Sphere]:
    """What stands out of the ground: the corners of the box that holds it; none if nothing does.

    Args:
        around: where to look, from above [m, world].
        step: as of `best_of`.

    Raises:
        EvalError: as `best_of`.
    """
    x, y, z = around
    stands = [Stand((x, y - 1e-3 * up, z + up), (x, y, z)) for up in _HEIGHTS_M]
    lens = Lens(_MAP_PX, _MAP_PX, _MAP_FOV_RAD)
    depths = _look(stands, lens, step)
    points = [standing_out(s, lens, d) for s, d in zip(stands, depths, strict=True)]
    found = np.concatenate(points)
    if not len(found):
        return []
    corners = np.stack([found.min(axis=0), found.max(axis=0)])
    return [
        Sphere("", (float(corners[i, 0]), float(corners[j, 1]), float(corners[k, 2])), 0.0)
        for i, j, k in np.ndindex(2, 2, 2)
    ]


def _look(stands: Sequence[Stand], lens: Lens, step: Callable[[], None] | None) -> list[Depth]:
    with _Scouts(stands, lens) as scouts:
        return scouts.depths(step)


def depth_problem(image: Image, lens: Lens) -> str:
    """Why these are not the depths that a camera with this lens sees, or ""."""
    if image.encoding != "32FC1" or image.is_bigendian:
        return f"encoding '{quoted(image.encoding)}', legal: 32FC1, little-endian"
    if (image.width, image.height) != (lens.width, lens.height):
        return f"{image.width} x {image.height} pixels, legal: {lens.width} x {lens.height}"
    size, row = len(image.data), _DEPTH_BYTES * image.width
    if image.step >= row and image.step % _DEPTH_BYTES == 0 and image.height * image.step == size:
        return ""
    return f"{size} bytes in rows of {image.step}, legal: {image.height} rows of {row} bytes"


class _Scouts:
    """The cameras, while they are in the world."""

    def __init__(self, stands: Sequence[Stand], lens: Lens) -> None:
        self._name = f"scouts_{os.getpid()}"
        self._stands, self._lens = stands, lens
        self._arrived = threading.Condition()
        self._depths: dict[int, Depth] = {}
        self._subscribers: list[rospy.Subscriber] = []
        self._refusals = Refusals()

    def __enter__(self) -> _Scouts:
        spawn = rospy.ServiceProxy("/gazebo/spawn_sdf_model", SpawnModel)
        pose = Pose(orientation=Quaternion(w=1.0))
        try:
            answer = spawn(self._name, self._sdf(), f"/{self._name}", pose, "")
        except (rospy.ROSException, rospy.ServiceException) as error:
            raise EvalError(f"no simulator: {error}") from error
        if not answer.success:
            raise EvalError(f"the simulator refuses: {answer.status_message}")
        for index in range(len(self._stands)):
            topic = f"/{self._name}/scout{index}/depth/image_raw"
            self._subscribers.append(rospy.Subscriber(topic, Image, self._on_depth, index))
        return self

    def __exit__(self, *_: object) -> None:
        for subscriber in self._subscribers:
            subscriber.unregister()
        try:
            rospy.ServiceProxy("/gazebo/delete_model", DeleteModel)(self._name)
        except (rospy.ROSException, rospy.ServiceException):
            rospy.loginfo("overview: the simulator has gone")

    def depths(self, step: Callable[[], None] | None) -> list[Depth]:
        """A depth image of each camera, shape (height, width) [m]."""
        for _ in range(_MAX_STEPS if step else 1):
            if step:
                step()
            limit_s = _LIMIT_S / _MAX_STEPS if step else _LIMIT_S
            with self._arrived:
                if self._arrived.wait_for(self._is_complete, limit_s):
                    return [self._depths[index] for index in range(len(self._stands))]
        raise EvalError(
            f"no depth image of {len(self._stands) - len(self._depths)} cameras: the world stands"
            " still or is too slow (rosservice call /gazebo/unpause_physics)"
        )

    def _is_complete(self) -> bool:
        return len(self._depths) == len(self._stands)

    def _on_depth(self, image: Image, index: int) -> None:
        problem = depth_problem(image, self._lens)
        if problem:
            self._refusals.note("depth image refused", f"depth image refused: {problem}")
            return
        with self._arrived:
            rows = np.frombuffer(image.data, np.float32)
            rows = rows.reshape(image.height, image.step // _DEPTH_BYTES)
            self._depths.setdefault(index, rows[:, : image.width].astype(np.float64))
            self._arrived.notify_all()

    def _sdf(self) -> str:
        sensors = "".join(self._sensor(index) for index in range(len(self._stands)))
        return (
            f"<sdf version='1.6'><model name='{self._name}'><static>true</static>"
            f"<link name='link'>{sensors}</link></model></sdf>"
        )

    def _sensor(self, index: int) -> str:
        stand, name = self._stands[index], f"scout{index}"
        yaw, pitch = stand.yaw_pitch_rad
        pose = " ".join(f"{value:.9g}" for value in (*stand.place, 0.0, pitch, yaw))
        return (
            f"<sensor type='depth' name='{name}'><pose>{pose}</pose><update_rate>1000</update_rate>"
            f"<camera><horizontal_fov>{self._lens.fov_rad}</horizontal_fov><image>"
            f"<width>{self._lens.width}</width><height>{self._lens.height}</height>"
            f"<format>R8G8B8</format></image><clip><near>0.05</near><far>{_FAR_M}</far></clip>"
            "</camera><plugin name='camera' filename='libgazebo_ros_openni_kinect.so'>"
            f"<cameraName>{name}</cameraName><updateRate>1000</updateRate>"
            "<imageTopicName>rgb/image_raw</imageTopicName>"
            "<cameraInfoTopicName>rgb/camera_info</cameraInfoTopicName>"
            "<depthImageTopicName>depth/image_raw</depthImageTopicName>"
            "<depthImageCameraInfoTopicName>depth/camera_info</depthImageCameraInfoTopicName>"
            "<pointCloudTopicName>depth/points</pointCloudTopicName>"
            f"<pointCloudCutoff>0.05</pointCloudCutoff><pointCloudCutoffMax>{_FAR_M}"
            f"</pointCloudCutoffMax><frameName>{name}</frameName></plugin></sensor>"
        )
