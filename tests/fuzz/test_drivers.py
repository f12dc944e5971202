# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that drive robots and lead formations, under hostile messages."""

from __future__ import annotations

from typing import Any

import rospy
from geometry_msgs.msg import Twist
from hostile import room_scan, started, withstands
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy
from trident.testing import Ros, eventually, program, recorder


class Asked:
    """One topic to a node, and what comes back."""

    def __init__(self, topic: str, make: Any, answer: str, kind: Any) -> None:
        self._make, self._answer, self._kind = make, answer, kind
        self._topic = rospy.Publisher(topic, type(make()), queue_size=10, tcp_nodelay=True)

    def send(self) -> None:
        self._topic.publish(self._make())

    def answers(self) -> None:
        with recorder(self._answer, self._kind) as answers:

            def is_answered() -> bool:
                self.send()
                return len(answers.messages) > 3

            eventually(is_answered, "answers")

    def close(self) -> None:
        self._topic.unregister()


def odometry() -> Odometry:
    message = Odometry()
    message.header.stamp, message.header.frame_id = rospy.Time.now(), "odom"
    message.pose.pose.orientation.w = 1.0
    return message


def treat(ros: Ros, package: str, name: str, topic: str, make: Any, *words: str) -> None:
    process = started(ros, "/driver", [program(package, name), "__name:=driver", *words])
    asked = Asked(topic, make, "/cmd_vel", Twist)
    withstands(process, "/driver", asked.answers, {topic: make()}, asked.send)
    asked.close()


def test_wander(ros: Ros) -> None:
    treat(ros, "trident_nav", "wander.py", "/scan", room_scan)


def test_waypoint_follower(ros: Ros) -> None:
    ros.set_param("/driver", {"waypoints": [[100.0, 0.0], [100.0, 50.0]], "answers_always": True})
    treat(ros, "trident_nav", "waypoint_follower.py", "/odom", odometry)


def test_joystick(ros: Ros) -> None:
    def held() -> Joy:
        return Joy(axes=[0.5] * 6, buttons=[1] * 8)

    treat(ros, "teleop_twist_joy", "teleop_node", "/joy", held)
