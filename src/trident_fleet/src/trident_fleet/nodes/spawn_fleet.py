# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Spawns many vehicles of one kind: one process and one description instead of one for each."""

from __future__ import annotations

import time
from contextlib import closing
from typing import Any

import rospy
from gazebo_msgs.srv import SpawnModel
from geometry_msgs.msg import Point, Pose, Quaternion

from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.strict_yaml import three_numbers
from trident_fleet.nodes.params import get_param
from trident_ros import init_node

_SERVICE = "/gazebo/spawn_urdf_model"
_REPORT_S = 10.0
_POLL_S = 0.05

Positions = dict[str, tuple[float, float, float]]


def main() -> int:
    """Spawn the first `uavs` of `~positions`, each as `~robot_description` with its name in it.

    Private parameters: `robot_description`, a URDF in which `namespace_token` stands wherever the
    vehicle's name belongs; `positions`, name: [x, y, z] in metres. Each vehicle's description goes
    to `/NAME/robot_description`.

    Returns:
        Exit code of the process.
    """
    init_node("spawn_fleet")
    try:
        description, token = _text("robot_description"), _text("namespace_token")
        if token not in description:
            raise FormationError(f"robot_description: no '{token}' in it; legal: the name's place")
        positions = read_positions(rospy.get_param("~positions", None), get_param("uavs"))
        spawned = spawn_all(description, token, positions)
    except (FormationError, rospy.ServiceException, rospy.ROSException) as error:
        if not rospy.core.is_shutdown_requested():
            rospy.logfatal("spawn_fleet: %s", error)
        return 1
    rospy.loginfo("%d vehicles are in the world", spawned)
    return 0


def read_positions(given: Any, uavs: Any) -> Positions:
    """Check `~positions`, and take the first `uavs` of them by number; None or 0: all.

    Raises:
        FormationError: not a mapping of names to three finite numbers, or too few.
    """
    if not isinstance(given, dict) or not given:
        raise FormationError(f"positions: {given!r}; legal: name: [x, y, z] for each vehicle")
    positions: Positions = {}
    for name in sorted(given, key=lambda name: (len(name), name)):
        position = three_numbers(given[name])
        if position is None:
            value = given[name]
            raise FormationError(f"positions/{name}: {value!r}; legal: [x, y, z], finite numbers")
        positions[name] = position
    return dict(list(positions.items())[: _read_count(uavs, len(positions))])


def _read_count(uavs: Any, known: int) -> int:
    count = known if uavs in (None, 0) else uavs
    if not isinstance(count, int) or not 1 <= count <= known:
        raise FormationError(f"uavs: {uavs!r}; legal: 1 to {known}")
    return count


def _text(name: str) -> str:
    value = rospy.get_param("~" + name, None)
    if not isinstance(value, str) or not value:
        raise FormationError(f"{name}: {value!r}; legal: a text")
    return value


def spawn_all(description: str, token: str, positions: Positions) -> int:
    """Have the simulator spawn each vehicle; errors as the service's.

    Args:
        description: a URDF.
        token: that stands in it for the vehicle's name.
        positions: of the vehicles.

    Returns:
        How many there are.

    Raises:
        FormationError: the simulator refuses one.
    """
    _wait_for_simulator()
    with closing(rospy.ServiceProxy(_SERVICE, SpawnModel, persistent=True)) as spawn:
        for name, (x, y, z) in positions.items():
            own = description.replace(token, name)
            rospy.set_param(f"/{name}/robot_description", own)
            pose = Pose(Point(x, y, z), Quaternion(0.0, 0.0, 0.0, 1.0))
            answer = spawn(name, own, f"/{name}", pose, "world")
            if not answer.success:
                raise FormationError(f"{name}: {answer.status_message}")
    return len(positions)


def _wait_for_simulator() -> None:
    """On wall-clock time: simulated time does not run yet."""
    reported = time.monotonic()
    while not rospy.is_shutdown():
        try:
            rospy.wait_for_service(_SERVICE, timeout=_POLL_S)
        except rospy.ROSException:
            if time.monotonic() - reported > _REPORT_S:
                rospy.logwarn("no service %s yet, still waiting", _SERVICE)
                reported = time.monotonic()
        else:
            return
