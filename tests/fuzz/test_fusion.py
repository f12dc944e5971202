# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The fusion of a team under hostile messages."""

from __future__ import annotations

import pytest
import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped
from hostile import Asked, answers_on, odometry, started
from sensor_msgs.msg import FluidPressure, Imu, NavSatFix, Range
from trident.testing import Ros, program

from trident_msgs.msg import Detection, TeamState

_PARAMETERS = {
    "update_rate": 50.0,
    "uav_pose_topic": "/uav/odometry",
    "robots": {
        "uav": {
            "gnss_topic": "/uav/fix",
            "compass_topic": "/uav/imu",
            "pressure_topic": "/uav/pressure",
        },
        "usv": {
            "pose_topic": "/usv/odometry",
            "shared_pose_topic": "/usv/shared",
            "waterline": True,
        },
    },
    "sighting_topics": ["/detections"],
    "ranges": [{"topic": "/range", "robot": "uav", "other": "usv"}],
    "fused": True,
}


def pose(frame: str) -> PoseWithCovarianceStamped:
    message = PoseWithCovarianceStamped()
    message.header.stamp, message.header.frame_id = rospy.Time.now(), frame
    message.pose.pose.orientation.w = 1.0
    for i in range(6):
        message.pose.covariance[7 * i] = 0.1
    return message


def sighting() -> Detection:
    message = Detection(observer="uav", label="usv", pose=pose("").pose, probability=0.9)
    message.header.stamp, message.header.frame_id = rospy.Time.now(), "uav/base_link"
    message.pose.pose.position.z = -20.0
    return message


@pytest.mark.fuzzes("trident_estimation/team_fusion_node")
def test_team_fusion(ros: Ros) -> None:
    ros.set_param("/team_fusion", _PARAMETERS)
    asked = Asked("/uav/odometry", odometry, "/team/state", TeamState)
    # The node takes poses of any type: that of each topic is known from who publishes it.
    others = rospy.Publisher("/usv/odometry", PoseWithCovarianceStamped, queue_size=1)
    shared = rospy.Publisher("/usv/shared", PoseWithCovarianceStamped, queue_size=1)
    command = [program("trident_estimation", "team_fusion_node"), "__name:=team_fusion"]
    process = started(ros, "/team_fusion", command)
    examples = {
        "/usv/odometry": pose("usv/map"),
        "/usv/shared": pose("world"),
        "/uav/fix": NavSatFix(latitude=63.4389, longitude=10.399),
        "/uav/imu": Imu(orientation=pose("").pose.pose.orientation),
        "/uav/pressure": FluidPressure(fluid_pressure=101325.0),
        "/range": Range(range=20.0, max_range=1e3),
        "/detections": sighting(),
    }
    answers_on(process, "/team_fusion", asked, examples)
    others.unregister()
    shared.unregister()
