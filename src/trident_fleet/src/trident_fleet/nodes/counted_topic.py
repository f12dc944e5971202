# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The messages of a topic of any type, in their order, of which one by number is read."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import genpy
import roslib.message
import rospy

from trident_fleet.nodes.world_link import foreign_problem
from trident_ros import Refusals, quoted

_KEPT = 1000


@dataclass(frozen=True)
class News:
    """What is done with messages, in threads of rospy.

    Attributes:
        lock: under which they are taken.
        take: called with each of them, under the lock.
    """

    lock: threading.RLock
    take: Callable[[], None]


class CountedTopic:
    """Counts what comes, and decodes only what is asked for.

    Attributes:
        name: of the topic, resolved.
        count: messages that have come, or were given up.
    """

    def __init__(self, name: str, only_simulator: bool, news: News) -> None:
        """Subscribe.

        Args:
            name: of the topic.
            only_simulator: messages of other publishers are refused.
            news: called with each message.
        """
        self.count = 0
        self._only_simulator, self._news = only_simulator, news
        self._newest: deque[rospy.AnyMsg] = deque(maxlen=_KEPT)
        self._refusals: Refusals | None = None  # made when there is one
        self._subscriber = rospy.Subscriber(name, rospy.AnyMsg, self._take, tcp_nodelay=True)
        self.name = str(self._subscriber.resolved_name)

    @property
    def subscriber(self) -> rospy.Subscriber:
        """For who waits until it is connected."""
        return self._subscriber

    def _take(self, message: rospy.AnyMsg) -> None:
        problem = foreign_problem(message) if self._only_simulator else ""
        if problem:
            self.refuse(problem)
            return
        with self._news.lock:
            self._newest.append(message)
            self.count += 1
            self._news.take()

    def give_up_to(self, count: int) -> None:
        """Count those that have not come as if they had."""
        self.count = max(self.count, count)

    def message(self, number: int) -> Any | None:
        """The message of a number, counted from 1; None: it has not come, or cannot be read.

        What came before it is forgotten.
        """
        age = self.count - number
        if number < 1 or not 0 <= age < len(self._newest):
            return None
        raw = self._newest[len(self._newest) - 1 - age]
        while len(self._newest) > age + 1:
            self._newest.popleft()
        return self._decoded(raw)

    def _decoded(self, raw: rospy.AnyMsg) -> Any | None:
        type_name = str(raw._connection_header["type"])
        message_class = roslib.message.get_message_class(type_name)
        if message_class is None:
            self.refuse(f"{quoted(type_name)} is not known, legal: a type of an installed package")
            return None
        try:
            return message_class().deserialize(raw._buff)
        except genpy.DeserializationError as error:
            self.refuse(f"no {quoted(type_name)}: {quoted(str(error))}")
            return None

    def refuse(self, problem: str) -> None:
        """Report a message that is not used, and count it."""
        if self._refusals is None:
            self._refusals = Refusals()
        self._refusals.note(f"{self.name} refused", f"{self.name} refused: {problem}")

    def close(self) -> None:
        """Hear no more."""
        self._subscriber.unregister()
