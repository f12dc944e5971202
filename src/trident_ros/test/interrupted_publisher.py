#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Publishes on ``count`` in the main thread, and is interrupted while it holds a lock there."""

from __future__ import annotations

import signal
from typing import Any

import rospy
from std_msgs.msg import UInt32

from trident_ros import init_node


class Interrupting(list[Any]):
    """What a connection has to send; its lock is held while something is added."""

    def append(self, data: Any) -> None:
        """SIGINT arrives here."""
        signal.raise_signal(signal.SIGINT)
        super().append(data)


init_node("interrupted_publisher")
publisher = rospy.Publisher("count", UInt32, queue_size=10)
while not publisher.impl.connections:
    rospy.rostime.wallsleep(0.01)
for connection in publisher.impl.connections:
    connection._queue = Interrupting()
while not rospy.is_shutdown():
    publisher.publish(1)
    rospy.rostime.wallsleep(0.01)
