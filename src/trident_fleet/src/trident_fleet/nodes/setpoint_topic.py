# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`command/trajectory` of one vehicle, fed with serialised messages."""

from __future__ import annotations

import threading
import time
import warnings
from collections import deque
from collections.abc import Callable

import rospy
from trajectory_msgs.msg import MultiDOFJointTrajectory

_POLL_S = 0.02

Publish = Callable[[rospy.AnyMsg], None]


class SetpointTopic(rospy.SubscribeListener):  # type: ignore[misc]
    """Publishes serialised set-points; who connects late gets those that still matter.

    The simulator is served last: when it learns that a set-point is there and steps, the
    controllers already have it.
    """

    def __init__(self, prefix: str, keep: int, simulator: str = "/gazebo") -> None:
        """Advertise `<prefix>command/trajectory`.

        Args:
            prefix: of the vehicle's topics, e.g. `/UAV1/`.
            keep: how many of the newest messages a late subscriber gets.
            simulator: node name of the simulator.
        """
        super().__init__()
        self.topic = prefix + "command/trajectory"
        self._prefix = prefix
        self._simulator = simulator
        self._lock = threading.Lock()
        self._recent: deque[bytes] = deque(maxlen=keep)
        with warnings.catch_warnings():
            # Without a queue, messages go out in the calling thread and in order.
            warnings.simplefilter("ignore")
            self._publisher = rospy.Publisher(
                self.topic,
                MultiDOFJointTrajectory,
                subscriber_listener=self,
                tcp_nodelay=True,
                queue_size=None,
            )
        self._foreign: rospy.Subscriber | None = None

    def publish(self, message: bytes) -> None:
        """Send one serialised message to all subscribers."""
        with self._lock:
            self._recent.append(message)
            self._send(message)

    def repeat(self) -> None:
        """Send the recent messages again: the first ones may have got lost as peers connected."""
        with self._lock:
            for recent in self._recent:
                self._send(recent)

    def forget(self) -> None:
        """Late subscribers no longer get what was sent so far."""
        with self._lock:
            self._recent.clear()

    def guard(self) -> None:
        """From now on, send the recent messages again when another node has sent a command.

        Once for each command, also if this is called again, for a flight that starts over.
        """
        if self._foreign is None:
            self._foreign = rospy.Subscriber(
                self.topic, rospy.AnyMsg, self._on_command, tcp_nodelay=True
            )

    def wait_for_controller(self, limit_s: float) -> bool:
        """Wait until the vehicle's controller, a node in its namespace, has connected.

        Args:
            limit_s: longest wait, in wall-clock time [s].

        Returns:
            Whether it has.
        """
        give_up = time.monotonic() + limit_s
        while time.monotonic() < give_up and not rospy.is_shutdown():
            peers = {connection.endpoint_id for connection in self._publisher.impl.connections}
            if any(peer.startswith(self._prefix) for peer in peers):
                return True
            time.sleep(_POLL_S)
        return False

    @property
    def has_listener(self) -> bool:
        """Whether anybody has connected, be it the controller or not."""
        return bool(self._publisher.impl.connections)

    def peer_subscribe(
        self, topic_name: str, topic_publish: Publish, peer_publish: Publish
    ) -> None:
        """A subscriber has come (called by rospy, in its thread)."""
        with self._lock:
            self._serve_simulator_last()
            for message in self._recent:
                peer_publish(_raw(message))

    def _serve_simulator_last(self) -> None:
        topic = self._publisher.impl
        with topic.c_lock:
            topic.connections = sorted(
                topic.connections, key=lambda peer: peer.endpoint_id == self._simulator
            )

    def _on_command(self, message: rospy.AnyMsg) -> None:
        if message._connection_header["callerid"] == rospy.get_name():
            return
        self.repeat()

    def _send(self, message: bytes) -> None:
        try:
            self._publisher.publish(_raw(message))
        except rospy.ROSException:
            # Topics close when rospy begins to shut down, before is_shutdown() reports it.
            if not rospy.core.is_shutdown_requested():
                raise


def _raw(message: bytes) -> rospy.AnyMsg:
    raw = rospy.AnyMsg()
    raw._buff = message
    return raw
