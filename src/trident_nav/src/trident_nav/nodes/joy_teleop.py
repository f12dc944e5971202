# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Drives a robot by a joystick: `joy` in, `cmd_vel` out, with teleop_twist_joy's parameters.

`~axis_linear` and the like may be numbers or, as there, maps with `x` (turning: `yaw`).
"""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from trident_nav.core.errors import NavError
from trident_nav.core.joystick import Joystick, JoystickConfig
from trident_nav.nodes.params import read_config, twist
from trident_ros import init_node


def main() -> int:
    """Run until the node is shut down.

    Returns:
        Exit code of the process.
    """
    init_node("teleop_twist_joy")
    try:
        _flatten()
        joystick = Joystick(read_config(JoystickConfig))
    except NavError as error:
        rospy.logfatal("teleop_twist_joy: %s", error)
        return 1
    publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1, tcp_nodelay=True)

    def on_joy(joy: Joy) -> None:
        velocity = joystick.command(joy.axes, joy.buttons)
        if velocity is not None:
            publisher.publish(twist(velocity))

    rospy.Subscriber("joy", Joy, on_joy, queue_size=1, tcp_nodelay=True)
    rospy.spin()
    return 0


def _flatten() -> None:
    """A map of axes becomes the one that a ground robot has."""
    for item in fields(JoystickConfig):
        value: Any = rospy.get_param("~" + item.name, None)
        if not isinstance(value, dict):
            continue
        axis = "yaw" if "angular" in item.name else "x"
        others = sorted(set(value) - {axis})
        if others:
            rospy.logwarn("~%s: %s: not used", item.name, ", ".join(others))
        if axis not in value:
            raise NavError(f"~{item.name}: {value}, legal: a number, or a map with '{axis}'")
        rospy.set_param("~" + item.name, value[axis])
