# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A running node, and what it listens to, as the master knows them."""

from __future__ import annotations

import os
import time
import xmlrpc.client
from collections.abc import Iterable
from contextlib import suppress
from fnmatch import fnmatch
from pathlib import Path
from typing import Any

import genpy
import roslib.message
import rospy
import rosservice
from rosgraph import Master

#: Of roscpp and rospy themselves, not of a node.
_OF_ROS = ("*/get_loggers", "*/set_logger_level")
_UNHEARD = ("/rosout", "/rosout_agg")
_IDLE_LIMIT_S = 0.25


class Target:
    """A node of the running system.

    Attributes:
        name: its full name.
        pid: of its process.
    """

    def __init__(self, name: str, skip: Iterable[str] = ()) -> None:
        """Find it.

        Args:
            name: its full name.
            skip: patterns (fnmatch) of topics and services that are left alone.

        Raises:
            LookupError: the master knows no such node, or it does not answer.
        """
        self.name = name
        self._skip = (*_OF_ROS, *skip)
        self._master = Master(rospy.get_name())
        try:
            self._uri = self._master.lookupNode(name)
            node: Any = xmlrpc.client.ServerProxy(self._uri)
            self.pid: int = node.getPid(rospy.get_name())[2]
        except (OSError, xmlrpc.client.Error, Exception) as error:
            raise LookupError(f"node {name}: {error}") from error

    def subscriptions(self) -> dict[str, type[genpy.Message]]:
        """Topics that it subscribes to, and the types of their messages."""
        _, subscribers, _ = self._master.getSystemState()
        return self._typed(subscribers)

    def publications(self) -> dict[str, type[genpy.Message]]:
        """Topics that it publishes, and the types of their messages."""
        publishers, _, _ = self._master.getSystemState()
        return self._typed(publishers)

    def _typed(self, topics: list[tuple[str, list[str]]]) -> dict[str, type[genpy.Message]]:
        types = dict(self._master.getTopicTypes())
        found = {}
        for topic, nodes in topics:
            if self.name not in nodes or topic in _UNHEARD or self._is_skipped(topic):
                continue
            kind = roslib.message.get_message_class(types.get(topic, "*"))
            if kind is not None:
                found[topic] = kind
        return found

    def services(self) -> dict[str, Any]:
        """Services that it offers, and their classes."""
        _, _, services = self._master.getSystemState()
        found = {}
        for service, nodes in services:
            if self.name in nodes and not self._is_skipped(service):
                with suppress(rosservice.ROSServiceException):  # it has gone meanwhile
                    found[service] = rosservice.get_service_class_by_name(service)
        return found

    def _is_skipped(self, name: str) -> bool:
        return any(fnmatch(name, pattern) for pattern in self._skip)

    @property
    def is_alive(self) -> bool:
        """Whether its process has not ended."""
        try:
            state = Path(f"/proc/{self.pid}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1]
        except OSError:
            return False
        return state.split()[0] not in "ZX"

    @property
    def memory_mib(self) -> float:
        """Resident memory."""
        try:
            pages = int(Path(f"/proc/{self.pid}/statm").read_text(encoding="utf-8").split()[1])
        except OSError:
            return 0.0
        return pages * os.sysconf("SC_PAGE_SIZE") / 2**20

    def settle(self) -> None:
        """Return when all of its threads sleep, or soon: so that it has read what was sent."""
        deadline = time.monotonic() + _IDLE_LIMIT_S
        while not self._is_idle() and time.monotonic() < deadline:
            time.sleep(0.0005)

    def _is_idle(self) -> bool:
        try:
            for task in os.listdir(f"/proc/{self.pid}/task"):
                with open(f"/proc/{self.pid}/task/{task}/stat", "rb") as file:
                    if file.read().rsplit(b")", 1)[1][1:2] != b"S":
                        return False
        except OSError:
            return not self.is_alive
        return True
