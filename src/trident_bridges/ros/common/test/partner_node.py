#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The other end of node_poll_loop_check.

Sends back what it gets on ``question``, on ``answer``, and the header's number of what it gets on
``numbered``, on ``numbers``; is the air between the radios of a and b, and the source of /clock:
one simulated second each 10 ms.
"""

from __future__ import annotations

import threading

import rospy
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String, UInt32

from trident_msgs.msg import RadioPacket, WindReading

rospy.init_node("partner")
answer = rospy.Publisher("answer", String, queue_size=0, tcp_nodelay=True)
numbers = rospy.Publisher("numbers", UInt32, queue_size=0, tcp_nodelay=True)
clock = rospy.Publisher("/clock", Clock, queue_size=1, tcp_nodelay=True)
rospy.Subscriber("question", String, answer.publish, tcp_nodelay=True)
rospy.Subscriber(
    "numbered",
    WindReading,
    lambda message: numbers.publish(UInt32(message.header.seq)),
    tcp_nodelay=True,
)


def carry(packet: RadioPacket, hop: tuple[str, rospy.Publisher]) -> None:
    """A packet of one radio reaches the other, which learns who sent it."""
    source, receiver = hop
    packet.source = source
    receiver.publish(packet)


for source, receiver in (("a", "b"), ("b", "a")):
    heard = rospy.Publisher(
        f"/{receiver}/radio/receive", RadioPacket, queue_size=0, tcp_nodelay=True
    )
    rospy.Subscriber(f"/{source}/radio/send", RadioPacket, carry, (source, heard), tcp_nodelay=True)
end = threading.Event()
rospy.on_shutdown(end.set)
time_s = 0
while not end.wait(0.01):
    time_s += 1
    clock.publish(Clock(rospy.Time(time_s)))
