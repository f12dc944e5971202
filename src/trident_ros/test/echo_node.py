#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Sends back what it gets on ``question``, on ``answer``.

"reconnect" makes it publish again, "process" makes it send its process id.
"""

from __future__ import annotations

import os

import rospy
from std_msgs.msg import String


class Echo:
    """The node."""

    def __init__(self) -> None:
        self.answer = self.advertise()
        rospy.Subscriber("question", String, self.on_question, queue_size=None, tcp_nodelay=True)

    @staticmethod
    def advertise() -> rospy.Publisher:
        """A publisher that never drops."""
        return rospy.Publisher("answer", String, queue_size=0, tcp_nodelay=True)

    def on_question(self, message: String) -> None:
        """One answer per question."""
        if message.data == "reconnect":
            self.answer.unregister()
            self.answer = self.advertise()
        elif message.data == "process":
            self.answer.publish(String(str(os.getpid())))
        else:
            self.answer.publish(message)


rospy.init_node("echo")
Echo()
rospy.spin()
