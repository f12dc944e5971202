# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The tutorial's node: one Float32 of nanoseconds after another, and how long each took."""

from __future__ import annotations

import threading
import time

import rospy
from std_msgs.msg import Float32, UInt64

_RATE_HZ = 10.0
_MANTISSA_BITS = 24


def float32_step_ns(time_ns: int) -> int:
    """How far the Float32 next to a time is away [ns]: 24 bits are all that it holds."""
    return 1 << max(time_ns.bit_length() - _MANTISSA_BITS, 0)


class LatencyTest:
    """Publishes ``test_topic`` and, with all 64 bits, ``test_topic_ns``; listens to the latter."""

    def __init__(self) -> None:
        self._legacy = rospy.Publisher("test_topic", Float32, queue_size=10, tcp_nodelay=True)
        self._exact = rospy.Publisher("test_topic_ns", UInt64, queue_size=10, tcp_nodelay=True)
        self._subscriber = rospy.Subscriber(
            "test_topic_ns", UInt64, self._on_stamp, queue_size=10, tcp_nodelay=True
        )

    def send(self) -> None:
        """Publishes both."""
        now_ns = time.time_ns()
        self._legacy.publish(Float32(float(now_ns)))
        self._exact.publish(UInt64(time.time_ns()))

    @staticmethod
    def _on_stamp(message: UInt64) -> None:
        latency_ms = 1e-6 * (time.time_ns() - message.data)
        print(f"Latency: {latency_ms:.2f} ms", flush=True)


def main() -> None:
    """Runs until it is interrupted."""
    rospy.init_node("latency_test")
    step_s = 1e-9 * float32_step_ns(time.time_ns())
    print(
        f"latency_test: a Float32 holds {_MANTISSA_BITS} bits, so that nanoseconds since 1970 come"
        f" in steps of {step_s:.0f} s on test_topic: what is measured are the 64-bit stamps on"
        " test_topic_ns, sent next to them. For histograms: ./trident latency",
        flush=True,
    )
    test = LatencyTest()
    end = threading.Event()
    rospy.on_shutdown(end.set)
    while not end.wait(1.0 / _RATE_HZ):
        test.send()
