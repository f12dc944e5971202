# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node observer: a camera beside the robots, for those who have no display.

It puts a camera into the running simulation, writes what that sees as PNG files, and takes it away
again. The world has to run: a picture is drawn at a step.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
import rospy
from gazebo_msgs.srv import DeleteModel, GetModelState, SpawnModel
from geometry_msgs.msg import Point, Pose, Quaternion
from PIL import Image as Picture
from sensor_msgs.msg import Image

from trident_eval.core.errors import EvalError

_SERVICE_LIMIT_S = 20.0
_RATE_HZ = 100.0  # at least as often as pictures are asked for

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
    """

    place: Place = (6.0, -6.0, 5.0)
    target: Place = (0.0, 0.0, 0.5)
    width: int = 960
    height: int = 600
    fov_rad: float = math.radians(70.0)

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
            f"<sensor type='camera' name='camera'><update_rate>{_RATE_HZ:g}</update_rate><camera>"
            f"<horizontal_fov>{self.fov_rad}</horizontal_fov><image><width>{self.width}</width>"
            f"<height>{self.height}</height><format>R8G8B8</format></image>"
            "<clip><near>0.05</near><far>500</far></clip></camera>"
            "<plugin name='camera' filename='libgazebo_ros_camera.so'>"
            f"<cameraName>{name}</cameraName><imageTopicName>image_raw</imageTopicName>"
            "<cameraInfoTopicName>camera_info</cameraInfoTopicName>"
            f"<frameName>{name}</frameName></plugin></sensor></link></model></sdf>"
        )


def pixels_of(message: Image) -> npt.NDArray[np.uint8]:
    """Red, green, blue, shape (height, width, 3).

    Raises:
        EvalError: another encoding than rgb8.
    """
    if message.encoding != "rgb8":
        raise EvalError(f"image of encoding '{message.encoding}', legal: rgb8")
    rows = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)
    return rows[:, : 3 * message.width].reshape(message.height, message.width, 3)


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
        self._image: Image | None = None
        self._subscriber: rospy.Subscriber | None = None

    def __enter__(self) -> Observer:
        """Put it there.

        Raises:
            EvalError: there is no simulator, or it refuses.
        """
        pose = Pose(Point(*self._view.place), Quaternion(*self._view.orientation()))
        try:
            rospy.wait_for_service("/gazebo/spawn_sdf_model", _SERVICE_LIMIT_S)
            spawn = rospy.ServiceProxy("/gazebo/spawn_sdf_model", SpawnModel)
            answer = spawn(self._name, self._view.sdf(self._name), f"/{self._name}", pose, "")
        except (rospy.ROSException, rospy.ServiceException) as error:
            raise EvalError(f"no simulator: {error}") from error
        if not answer.success:
            raise EvalError(f"the simulator refuses: {answer.status_message}")
        topic = f"/{self._name}/{self._name}/image_raw"
        self._subscriber = rospy.Subscriber(topic, Image, self._on_image, queue_size=1)
        return self

    def __exit__(self, *_: object) -> None:
        """Take it away; a simulator that has gone took it along."""
        if self._subscriber is not None:
            self._subscriber.unregister()
        try:
            rospy.ServiceProxy("/gazebo/delete_model", DeleteModel)(self._name)
        except (rospy.ROSException, rospy.ServiceException):
            rospy.loginfo("observer: the simulator has gone")

    def picture(self, after_s: float, limit_s: float) -> Image:
        """The first picture stamped at or after a simulated time.

        Args:
            after_s: simulated time [s].
            limit_s: longest wait, in wall-clock time [s].

        Raises:
            EvalError: there is none within the limit.
        """

        def is_there() -> bool:
            return self._image is not None and self._image.header.stamp.to_sec() >= after_s

        with self._arrived:
            if not self._arrived.wait_for(is_there, limit_s):
                raise EvalError(
                    f"no picture of t >= {after_s:g} s within {limit_s:g} s: the world stands "
                    "still or is too slow (rosservice call /gazebo/unpause_physics)"
                )
            assert self._image is not None
            return self._image

    def _on_image(self, image: Image) -> None:
        with self._arrived:
            self._image = image
            self._arrived.notify_all()


def main(arguments: list[str] | None = None) -> int:
    """Run to the end.

    Returns:
        0: written; 1: not, and why has been told.
    """
    options = _parser().parse_args(rospy.myargv(arguments or sys.argv)[1:])
    rospy.init_node("observer", anonymous=True, disable_signals=True)
    try:
        width, height = _size(options.size)
        _check(options)
        about = place_of(options.model) if options.model else (0.0, 0.0, 0.0)
        view = View(
            _sum(about, options.place),
            _sum(about, options.at),
            width,
            height,
            math.radians(options.fov),
        )
        with Observer(view) as observer:
            _write(observer, options)
    except EvalError as error:
        print(f"observer: {error}", file=sys.stderr)
        return 1
    return 0


def place_of(model: str) -> Place:
    """Where a model is now [m, world].

    Raises:
        EvalError: there is none of that name, or no simulator.
    """
    try:
        rospy.wait_for_service("/gazebo/get_model_state", _SERVICE_LIMIT_S)
        answer = rospy.ServiceProxy("/gazebo/get_model_state", GetModelState)(model, "")
    except (rospy.ROSException, rospy.ServiceException) as error:
        raise EvalError(f"no simulator: {error}") from error
    if not answer.success:
        raise EvalError(f"--model {model}: {answer.status_message}")
    place = answer.pose.position
    return place.x, place.y, place.z


def _sum(a: Sequence[float], b: Sequence[float]) -> Place:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def _parser() -> argparse.ArgumentParser:
    default = View()
    parser = argparse.ArgumentParser(prog="observer", description=__doc__)
    axes = ("X", "Y", "Z")
    parser.add_argument(
        "--from", dest="place", nargs=3, type=float, default=default.place, metavar=axes, help="[m]"
    )
    parser.add_argument(
        "--at", nargs=3, type=float, default=default.target, metavar=axes, help="looked at [m]"
    )
    parser.add_argument("--model", metavar="NAME", help="both from where this model is now")
    parser.add_argument("--fov", type=float, default=70.0, metavar="DEG", help="horizontal")
    parser.add_argument("--size", default="960x600", metavar="WxH", help="pixels; 960x600")
    parser.add_argument("--out", type=Path, default=Path("observer.png"), metavar="FILE.png")
    parser.add_argument(
        "--count", type=int, default=1, help="how many; from two on FILE_0000.png, …"
    )
    parser.add_argument(
        "--every", type=float, default=1.0, metavar="S", help="of simulated time; default 1"
    )
    parser.add_argument(
        "--limit", type=float, default=30.0, metavar="S", help="of wall-clock time per picture"
    )
    return parser


def _size(text: str) -> tuple[int, int]:
    try:
        width, height = (int(word) for word in text.split("x"))
    except ValueError as error:
        raise EvalError(f"--size: '{text}', legal: WIDTHxHEIGHT") from error
    return width, height


def _check(options: argparse.Namespace) -> None:
    if options.out.suffix != ".png":
        raise EvalError(f"--out {options.out}: suffix '{options.out.suffix}', legal: .png")
    if not options.out.resolve().parent.is_dir():
        raise EvalError(f"--out {options.out}: its folder does not exist")
    if options.count < 1:
        raise EvalError(f"--count {options.count}, legal: 1 or more")
    if not (math.isfinite(options.every) and options.every > 0.0):
        raise EvalError(f"--every {options.every:g} s, legal: more than 0")


def _write(observer: Observer, options: argparse.Namespace) -> None:
    after_s = 0.0
    for number in range(options.count):
        image = observer.picture(after_s, options.limit)
        after_s = image.header.stamp.to_sec() + options.every
        path: Path = options.out
        if options.count > 1:
            path = path.with_stem(f"{path.stem}_{number:04d}")
        Picture.fromarray(pixels_of(image), "RGB").save(path)
        print(f"{path}: t = {image.header.stamp.to_sec():.3f} s", flush=True)
