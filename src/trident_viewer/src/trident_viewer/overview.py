# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node overview: one picture of all that is in a simulation, with its names.

Cameras in the world find the side from which nothing stands in front of what moves; another takes
the picture, as a robot's camera would. All are taken away again.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import rospy
from PIL import Image as Picture
from sensor_msgs.msg import Image
from trident_eval.core.errors import EvalError

from trident_ros import init_node
from trident_viewer.census import models_in_the_world
from trident_viewer.framing import Lens, Sphere, Stand, all_inside, frame
from trident_viewer.hold import Held
from trident_viewer.launch_nodes import wait_for_nodes
from trident_viewer.names import write_names
from trident_viewer.observer_camera import Observer, View, pixels_of
from trident_viewer.scout import best_of, features

_FOV_RAD = math.radians(60.0)
_NODES_LIMIT_S = 300.0
_PICTURE_LIMIT_S = 300.0
_LOST_M = 1000.0
_PACE = 5.0  # times real time, so that nodes that are not waited for keep up
_STREAM_HZ = 5.0  # of simulated time
_AGAIN_S = 1.0
_AHEAD_S = 0.1  # of simulated time, in which the side is looked for
# Headings and how far down, by preference: from behind on the right, then all around, then above.
_SIDES = [(yaw, 30.0) for yaw in (55.0, 125.0, -55.0, -125.0, 90.0, 0.0)]
_SIDES += [(55.0, 55.0), (-125.0, 55.0), (125.0, 55.0), (-55.0, 55.0), (55.0, 80.0), (0.0, 89.0)]


def main(arguments: list[str] | None = None) -> int:
    """Take the picture.

    Returns:
        0: it is written; 1: it is not, and the reason has been reported.
    """
    parser = argparse.ArgumentParser(prog="overview", description=__doc__)
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--out", type=Path, metavar="FILE.png")
    what.add_argument("--stream", action="store_true", help="/overview/image_raw, until the end")
    parser.add_argument("--size", default="1600x1000", metavar="WxH", help="pixels")
    parser.add_argument("--hold", action="store_true", help="the world may be held for it")
    parser.add_argument(
        "--at", type=float, metavar="SECONDS", help="with --hold: simulated time of the picture"
    )
    parser.add_argument(
        "--nodes", type=int, default=0, metavar="N", help="with --hold: of roslaunch, waited for"
    )
    options = parser.parse_args(rospy.myargv(arguments or sys.argv)[1:])
    init_node("overview", anonymous=True)
    try:
        lens = _lens(options.size)
        if options.stream:
            return _stream(lens)
        held = _held(options.nodes) if options.hold else None
        stamp_s = _take(lens, held, options.at, options.out)
    except (EvalError, rospy.ROSException, rospy.ServiceException) as error:
        print(f"overview: {error}", file=sys.stderr)
        return 1
    print(f"{options.out}: t = {stamp_s:.3f} s", flush=True)
    return 0


def _lens(size: str) -> Lens:
    try:
        width, height = (int(word) for word in size.split("x"))
    except ValueError as error:
        raise EvalError(f"--size: '{size}', legal: WIDTHxHEIGHT") from error
    View(width=width, height=height).validate()
    return Lens(width, height, _FOV_RAD)


def _stream(lens: Lens) -> int:
    """Publish pictures of all that is there as it moves, until ROS ends."""
    publisher = rospy.Publisher("/overview/image_raw", Image, queue_size=1, latch=True)
    while not rospy.is_shutdown():
        try:
            _publish(lens, publisher)
        except (EvalError, rospy.ROSException, rospy.ServiceException) as error:
            # A world that stands, is reset or is still empty is looked at again.
            rospy.loginfo("overview: %s", error)
            rospy.rostime.wallsleep(_AGAIN_S)
    return 0


def _publish(lens: Lens, publisher: rospy.Publisher) -> None:
    """Pictures from one place, for as long as all is seen from there."""
    shown = what_to_show(models_in_the_world())
    stand = best_of(_stands(lens, shown), lens, shown, None)
    view = View(stand.place, stand.target, lens.width, lens.height, lens.fov_rad, _STREAM_HZ)
    with Observer(view) as observer:
        while not rospy.is_shutdown():
            image = observer.newest(_PICTURE_LIMIT_S)
            models = models_in_the_world()
            picture = Picture.fromarray(pixels_of(image), "RGB")
            write_names(picture, stand, lens, models)
            image.data, image.step = picture.tobytes(), 3 * image.width
            publisher.publish(image)
            if not all_inside(stand, lens, what_to_show(models)):
                return


def _held(nodes: int) -> Held:
    held = Held()
    if nodes:
        wait_for_nodes(nodes, _NODES_LIMIT_S, held.pause)
    return held


def what_to_show(models: Sequence[Sphere]) -> list[Sphere]:
    """Robots; without any, what moves; else the scenery. Not what was lost in space.

    Raises:
        EvalError: the world is empty.
    """
    if not models:
        raise EvalError("the world is empty: there is nothing to be seen")
    shown = _subjects(models)
    middle = np.median([model.center for model in shown], axis=0)
    near = [model for model in shown if math.dist(model.center, middle) <= _LOST_M]
    return near or shown


def _subjects(models: Sequence[Sphere]) -> list[Sphere]:
    moving = [model for model in models if model.moves]
    return [model for model in moving if model.has_joints] or moving or list(models)


def _best_stand(lens: Lens, step: Callable[[], None] | None) -> Stand:
    """From where what is to be shown is seen best; of scenery its features."""
    shown = what_to_show(models_in_the_world())
    if not shown[0].moves:
        middle = np.mean([sphere.center for sphere in shown], axis=0)
        shown = features(tuple(middle.tolist()), step) or shown
    return best_of(_stands(lens, shown), lens, shown, step)


def _stands(lens: Lens, shown: Sequence[Sphere]) -> list[Stand]:
    return [frame(shown, lens, math.radians(yaw), math.radians(down)) for yaw, down in _SIDES]


def _take(lens: Lens, held: Held | None, at_s: float | None, out: Path) -> float:
    """Write the picture; its simulated time [s]."""
    end_s = 0.0
    if held is not None:
        end_s = held.time_s + _AHEAD_S if at_s is None else at_s
        held.advance_to(max(end_s - _AHEAD_S, held.time_s), _PACE)
    stand = _best_stand(lens, None if held is None else held.step_once)
    if held is not None:
        held.advance_to(max(end_s - held.dt_s, held.time_s), _PACE)
    view = View(stand.place, stand.target, lens.width, lens.height, lens.fov_rad, rate_hz=1000.0)
    models = models_in_the_world()
    with Observer(view) as observer:
        if held is not None:
            observer.wait_for_camera(_PICTURE_LIMIT_S)
            held.step_once()
        image = observer.picture(0.0, _PICTURE_LIMIT_S)
    picture = Picture.fromarray(pixels_of(image), "RGB")
    write_names(picture, stand, lens, models)
    picture.save(out)
    return float(image.header.stamp.to_sec())
