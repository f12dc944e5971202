# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node fleet_markers: the whole fleet as one topic of markers for rviz, whatever flies.

Subscribes to /gazebo/fleet_state and publishes /fleet_markers (visualization_msgs/MarkerArray, at
most 10 Hz of wall time): shape, name and path of every vehicle, in the frame of the states.
"""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
import rospy
from geometry_msgs.msg import Point, Pose, Quaternion, Vector3
from rosgraph.names import is_legal_name
from std_msgs.msg import ColorRGBA, Header
from trident_eval.core.errors import EvalError
from trident_eval.core.plots import color
from trident_eval.core.tracks import Array
from visualization_msgs.msg import Marker, MarkerArray

from trident_msgs.msg import FleetState
from trident_ros import Refusals, init_node, pose_problem, quoted, stamp_problem
from trident_viewer.visuals import BOX, CYLINDER, MESH, SPHERE, Visual, visuals_of

_PERIOD_S = 0.1
_PATH_STEP_M = 0.05
_LONGEST_PATH = 5000  # points
_PATH_WIDTH_M = 0.03
_LABEL_HEIGHT_M = 0.2
_LONGEST_NAME = 200
_LABEL_ABOVE_M = 0.3
_KINDS = {
    MESH: Marker.MESH_RESOURCE,
    BOX: Marker.CUBE,
    CYLINDER: Marker.CYLINDER,
    SPHERE: Marker.SPHERE,
}
# What a vehicle without a description looks like: a disc of about a vehicle's size.
_UNKNOWN = Visual(CYLINDER, np.eye(4), (0.5, 0.5, 0.08), color=(0.3, 0.3, 0.3, 1.0))


class FleetMarkers:
    """Collects states, and makes markers of the newest ones."""

    def __init__(self) -> None:
        """Nothing is known yet."""
        self._lock = threading.Lock()
        self._newest: Any = None
        self._is_new = False
        self._paths: dict[str, list[Point]] = {}
        self._gone: set[str] = set()
        self._visuals: dict[str, list[Visual]] = {}  # of the thread that makes markers, alone

    def add(self, state: Any) -> None:
        """Take a state of the fleet (trident_msgs/FleetState) without a problem."""
        with self._lock:
            if self._newest is not None and state.header.stamp < self._newest.header.stamp:
                self._paths.clear()  # the world was reset
            self._newest, self._is_new = state, True
            for gone in set(self._paths) - set(state.name):
                self._paths.pop(gone)
                self._gone.add(gone)
            for name, pose in zip(state.name, state.pose, strict=True):
                _extend(self._paths.setdefault(name, []), pose.position)

    def markers(self) -> Any:
        """MarkerArray of the newest state; None if there is nothing new."""
        with self._lock:
            if not self._is_new:
                return None
            state, self._is_new = self._newest, False
            paths = {name: list(path) for name, path in self._paths.items()}
            gone, self._gone = self._gone, set()
        for name in gone:
            self._visuals.pop(name, None)
        found = [Marker(action=Marker.DELETEALL)]
        header = Header(frame_id=state.header.frame_id)
        for index, (name, pose) in enumerate(zip(state.name, state.pose, strict=True)):
            tint = _tint(index)
            found += self._shapes(header, name, pose, tint)
            found.append(_label(header, name, pose))
            if len(paths[name]) > 1:
                found.append(_path(header, name, paths[name], tint))
        return MarkerArray(found)

    def _shapes(self, header: Any, name: str, pose: Any, tint: Any) -> list[Any]:
        if name not in self._visuals:
            self._visuals[name] = _describe(name)
        T_world_base = _matrix(pose)
        return [
            _shape(header, name, number, visual, T_world_base, tint)
            for number, visual in enumerate(self._visuals[name])
        ]


def _extend(path: list[Any], position: Any) -> None:
    """Adds a point, once the vehicle has gone a step; the oldest ones go."""
    if not path or _distance(path[-1], position) >= _PATH_STEP_M:
        path.append(position)
        del path[:-_LONGEST_PATH]


def state_problem(state: Any) -> str:
    """What is wrong with a trident_msgs/FleetState, or ""."""
    problem = stamp_problem(state.header.stamp)
    if problem:
        return problem
    if len(state.name) != len(state.pose):
        return f"{len(state.name)} names and {len(state.pose)} poses, legal: equally many"
    for name, pose in zip(state.name, state.pose, strict=True):
        problem = _vehicle_problem(name, pose)
        if problem:
            return problem
    return ""


def _vehicle_problem(name: str, pose: Any) -> str:
    if not name.isprintable() or len(name) > _LONGEST_NAME:
        return f"a vehicle's name is '{quoted(name)}', legal: up to {_LONGEST_NAME} letters"
    problem = pose_problem(pose)
    return f"{quoted(name)}: {problem}" if problem else ""


def _describe(name: str) -> list[Visual]:
    """The visuals of a vehicle's robot_description, or a disc."""
    parameter = f"/{name}/robot_description"
    urdf = rospy.get_param(parameter, "") if is_legal_name(parameter) else ""
    if not isinstance(urdf, str) or not urdf:
        return [_UNKNOWN]
    try:
        return visuals_of(urdf) or [_UNKNOWN]
    except EvalError as error:
        rospy.logwarn("%s is shown as a disc: %s", name, error)
        return [_UNKNOWN]


