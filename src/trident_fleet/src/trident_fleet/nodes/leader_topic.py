# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A leader's odometry or pose from a live topic, whatever its type."""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any

import numpy as np
import rosgraph
import roslib.message
import rospy
from geometry_msgs.msg import Pose, Quaternion, Twist

from trident_fleet.core.encoding import NS_PER_S
from trident_fleet.core.errors import FormationError
from trident_fleet.core.follow.leader import Decoder, Measurement, rotate, yaw_of
from trident_fleet.core.quintic import Array
from trident_fleet.nodes.world_link import SIMULATOR
from trident_ros import Refusals, stamp_problem

FLEET_STATE = SIMULATOR + "/fleet_state"

Reader = Callable[[Any, str], Measurement | None]
"""Takes a message and the leader's name; None if the message does not contain it."""

MessageCallback = Callable[[int, Decoder], None]
"""Takes a message's stamp [ns], and a function that returns what it reports of the leader."""

# Sequence number, seconds and nanoseconds of a header, which all these messages begin with.
_STAMP = struct.Struct("<III")


class LeaderTopic:
    """Calls back with each message about a leader.

    Attributes:
        name: of the topic.
        is_simulated: whether its stamps are simulated time, and the simulator sends it without a
            gap; so it is taken for the fleet state and for what lies below the leader's name.
    """

    def __init__(self, topic: str, leader: str) -> None:
        """Subscribe to nothing yet.

        Args:
            topic: its name; "": the simulator's fleet state.
            leader: the leader's name.
        """
        self.name = rospy.resolve_name(topic) if topic else FLEET_STATE
        self.is_simulated = self.name.startswith((FLEET_STATE, f"/{leader}/"))
        self._leader = leader
        self._subscriber: rospy.Subscriber | None = None
        self._refusals: Refusals | None = None  # made when there is one

    def try_subscribe(self, callback: MessageCallback) -> bool:
        """Subscribe if the topic is there; its type decides how it is read.

        Raises:
            FormationError: the topic is of another type.
        """
        if self._subscriber is None:
            type_name = _type_of(self.name)
            if type_name is None:
                return False
            if type_name not in _READERS:
                raise FormationError(
                    f"leader_topic: {self.name} is a {type_name}; legal: {', '.join(_READERS)}"
                )
            self._subscriber = self._subscribed(type_name, callback)
        return True

    def _subscribed(self, type_name: str, callback: MessageCallback) -> rospy.Subscriber:
        message_class, reader = roslib.message.get_message_class(type_name), _READERS[type_name]

        def on_message(message: Any) -> None:
            if not self._is_refused(message.header.stamp):
                stamp_ns = message.header.stamp.to_nsec()
                callback(stamp_ns, lambda: reader(message, self._leader))

        def on_raw(message: rospy.AnyMsg) -> None:
            _, seconds, nanoseconds = _STAMP.unpack_from(message._buff)
            stamp = rospy.Time()
            stamp.secs, stamp.nsecs = seconds, nanoseconds  # as on the wire
            if self._is_refused(stamp):
                return
            raw = message._buff
            callback(
                seconds * NS_PER_S + nanoseconds,
                lambda: reader(message_class().deserialize(raw), self._leader),
            )

        if self.name == FLEET_STATE:
            # Whose subscription this node has already, decoded.
            return rospy.Subscriber(self.name, message_class, on_message, tcp_nodelay=True)
        # Of a hundred messages a second, ten count.
        return rospy.Subscriber(self.name, rospy.AnyMsg, on_raw, tcp_nodelay=True)

    def _is_refused(self, stamp: rospy.Time) -> bool:
        problem = stamp_problem(stamp)
        if problem:
            self.refuse(problem)
        return bool(problem)

    def refuse(self, problem: str) -> None:
        """Report a message that is not used, and count it."""
        if self._refusals is None:
            self._refusals = Refusals()
        self._refusals.note("leader refused", f"{self.name} refused: {problem}")

    @property
    def has_publisher(self) -> bool:
        """Whether somebody is connected."""
        return self._subscriber is not None and self._subscriber.get_num_connections() > 0

    @property
    def is_of_simulator(self) -> bool:
        """Whether the simulator itself is connected as its publisher."""
        if self._subscriber is None:
            return False
        links = self._subscriber.impl.connections
        return any(link.callerid_pub == SIMULATOR for link in links)

    def close(self) -> None:
        """Hear no more."""
        if self._subscriber is not None:
            self._subscriber.unregister()


def _type_of(topic: str) -> str | None:
    for name, type_name in rosgraph.Master(rospy.get_name()).getTopicTypes():
        if name == topic and type_name != "*":
            return str(type_name)
    return None


def _read_fleet(state: Any, leader: str) -> Measurement | None:
    if leader not in state.name or not len(state.name) == len(state.pose) == len(state.twist):
        return None
    index = state.name.index(leader)
    pose, twist = state.pose[index], state.twist[index]
    return _measured(state.header, pose, _vector(twist.linear), twist.angular.z)


def _read_odometry(message: Any, _leader: str) -> Measurement:
    pose, twist = message.pose.pose, message.twist.twist
    return _measured(message.header, pose, *_in_world(pose.orientation, twist))


def _in_world(orientation: Quaternion, twist: Twist) -> tuple[Array, float]:
    """An odometry's twist is in its child frame."""
    quaternion = _quaternion(orientation)
    turn = rotate(quaternion, _vector(twist.angular))
    return rotate(quaternion, _vector(twist.linear)), float(turn[2])


def _read_pose(message: Any, _leader: str) -> Measurement:
    return _measured(message.header, message.pose)


def _read_pose_with_covariance(message: Any, _leader: str) -> Measurement:
    return _measured(message.header, message.pose.pose)


def _read_transform(message: Any, _leader: str) -> Measurement:
    transform = message.transform
    return _measured(message.header, Pose(transform.translation, transform.rotation))


_READERS: dict[str, Reader] = {
    "trident_msgs/FleetState": _read_fleet,
    "nav_msgs/Odometry": _read_odometry,
    "geometry_msgs/PoseStamped": _read_pose,
    "geometry_msgs/PoseWithCovarianceStamped": _read_pose_with_covariance,
    "geometry_msgs/TransformStamped": _read_transform,
}


def _measured(
    header: Any, pose: Pose, velocity: Array | None = None, yaw_rate: float | None = None
) -> Measurement:
    return Measurement(
        stamp_ns=header.stamp.to_nsec(),
        position=_vector(pose.position),
        yaw_rad=yaw_of(_quaternion(pose.orientation)),
        velocity=velocity,
        yaw_rate=yaw_rate,
    )


def _vector(message: Any) -> Array:
    return np.array([message.x, message.y, message.z])


def _quaternion(message: Quaternion) -> tuple[float, float, float, float]:
    return message.x, message.y, message.z, message.w
