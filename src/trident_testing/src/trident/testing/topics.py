# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What arrives on a topic, and set-points that are known to have arrived."""

from __future__ import annotations

import threading
import xmlrpc.client
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import rospy
from geometry_msgs.msg import PoseStamped
from std_msgs.msg import Header

from trident.testing.models import pose
from trident.testing.waiting import LIMIT_S, eventually


def _sends_to(publisher_uri: str, subscriber: str, topic: str) -> bool:
    """Whether the node of that address has a subscriber among those that it sends a topic to.

    A node counts itself connected as soon as it is answered, and rospy's publishers add it a
    moment later: what is published in between is lost.
    """
    try:
        node: Any = xmlrpc.client.ServerProxy(publisher_uri)
        _, _, links = node.getBusInfo(subscriber)
    except (OSError, xmlrpc.client.Error):
        return False  # it has gone
    return any(link[4] == topic and link[2] == "o" and link[1] == subscriber for link in links)


class Recorder:
    """Messages of a topic, in the order of their arrival.

    Attributes:
        topic: its full name.
        messages: those that have arrived.
    """

    def __init__(self, topic: str, message_type: Any, queue_size: int | None = None) -> None:
        """Subscribe.

        Args:
            topic: its full name.
            message_type: of its messages.
            queue_size: of the subscriber; None: nothing is dropped.
        """
        self.topic = topic
        self.messages: list[Any] = []
        self._subscriber = rospy.Subscriber(
            topic, message_type, self.messages.append, queue_size=queue_size, tcp_nodelay=True
        )

    def connected(self, publishers: int = 1) -> Recorder:
        """Return when so many publishers are connected, and know it."""
        own, topic = rospy.get_name(), self._subscriber.resolved_name

        def are_connected() -> bool:
            senders = [link.endpoint_id for link in self._subscriber.impl.connections]
            if len(senders) < publishers:
                return False
            return sum(_sends_to(sender, own, topic) for sender in senders) >= publishers

        eventually(are_connected, f"a publisher of {self.topic}")
        return self

    def received(self, count: int = 1, limit_s: float = LIMIT_S) -> list[Any]:
        """The messages, once there are `count`."""
        eventually(
            lambda: len(self.messages) >= count, f"{count} messages on {self.topic}", limit_s
        )
        return self.messages

    def close(self) -> None:
        """Unsubscribe."""
        self._subscriber.unregister()


@contextmanager
def recorder(
    topic: str, message_type: Any, publishers: int = 1, **options: Any
) -> Iterator[Recorder]:
    """A recorder, connected to so many publishers, that ends with the block.

    The other options are those of `Recorder`.
    """
    result = Recorder(topic, message_type, **options)
    try:
        yield result.connected(publishers)
    finally:
        result.close()


class Pilot:
    """Gives set-points to controllers, and knows when they have them.

    Attributes:
        vehicles: their namespaces.
    """

    def __init__(
        self, vehicles: Sequence[str], node: str = "/{}/lee_position_controller_node"
    ) -> None:
        """Advertise and subscribe.

        Args:
            vehicles: their namespaces, e.g. UAV1.
            node: name of a controller's node, {} standing for the vehicle; of nodelets, their
                manager's.
        """
        self.vehicles = list(vehicles)
        self._node = node
        self._accepted: dict[str, set[int]] = {name: set() for name in vehicles}
        self._lock = threading.Lock()
        self._publishers = {
            name: rospy.Publisher(f"/{name}/command/pose", PoseStamped, queue_size=1000)
            for name in vehicles
        }
        self._subscribers = [
            rospy.Subscriber(f"/{name}/command/accepted_setpoint", Header, self._on_accepted, name)
            for name in vehicles
        ]

    def _on_accepted(self, header: Header, vehicle: str) -> None:
        with self._lock:
            self._accepted[vehicle].add(header.stamp.to_nsec())

    def connected(self, vehicle: str) -> Pilot:
        """Return when the controller of `vehicle` listens, and is heard."""
        index = self.vehicles.index(vehicle)
        controller = self._node.format(vehicle)

        def is_connected() -> bool:
            listeners = {link.endpoint_id for link in self._publishers[vehicle].impl.connections}
            # Not just anybody: the connection to one that has ended may still be there.
            speakers = {link.callerid_pub for link in self._subscribers[index].impl.connections}
            return controller in listeners and controller in speakers

        eventually(is_connected, f"a controller of {vehicle} that takes set-points")
        return self

    def send(self, vehicle: str, x: float, y: float, z: float, stamp_s: float) -> None:
        """Send a set-point, and return when the controller has confirmed it.

        Args:
            vehicle: its namespace.
            x: of the point in the world [m].
            y: of the point in the world [m].
            z: of the point in the world [m].
            stamp_s: simulated time from which on it holds, > 0 [s].
        """
        message = PoseStamped(pose=pose(x, y, z))
        message.header.stamp = rospy.Time.from_sec(stamp_s)
        message.header.frame_id = "world"
        stamp = message.header.stamp.to_nsec()
        with self._lock:
            self._accepted[vehicle].discard(stamp)
        self.connected(vehicle)
        self._publishers[vehicle].publish(message)
        eventually(
            lambda: stamp in self._accepted[vehicle],
            f"{vehicle}'s controller confirms the set-point of {stamp_s} s",
        )

    def close(self) -> None:
        """End its topics."""
        for publisher in self._publishers.values():
            publisher.unregister()
        for subscriber in self._subscribers:
            subscriber.unregister()


@contextmanager
def pilot_of(*vehicles: str, **options: str) -> Iterator[Pilot]:
    """A pilot whose topics end with the block; options as those of `Pilot`."""
    pilot = Pilot(vehicles, **options)
    try:
        yield pilot
    finally:
        pilot.close()
