# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A robot without a simulator, for tests of nodes that only need one to be there."""

from __future__ import annotations

import math

import rospy
from geometry_msgs.msg import TransformStamped, Twist
from nav_msgs.msg import Odometry
from tf2_ros import TransformBroadcaster


class StandIn:
    """A robot that follows its commands: odometry and its transform."""

    def __init__(self) -> None:
        self.x = self.y = self.yaw = 0.0
        self.twist = Twist()
        self.odometry = rospy.Publisher("odom", Odometry, queue_size=5)
        self.transforms = TransformBroadcaster()
        self.commands = rospy.Subscriber("cmd_vel", Twist, self.obey)
        self.timer = rospy.Timer(rospy.Duration(0.02), self.move)

    def obey(self, twist: Twist) -> None:
        self.twist = twist

    def move(self, _event: object) -> None:
        step_s = 0.02
        self.x += self.twist.linear.x * math.cos(self.yaw) * step_s
        self.y += self.twist.linear.x * math.sin(self.yaw) * step_s
        self.yaw += self.twist.angular.z * step_s
        transform = TransformStamped()
        transform.header.stamp = rospy.Time.now()
        transform.header.frame_id, transform.child_frame_id = "odom", "base_link"
        transform.transform.translation.x, transform.transform.translation.y = self.x, self.y
        transform.transform.rotation.z = math.sin(self.yaw / 2)
        transform.transform.rotation.w = math.cos(self.yaw / 2)
        self.transforms.sendTransform(transform)
        odometry = Odometry(header=transform.header, child_frame_id="base_link")
        odometry.twist.twist = self.twist
        self.odometry.publish(odometry)

    def close(self) -> None:
        self.timer.shutdown()
        self.commands.unregister()
        self.odometry.unregister()
