# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""team_fusion_node with the tutorial's parameters, and what it refuses."""

from __future__ import annotations

import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import PointCloud2
from tf2_msgs.msg import TFMessage
from trident.testing import Ros, eventually, program, recorder

from trident_msgs.msg import TeamState

_TUTORIAL = {
    "fusion_method": 1,
    "update_rate": 20.0,
    "uav_pose_topic": "/uav/vins/odometry",
    "ugv_pose_topic": "/ugv/scan_matched_points2",
    "usv_pose_topic": "/usv/icp_odom",
    "start_patience": 0.2,
    "fused": True,
}


def _odometry(x: float) -> Odometry:
    message = Odometry()
    message.header.stamp = rospy.Time.now()
    message.pose.pose.position.x, message.pose.pose.orientation.w = x, 1.0
    for i in range(6):
        message.pose.covariance[7 * i] = 0.01
    return message


def test_a_cloud_is_refused_by_name_and_the_other_robots_are_fused(ros: Ros) -> None:
    ros.set_param("/team_fusion", _TUTORIAL)
    node = ros.launch(
        [program("trident_estimation", "team_fusion_node"), "__name:=team_fusion"], "/team_fusion"
    )
    uav = rospy.Publisher("/uav/vins/odometry", Odometry, queue_size=10)
    usv = rospy.Publisher("/usv/icp_odom", Odometry, queue_size=10)
    cloud = rospy.Publisher("/ugv/scan_matched_points2", PointCloud2, queue_size=10)
    pose = rospy.Publisher("/ugv/tracked_pose", PoseWithCovarianceStamped, queue_size=10)
    with recorder("/team/state", TeamState) as states, recorder("/tf", TFMessage) as transforms:

        def are_fused() -> bool:
            uav.publish(_odometry(7.0))
            usv.publish(_odometry(-4.0))
            cloud.publish(PointCloud2())
            return bool(states.messages and transforms.messages)

        eventually(are_fused, "a belief about the team")
        eventually(lambda: "has no pose" in node.log, "the refusal of the cloud")
    members = {member.name: member for member in states.messages[-1].members}
    assert set(members) == {"uav", "ugv", "usv"}
    assert abs(members["uav"].pose.pose.position.x - 7.0) < 0.5
    assert abs(members["usv"].pose.pose.position.x + 4.0) < 0.5
    assert members["ugv"].age_s < 0.0
    frames = {edge.child_frame_id for edge in transforms.messages[-1].transforms}
    assert frames <= {"uav/map", "ugv/map", "usv/map"}
    assert "poses of ugv: /ugv/tracked_pose" in node.log
    assert "'sensor_msgs/PointCloud2' has no pose" in node.log
    for publisher in (uav, usv, cloud, pose):
        publisher.unregister()


def test_parameters_that_contradict_one_another_end_it_with_one_sentence(ros: Ros) -> None:
    ros.set_param("/team_fusion", {"update_rate": 5.0})
    node = ros.launch(
        [program("trident_estimation", "team_fusion_node"), "__name:=team_fusion"], "/team_fusion"
    )
    eventually(lambda: not node.running, "the end of the node")
    assert "no robot is given; legal: uav_pose_topic" in node.log
