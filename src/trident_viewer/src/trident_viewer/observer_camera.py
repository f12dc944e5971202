# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A camera next to the robots, put into the running simulation."""

from __future__ import annotations

import math
import os
import threading
import time
from collections import deque
from dataclasses import dataclass
from xml.sax.saxutils import escape

import numpy as np
import numpy.typing as npt
import rospy
from gazebo_msgs.srv import DeleteModel, GetModelState, SpawnModel
from geometry_msgs.msg import Point, Pose, Quaternion
from sensor_msgs.msg import Image
from trident_eval.core.errors import EvalError

from trident_ros import Refusals, point_problem, quoted, stamp_problem

_SERVICE_LIMIT_S = 20.0
_GONE_POLL_S = 1.0
_MODEL_POLL_S = 0.2
_CAMERA_POLL_S = 0.02
_KEPT_BYTES = 1 << 28  # of pictures that wait to be written, while the encoder starts or is slow
_IMAGE_BYTES = 1 << 24  # of a socket's buffer: as large as a picture

Place = tuple[float, float, float]


@dataclass(frozen=True)
class View:
    """A camera in the world.

    Attributes:
        place: where it is [m, world].
        target: what it looks at [m, world].
        width: of the picture [pixels].
        height: of the picture [pixels].
        fov_rad: horizontal field of view [rad].
        rate_hz: pictures per second of simulated time, at most.
        followed: model that the camera is carried along with, without turning; both places are
            seen from its origin, in the world's axes. None: the camera stands.
    """

    place: Place = (6.0, -6.0, 5.0)
    target: Place = (0.0, 0.0, 0.5)
    width: int = 960
    height: int = 600
    fov_rad: float = math.radians(70.0)
    rate_hz: float = 100.0
    followed: str | None = None

    def validate(self) -> None:
        """Raises EvalError naming the field, its value and what is legal."""
        for name in ("width", "height"):
            value = getattr(self, name)
            if not 16 <= value <= 4096:
                raise EvalError(f"--size: {name} {value} pixels, legal: 16 to 4096")
        if not 0.1 <= self.fov_rad <= math.radians(150.0):
            raise EvalError(f"--fov: {math.degrees(self.fov_rad):g} deg, legal: 6 to 150 deg")
        if not all(math.isfinite(value) for value in (*self.place, *self.target)):
            raise EvalError("--from, --at: legal: finite numbers")
        if math.dist(self.place, self.target) < 1e-3:
            raise EvalError("--at: legal: another place than --from")

    def orientation(self) -> tuple[float, float, float, float]:
        """Quaternion x y z w of a body whose x axis looks at the target, upright."""
        dx, dy, dz = (b - a for a, b in zip(self.place, self.target, strict=True))
        yaw, pitch = math.atan2(dy, dx), math.atan2(-dz, math.hypot(dx, dy))
        cy, sy, cp, sp = (f(angle / 2) for angle in (yaw, pitch) for f in (math.cos, math.sin))
        return (-sp * sy, sp * cy, cp * sy, cp * cy)

    def sdf(self, name: str) -> str:
        """A model of this name with nothing but the camera."""
        return (
            f"<sdf version='1.6'><model name='{name}'><static>true</static><link name='link'>"
            f"<sensor type='camera' name='camera'><update_rate>{self.rate_hz:g}</update_rate>"
            f"<camera><horizontal_fov>{self.fov_rad}</horizontal_fov><image><width>{self.width}"
            f"</width><height>{self.height}</height><format>R8G8B8</format></image>"
            "<clip><near>0.05</near><far>500</far></clip></camera>"
            "<plugin name='camera' filename='libgazebo_ros_camera.so'>"
            f"<cameraName>{name}</cameraName><imageTopicName>image_raw</imageTopicName>"
            "<cameraInfoTopicName>camera_info</cameraInfoTopicName>"
            f"<frameName>{name}</frameName></plugin></sensor></link>{self._carrier()}</model></sdf>"
        )

    def _carrier(self) -> str:
        if self.followed is None:
            return ""
        offset = " ".join(f"{value:.9g}" for value in self.place)
        return (
            "<plugin name='follow' filename='libtrident_follow.so'>"
            f"<followed>{escape(self.followed)}</followed><offset>{offset}</offset></plugin>"
        )


