# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A leader's odometry or pose from a live topic, whatever its type."""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any

import rosgraph
import roslib.message
import rospy

from trident_fleet.core.encoding import NS_PER_S
from trident_fleet.core.errors import FormationError
from trident_fleet.core.follow.leader import Decoder
from trident_fleet.nodes.pose_readers import READERS
from trident_fleet.nodes.world_link import SIMULATOR
from trident_ros import Refusals, stamp_problem

FLEET_STATE = SIMULATOR + "/fleet_state"

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
            if type_name not in READERS:
                raise FormationError(
                    f"leader_topic: {self.name} is a {type_name}; legal: {', '.join(READERS)}"
                )
            self._subscriber = self._subscribed(type_name, callback)
        return True

    def _subscribed(self, type_name: str, callback: MessageCallback) -> rospy.Subscriber:
        message_class, reader = roslib.message.get_message_class(type_name), READERS[type_name]

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
