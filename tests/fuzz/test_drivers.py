# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that drive robots and lead formations, under hostile messages."""

from __future__ import annotations

from typing import Any

import pytest
from geometry_msgs.msg import Twist
from hostile import Asked, answers_on, odometry, room_scan, started
from sensor_msgs.msg import Joy
from trident.testing import Ros, program


def treat(ros: Ros, package: str, name: str, topic: str, make: Any, *words: str) -> None:
    process = started(ros, "/driver", [program(package, name), "__name:=driver", *words])
    answers_on(process, "/driver", Asked(topic, make, "/cmd_vel", Twist))


@pytest.mark.fuzzes("trident_nav/wander.py")
def test_wander(ros: Ros) -> None:
    treat(ros, "trident_nav", "wander.py", "/scan", room_scan)


@pytest.mark.fuzzes("trident_nav/waypoint_follower.py")
def test_waypoint_follower(ros: Ros) -> None:
    ros.set_param("/driver", {"waypoints": [[100.0, 0.0], [100.0, 50.0]], "answers_always": True})
    treat(ros, "trident_nav", "waypoint_follower.py", "/odom", odometry)


@pytest.mark.fuzzes("teleop_twist_joy/teleop_node")
def test_joystick(ros: Ros) -> None:
    def held() -> Joy:
        return Joy(axes=[0.5] * 6, buttons=[1] * 8)

    treat(ros, "teleop_twist_joy", "teleop_node", "/joy", held)
