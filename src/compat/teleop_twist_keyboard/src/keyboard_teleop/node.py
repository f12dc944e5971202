# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The node teleop_twist_keyboard: keys in, geometry_msgs/Twist on cmd_vel out."""

from __future__ import annotations

import sys
import threading
from typing import Any

import rospy
from geometry_msgs.msg import Twist, TwistStamped

from keyboard_teleop.keys import HELP, QUIT, Driver, Velocity
from keyboard_teleop.terminal import Keys


def _number(name: str, fallback: float) -> float:
    value = rospy.get_param(f"~{name}", fallback)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"~{name} is {value!r}, legal: a number")
    return float(value)


class _Publisher:
    """Sends the newest velocity, again and again when there is a rate."""

    def __init__(self, rate_hz: float, stamped: bool, frame: str) -> None:
        self._stamped, self._frame = stamped, frame
        self._lock = threading.Lock()
        self._velocity = Velocity()
        self._publisher = rospy.Publisher(
            "cmd_vel", TwistStamped if stamped else Twist, queue_size=1
        )
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._repeat, args=(rate_hz,), daemon=True)
        if rate_hz > 0:
            self._thread.start()

    def send(self, velocity: Velocity) -> None:
        with self._lock:
            self._velocity = velocity
            self._publisher.publish(self._message(velocity))

    def end(self) -> None:
        self._ended.set()
        self.send(Velocity())

    def _repeat(self, rate_hz: float) -> None:
        while not self._ended.wait(1.0 / rate_hz):
            self.send(self._velocity)

    def _message(self, velocity: Velocity) -> Any:
        twist = Twist()
        twist.linear.x, twist.linear.y, twist.linear.z = velocity.x, velocity.y, velocity.z
        twist.angular.z = velocity.yaw
        if not self._stamped:
            return twist
        message = TwistStamped(twist=twist)
        message.header.stamp = rospy.Time.now()
        message.header.frame_id = self._frame
        return message


def _drive(driver: Driver, keys: Keys, publisher: _Publisher, timeout_s: float) -> None:
    while not rospy.is_shutdown():
        key = keys.read(timeout_s if timeout_s > 0 else None)
        if key is None or key == QUIT:
            return
        if key == "" and not driver.moves:
            continue
        if driver.press(key):
            print(driver.describe(), end="\r\n", flush=True)
        publisher.send(driver.velocity)


def main() -> int:
    """Run until Ctrl-C or the end of the input. Returns the exit code."""
    rospy.init_node("teleop_twist_keyboard", disable_signals=True)
    try:
        driver = Driver(
            _number("speed", 0.5),
            _number("turn", 1.0),
            _number("speed_limit", 1000.0),
            _number("turn_limit", 1000.0),
        )
        timeout_s, rate_hz = _number("key_timeout", 0.5), _number("repeat_rate", 0.0)
        keys = Keys()
    except (OSError, ValueError) as error:
        print(f"teleop_twist_keyboard: {error}", file=sys.stderr)
        return 1
    stamped = bool(rospy.get_param("~stamped", False))
    publisher = _Publisher(rate_hz, stamped, str(rospy.get_param("~frame_id", "")))
    print(HELP)
    print(driver.describe(), flush=True)
    try:
        with keys:
            _drive(driver, keys, publisher, timeout_s)
    finally:
        publisher.end()
        rospy.signal_shutdown("quit")
    return 0
