# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""checkid: whether the vehicle that the node is for is among those that its link carries."""

from __future__ import annotations

import argparse
import threading
import time
from collections import defaultdict

import rospy
from mavros_msgs.msg import Mavlink

import mavros
from mavros.tool import ToolError, run

_PERIOD_S = 15.0
_DEFAULT_ID = 1

Source = tuple[int, int]


class Sources:
    """Which messages came from whom."""

    def __init__(self) -> None:
        """Nothing has come."""
        self._lock = threading.Lock()
        self._ids: dict[Source, set[int]] = defaultdict(set)
        self._count = 0

    def take(self, message: Mavlink) -> None:
        """Count a message."""
        with self._lock:
            self._ids[(message.sysid, message.compid)].add(message.msgid)
            self._count += 1

    def has(self, source: Source) -> bool:
        """Whether something came from there."""
        with self._lock:
            return source in self._ids

    def report(self, target: Source) -> str:
        """What a user is to read.

        Args:
            target: system and component id of the vehicle.
        """
        with self._lock:
            address = f"{target[0]}:{target[1]}"
            lines = [
                f"OK. Messages come from {address}."
                if target in self._ids
                else f"ERROR. Messages come from {len(self._ids)} addresses, none from {address}.",
                f"Received {self._count} messages, from {len(self._ids)} addresses",
                "sys:comp   list of messages",
            ]
            for (system, component), ids in sorted(self._ids.items()):
                names = ", ".join(str(number) for number in sorted(ids))
                lines.append(f"{system:3}:{component:<3}    {names}")
        return "\n".join(lines)


def _target() -> Source:
    ids = []
    for name in ("target_system_id", "target_component_id"):
        key = mavros.get_topic(name)
        if not rospy.has_param(key):
            print(f"NOTE: {key} is not set, so it is {_DEFAULT_ID}: is the name of the node right?")
        ids.append(int(rospy.get_param(key, _DEFAULT_ID)))
    return ids[0], ids[1]


def _check(a: argparse.Namespace) -> None:
    target = _target()
    sources = Sources()
    rospy.Subscriber("mavlink/from", Mavlink, sources.take, queue_size=100)
    while not rospy.is_shutdown():
        end_s = time.monotonic() + a.period
        while time.monotonic() < end_s and not rospy.is_shutdown():
            time.sleep(min(0.1, a.period))
        print(sources.report(target), flush=True)
        if not a.follow:
            break
    if not sources.has(target):
        raise ToolError(f"nothing comes from {target[0]}:{target[1]}")


def main() -> int:
    """Run the tool."""
    parser = argparse.ArgumentParser(
        description="Lists who speaks on mavlink/from, and whether the node's vehicle does."
    )
    parser.add_argument(
        "-n", "--mavros-ns", default=f"/{mavros.DEFAULT_NAMESPACE}", help="name of mavros_node"
    )
    parser.add_argument("-f", "--follow", action="store_true", help="report again and again")
    parser.add_argument(
        "--period", type=float, default=_PERIOD_S, help="wall time between two reports [s]"
    )
    parser.set_defaults(handler=_check, wait=False)
    return run(parser)