class WorldStandsError(EvalError):
    """No picture came: the world is paused, or the simulator has gone."""


def image_problem(message: Image) -> str:
    """Why these are no color pixels in rows, or ""."""
    if message.encoding != "rgb8":
        return f"image of encoding '{quoted(message.encoding)}', legal: rgb8"
    size, row = len(message.data), 3 * message.width
    if size > 0 and message.step >= row and message.height * message.step == size:
        return stamp_problem(message.header.stamp)
    return (
        f"image of {message.width} x {message.height} pixels with {message.step} bytes a row has"
        f" {size} bytes, legal: rows of at least {row} bytes, and as many bytes as they have"
    )


def pixels_of(message: Image) -> npt.NDArray[np.uint8]:
    """Red, green, blue, shape (height, width, 3).

    Raises:
        EvalError: another encoding than rgb8, or rows that are not what the message says.
    """
    problem = image_problem(message)
    if problem:
        raise EvalError(problem)
    rows = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)
    return rows[:, : 3 * message.width].reshape(message.height, message.width, 3)


class WaitingPictures:
    """Pictures that have arrived and are not taken yet, oldest first; the oldest are dropped."""

    def __init__(self, limit_bytes: int) -> None:
        """Holds none; `limit_bytes`: of all their pixels together, one picture always fits."""
        self._limit = limit_bytes
        self._bytes = 0
        self._images: deque[Image] = deque()

    def __len__(self) -> int:
        """How many wait."""
        return len(self._images)

    def put(self, image: Image) -> None:
        """One more, behind the others."""
        self._images.append(image)
        self._bytes += len(image.data)
        while self._bytes > self._limit and len(self._images) > 1:
            self.take()

    def take(self) -> Image:
        """The oldest.

        Raises:
            IndexError: it is empty.
        """
        image = self._images.popleft()
        self._bytes -= len(image.data)
        return image