def _shape(
    header: Any, name: str, number: int, visual: Visual, T_world_base: Array, tint: Any
) -> Any:
    marker = Marker(header=header, ns=f"{name}/shape", id=number, type=_KINDS[visual.kind])
    marker.pose = _pose(T_world_base @ visual.T_base_shape)
    marker.scale = Vector3(*visual.scale)
    if visual.kind == MESH:
        marker.mesh_resource = visual.resource
        marker.mesh_use_embedded_materials = visual.color is None
    else:
        marker.color = tint
    if visual.color is not None:
        marker.color = ColorRGBA(*visual.color)
    return marker


def _label(header: Any, name: str, pose: Any) -> Any:
    marker = Marker(header=header, ns=f"{name}/name", type=Marker.TEXT_VIEW_FACING, text=name)
    at = pose.position
    marker.pose = Pose(Point(at.x, at.y, at.z + _LABEL_ABOVE_M), Quaternion(w=1.0))
    marker.scale.z = _LABEL_HEIGHT_M
    marker.color = ColorRGBA(0.1, 0.1, 0.1, 1.0)
    return marker


def _path(header: Any, name: str, points: list[Point], tint: Any) -> Any:
    marker = Marker(header=header, ns=f"{name}/path", type=Marker.LINE_STRIP, points=points)
    marker.pose.orientation.w = 1.0
    marker.scale.x = _PATH_WIDTH_M
    marker.color = tint
    return marker


def _tint(index: int) -> Any:
    text = color(index).lstrip("#")
    red, green, blue = (int(text[at : at + 2], 16) / 255.0 for at in (0, 2, 4))
    return ColorRGBA(red, green, blue, 1.0)


def _distance(a: Any, b: Any) -> float:
    return float(np.hypot(np.hypot(a.x - b.x, a.y - b.y), a.z - b.z))


def _matrix(pose: Any) -> Array:
    """T of a pose, shape (4, 4)."""
    q, p = pose.orientation, pose.position
    x, y, z, w = np.array([q.x, q.y, q.z, q.w]) / np.linalg.norm([q.x, q.y, q.z, q.w])
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), p.x],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), p.y],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), p.z],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )


def _pose(T: Array) -> Any:
    """The pose of T, shape (4, 4): the unit quaternion is the eigenvector that fits R best."""
    R = T[:3, :3]
    k = np.array(
        [
            [R[0, 0] - R[1, 1] - R[2, 2], 0.0, 0.0, 0.0],
            [R[0, 1] + R[1, 0], R[1, 1] - R[0, 0] - R[2, 2], 0.0, 0.0],
            [R[0, 2] + R[2, 0], R[1, 2] + R[2, 1], R[2, 2] - R[0, 0] - R[1, 1], 0.0],
            [R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1], np.trace(R)],
        ]
    )
    _, vectors = np.linalg.eigh(k)  # it reads the lower triangle
    return Pose(Point(*T[:3, 3]), Quaternion(*vectors[:, -1]))


def main() -> int:
    """Run until ROS ends."""
    init_node("fleet_markers", anonymous=True)
    fleet = FleetMarkers()
    refusals = Refusals()
    publisher = rospy.Publisher("/fleet_markers", MarkerArray, queue_size=1, latch=True)

    def on_state(state: FleetState) -> None:
        problem = state_problem(state)
        if problem:
            refusals.note("fleet_state refused", f"fleet_state refused: {problem}")
        else:
            fleet.add(state)

    rospy.Subscriber("/gazebo/fleet_state", FleetState, on_state, queue_size=None)
    while not rospy.is_shutdown():
        markers = fleet.markers()
        if markers is not None:
            publisher.publish(markers)
        rospy.rostime.wallsleep(_PERIOD_S)  # the simulated clock may stand
    return 0
