# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Messages that a node refuses: logged every few seconds at most, counted in /diagnostics."""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

_LOG_EVERY_S = 5.0
_PUBLISH_EVERY_S = 0.5


@dataclass
class _Kind:
    newest: str = ""
    count: int = 0
    logged: int = 0
    logged_at: float = 0.0


class Refusals:
    """By kind; from any thread."""

    def __init__(self) -> None:
        """To be made after rospy.init_node()."""
        self._lock = threading.Lock()
        self._kinds: dict[str, _Kind] = {}
        self._published_at = 0.0
        self._publisher = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=10)

    def note(self, kind: str, text: str) -> None:
        """Counts one, and logs it at once or together with a later one.

        Args:
            kind: what was refused, without numbers.
            text: why, with the value and what is legal.
        """
        with self._lock:
            now = time.monotonic()
            known = self._kinds.setdefault(kind, _Kind())
            known.newest, known.count = text, known.count + 1
            if not known.logged or now - known.logged_at >= _LOG_EVERY_S:
                more = known.count - known.logged - 1
                rospy.logerr("%s%s", text, f" (and {more} before it)" if more else "")
                known.logged, known.logged_at = known.count, now
            if now - self._published_at >= _PUBLISH_EVERY_S:
                self._published_at = now
                self._publish()

    def _publish(self) -> None:
        array = DiagnosticArray()
        array.header.stamp = rospy.Time.now()
        for kind, known in self._kinds.items():
            name = f"{rospy.get_name().lstrip('/')}: {kind}"
            values = [KeyValue("count", str(known.count))]
            array.status.append(
                DiagnosticStatus(DiagnosticStatus.WARN, name, known.newest, "none", values)
            )
        try:
            self._publisher.publish(array)
        except rospy.ROSException:
            # Topics close when rospy begins to shut down.
            if not rospy.core.is_shutdown_requested():
                raise