class Observer:
    """The camera in the world, while it is entered."""

    def __init__(self, view: View) -> None:
        """Nothing is in the world yet.

        Raises:
            EvalError: an illegal view.
        """
        view.validate()
        self._view = view
        self._name = f"observer_{os.getpid()}"
        self._arrived = threading.Condition()
        self._images = WaitingPictures(_KEPT_BYTES)
        self._subscriber: rospy.Subscriber | None = None
        self._was_connected = False
        self._refusals = Refusals()

    def __enter__(self) -> Observer:
        """Put it there.

        Raises:
            EvalError: there is no simulator, or it refuses.
        """
        followed = self._view.followed
        origin = place_of(followed) if followed else (0.0, 0.0, 0.0)
        place = (a + b for a, b in zip(origin, self._view.place, strict=True))
        pose = Pose(Point(*place), Quaternion(*self._view.orientation()))
        try:
            rospy.wait_for_service("/gazebo/spawn_sdf_model", _SERVICE_LIMIT_S)
            spawn = rospy.ServiceProxy("/gazebo/spawn_sdf_model", SpawnModel)
            answer = spawn(self._name, self._view.sdf(self._name), f"/{self._name}", pose, "")
        except (rospy.ROSException, rospy.ServiceException) as error:
            raise EvalError(f"no simulator: {error}") from error
        if not answer.success:
            raise EvalError(f"the simulator refuses: {answer.status_message}")
        topic = f"/{self._name}/{self._name}/image_raw"
        self._subscriber = rospy.Subscriber(
            topic, Image, self._on_image, queue_size=None, buff_size=_IMAGE_BYTES
        )
        return self

    def __exit__(self, *_: object) -> None:
        """Take it away; a simulator that has gone took it along."""
        if self._subscriber is not None:
            self._subscriber.unregister()
        try:
            rospy.ServiceProxy("/gazebo/delete_model", DeleteModel)(self._name)
        except (rospy.ROSException, rospy.ServiceException):
            rospy.loginfo("observer: the simulator has gone")

    def wait_for_camera(self, limit_s: float) -> None:
        """Return when pictures would arrive, so that not even the first one is missed.

        Args:
            limit_s: longest wait, in wall-clock time [s].

        Raises:
            EvalError: the simulator offers none within the limit.
        """
        give_up = time.monotonic() + limit_s
        while self._subscriber is None or self._subscriber.get_num_connections() == 0:
            if time.monotonic() > give_up or rospy.is_shutdown():
                raise EvalError(f"no camera {self._name} within {limit_s:g} s")
            rospy.rostime.wallsleep(_CAMERA_POLL_S)

    def newest(self, limit_s: float) -> Image:
        """The newest picture that has arrived, else the next one; errors as `picture`."""
        image = self.picture(0.0, limit_s)
        with self._arrived:
            while self._images:
                image = self._images.take()
        return image

    def picture(self, after_s: float, limit_s: float) -> Image:
        """The next picture stamped at or after a simulated time.

        Args:
            after_s: simulated time [s].
            limit_s: longest wait, in wall-clock time [s].

        Raises:
            WorldStandsError: none comes within the limit.
        """
        give_up = time.monotonic() + limit_s
        while True:
            image = self._next(give_up)
            if image is None:
                raise WorldStandsError(
                    f"no picture of t >= {after_s:g} s within {limit_s:g} s: the world stands "
                    "still or is too slow (rosservice call /gazebo/unpause_physics)"
                )
            if image.header.stamp.to_sec() >= after_s:
                return image

    def _next(self, give_up: float) -> Image | None:
        """The oldest picture that waits; None: no more come before `give_up` (monotonic) [s]."""
        with self._arrived:
            while not self._images:
                left = give_up - time.monotonic()
                if left <= 0.0 or self._has_lost_the_simulator():
                    return None
                self._arrived.wait(min(left, _GONE_POLL_S))
            return self._images.take()

    def _has_lost_the_simulator(self) -> bool:
        if self._subscriber is None or self._subscriber.get_num_connections() == 0:
            return self._was_connected
        self._was_connected = True
        return False

    def _on_image(self, image: Image) -> None:
        problem = image_problem(image)
        wanted = self._view.width, self._view.height
        if not problem and (image.width, image.height) != wanted:
            problem = f"image of {image.width} x {image.height} pixels, legal: {wanted}"
        if problem:
            self._refusals.note("image refused", f"image refused: {problem}")
            return
        with self._arrived:
            self._images.put(image)
            self._arrived.notify_all()


def place_of(model: str, wait_s: float = 0.0) -> Place:
    """Where a model is now [m, world].

    Args:
        model: its name.
        wait_s: how long it may take to come, in wall-clock time [s].

    Raises:
        EvalError: no model has that name, it is nowhere, or no simulator.
    """
    give_up = time.monotonic() + wait_s
    while True:
        try:
            rospy.wait_for_service("/gazebo/get_model_state", max(wait_s, _SERVICE_LIMIT_S))
            answer = rospy.ServiceProxy("/gazebo/get_model_state", GetModelState)(model, "")
        except (rospy.ROSException, rospy.ServiceException) as error:
            raise EvalError(f"no simulator: {error}") from error
        if answer.success:
            break
        if time.monotonic() > give_up:
            raise EvalError(f"model {model}: {answer.status_message}")
        rospy.rostime.wallsleep(_MODEL_POLL_S)
    place = answer.pose.position
    problem = point_problem("position", place)
    if problem:
        raise EvalError(f"model {model}: {problem}")
    return place.x, place.y, place.z
