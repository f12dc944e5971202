# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The frames that the platforms of a run share: world -> <ns>/map -> <ns>/odom.

Every namespace with `mission/start` ([x, y, z, yaw], where its platform stands in the world [m,
rad]) is one. Its map is the world. Its odom is the map, too, where odometry is that of the world;
of a ground vehicle (`mission/kind` ugv) counts from its start. With `~earth` there is a frame above
the world, earth-centred (ECEF): `~latitude`, `~longitude` [deg], `~height` [m] are the world's
origin. With `~fused` world -> <ns>/map is left to team_fusion_node.
"""

from __future__ import annotations

import math
from typing import Any

import rospy
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

from trident_nav.core.errors import NavError
from trident_nav.core.places import earth_from_world, numbers, quaternion
from trident_ros import init_node, warn_of_unknown_parameters


def transform(
    parent: str,
    child: str,
    position: tuple[float, float, float] = (0.0, 0.0, 0.0),
    orientation: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0),
) -> TransformStamped:
    """A transform for all times: position [m], orientation x, y, z, w."""
    message = TransformStamped()
    message.header.frame_id, message.child_frame_id = parent, child
    place, turn = message.transform.translation, message.transform.rotation
    place.x, place.y, place.z = position
    turn.x, turn.y, turn.z, turn.w = orientation
    return message


def frames_of(name: str, mission: dict[str, Any], is_fused: bool) -> list[TransformStamped]:
    """Of one platform; with `is_fused` without that of its map.

    Raises:
        NavError: no start.
    """
    x, y, z, yaw = numbers(f"/{name}/mission/start", mission.get("start"), 4)
    frames = [] if is_fused else [transform("world", f"{name}/map")]
    if mission.get("kind") == "ugv":
        turn = (0.0, 0.0, math.sin(yaw / 2.0), math.cos(yaw / 2.0))
        frames.append(transform(f"{name}/map", f"{name}/odom", (x, y, z), turn))
    else:
        frames.append(transform(f"{name}/map", f"{name}/odom"))
    return frames


def earth_frame() -> TransformStamped:
    """The world in the earth's frame.

    Raises:
        NavError: an illegal place.
    """
    given = [rospy.get_param("~" + key, value) for key, value in _ORIGIN.items()]
    latitude, longitude, height = numbers("~latitude, ~longitude, ~height", given, 3)
    origin, rotation = earth_from_world(latitude, longitude, height)
    x, y, z = (float(value) for value in origin)
    return transform("earth", "world", (x, y, z), quaternion(rotation))


#: Of the shipped worlds of the sea.
_ORIGIN = {"latitude": 63.4389, "longitude": 10.399, "height": 0.0}


def _all_frames() -> list[TransformStamped]:
    """Frames of all missions that have a start, and of the earth if it is wanted."""
    frames: list[TransformStamped] = []
    is_fused = bool(rospy.get_param("~fused", False))
    for name, values in sorted(rospy.get_param("/").items()):
        mission = values.get("mission") if isinstance(values, dict) else None
        if isinstance(mission, dict) and "start" in mission:
            frames += frames_of(name, mission, is_fused)
    if rospy.get_param("~earth", False):
        frames.append(earth_frame())
    return frames


def main() -> int:
    """Run until the node is shut down.

    Returns:
        Exit code of the process.
    """
    init_node("platform_frames")
    warn_of_unknown_parameters((*_ORIGIN, "earth", "fused"))
    try:
        frames = _all_frames()
    except NavError as error:
        rospy.logfatal("platform_frames: %s", error)
        return 1
    publisher = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
    publisher.publish(TFMessage(frames))
    rospy.spin()
    return 0
