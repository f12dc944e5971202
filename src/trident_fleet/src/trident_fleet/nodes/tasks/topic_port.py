# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""ROS topics as the network of a team: common ones, or those that a relay carries."""

from __future__ import annotations

import threading
from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

import rospy

import trident_msgs.msg as ros
from trident_fleet.core.network import EVERYBODY, Envelope
from trident_fleet.core.tasks.fields import TaskError
from trident_fleet.core.tasks.messages import TaskMessage
from trident_fleet.nodes.tasks.conversion import from_ros, to_ros
from trident_ros import Refusals, quoted

TOPICS = {
    ros.TaskAnnounce: "task_announce",
    ros.TaskBid: "bid_submit",
    ros.TaskAward: "task_award",
    ros.TaskConfirm: "task_confirm",
    ros.TaskProgress: "task_progress",
    ros.TaskTable: "task_table",
}
_QUEUE = 100  # messages, as a table may come in the moment in which all robots bid


@dataclass(frozen=True)
class Wiring:
    """Where a member says and hears.

    Attributes:
        out: before the names of topics that it publishes.
        heard: before those that it subscribes, with the member that is heard there; None: all of
            them, who is in the header.
    """

    out: str
    heard: tuple[tuple[str, str | None], ...]

    @staticmethod
    def common(namespace: str) -> Wiring:
        """All members on the same topics, in the team's namespace."""
        prefix = "/" + f"{namespace.strip('/')}/".lstrip("/")
        return Wiring(prefix, ((prefix, None),))

    @staticmethod
    def relayed(name: str, others: Collection[str]) -> Wiring:
        """Each member in its own namespace; topic T of A is heard by B as /B/from/A/T."""
        heard = tuple((f"/{name}/from/{other}/", other) for other in sorted(others))
        return Wiring(f"/{name}/", heard)


class TopicPort:
    """A member's `Port` on topics. Everybody hears everything: a destination is not looked at.

    Messages come in threads of rospy and wait for `receive`.
    """

    def __init__(
        self, name: str, members: Collection[str], frame: str, wiring: Wiring, refusals: Refusals
    ) -> None:
        """Advertise and subscribe, after rospy.init_node().

        Args:
            name: of this member.
            members: names of all.
            frame: of places.
            wiring: where it says and hears.
            refusals: where bad messages are counted.
        """
        self.name, self._members, self._frame = name, frozenset(members), frame
        self._refusals = refusals
        self._lock = threading.Lock()
        self._inbox: list[Envelope[TaskMessage]] = []
        self._publishers = {
            kind: rospy.Publisher(wiring.out + topic, kind, queue_size=_QUEUE, tcp_nodelay=True)
            for kind, topic in TOPICS.items()
        }
        self._subscribers = [
            rospy.Subscriber(
                prefix + topic, kind, self._take, (prefix + topic, source), tcp_nodelay=True
            )
            for prefix, source in wiring.heard
            for kind, topic in TOPICS.items()
        ]

    def now(self) -> float:
        """Simulated time [s]."""
        return float(rospy.get_time())

    def send(self, message: TaskMessage, destination: str = EVERYBODY) -> None:
        """Publish a message."""
        made = to_ros(message, self.name, self._frame)
        try:
            self._publishers[type(made)].publish(made)
        except rospy.ROSSerializationException as error:
            # A number that its field cannot hold: an epoch that somebody has driven up.
            self._refusals.note("message not sent", f"{type(made).__name__} not sent: {error}")
        except rospy.ROSException:
            # Topics close when rospy begins to shut down.
            if not rospy.core.is_shutdown_requested():
                raise

    def receive(self) -> list[Envelope[TaskMessage]]:
        """What has come since the last call, in the order of arrival."""
        with self._lock:
            inbox, self._inbox = self._inbox, []
        return inbox

    def _take(self, message: Any, where: tuple[str, str | None]) -> None:
        topic, source = where
        try:
            read = from_ros(message, self._frame)
            sender = source or self._sender(message)
        except TaskError as error:
            self._refusals.note(f"{topic} refused", f"{topic} refused: {error}")
            return
        if sender == self.name:
            return
        with self._lock:
            self._inbox.append(Envelope(sender, read, read.stamp_s))

    def _sender(self, message: Any) -> str:
        """Who says that it has sent a message; a user's request may come from anybody."""
        sender = str(message.header.frame_id)
        is_request = isinstance(message, ros.TaskAnnounce) and message.round == 0
        is_cancel = isinstance(message, ros.TaskProgress) and not message.robot_id
        if sender in self._members or is_request or is_cancel:
            return sender
        legal = ", ".join(sorted(self._members))
        raise TaskError(f"header.frame_id is {quoted(sender)!r}, legal: {legal}, who sent it")
