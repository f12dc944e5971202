# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Drives a robot about by its lidar: `scan` in, `cmd_vel` out.

Parameters: see WanderConfig. The lidar is taken to look forward along the robot's x.
"""

from __future__ import annotations

import numpy as np
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan

from trident_nav.core.errors import NavError
from trident_nav.core.velocity import STOP
from trident_nav.core.wander import Wander, WanderConfig
from trident_nav.nodes.params import read_config, twist
from trident_ros import Refusals, init_node, numbers_problem, stamp_problem


def main() -> int:
    """Run until the node is shut down.

    Returns:
        Exit code of the process.
    """
    init_node("wander")
    try:
        wander = Wander(read_config(WanderConfig))
    except NavError as error:
        rospy.logfatal("wander: %s", error)
        return 1
    publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1, tcp_nodelay=True)

    refusals = Refusals()

    def on_scan(scan: LaserScan) -> None:
        problem = numbers_problem("angle_min, angle_increment", *_angles(scan), most=100.0)
        problem = problem or stamp_problem(scan.header.stamp)
        if problem:
            refusals.note("scan refused", f"scan refused: {problem}")
            return
        ranges = np.asarray(scan.ranges, dtype=float)
        angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
        _send(publisher, twist(wander.command(scan.header.stamp.to_sec(), angles, ranges)))

    rospy.Subscriber("scan", LaserScan, on_scan, queue_size=1, tcp_nodelay=True)
    rospy.on_shutdown(lambda: _send(publisher, twist(STOP)))
    rospy.spin()
    return 0


def _angles(scan: LaserScan) -> tuple[float, float]:
    return scan.angle_min, scan.angle_increment


def _send(publisher: rospy.Publisher, message: Twist) -> None:
    try:
        publisher.publish(message)
    except rospy.ROSException:
        # Topics close when rospy begins to shut down.
        if not rospy.core.is_shutdown_requested():
            raise
