# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Plugins of mavros that carry poses, velocities and ranges of other estimators and sensors."""

from __future__ import annotations

import math
from collections.abc import Iterator

import pytest
import rospy
from geometry_msgs.msg import (
    PoseStamped,
    TransformStamped,
    TwistWithCovarianceStamped,
    Vector3Stamped,
)
from mavros_msgs.msg import WheelOdomStamped
from nav_msgs.msg import Odometry
from peer import Peer, ask_by, connected_peer
from sensor_msgs.msg import Range
from tf2_msgs.msg import TFMessage
from trident.testing import Ros, recorder

#: One of the sensors is of a wrong type: an error, and the others are there.
PARAMETERS = {
    "fake_gps": {"mocap_transform": False, "fix_type": 3, "geo_origin": {"lat": 63.0, "lon": 10.0}},
    "wheel_odometry": {
        "wheel0": {"y": -0.15},
        "wheel1": {"y": 0.15},
        "send_raw": True,
        "tf": {"send": True},
    },
    "setpoint_position": {"tf": {"listen": True}},
    "vision_pose": {"tf": {"listen": True}},
    "distance_sensor": {
        "down": {"id": 4, "frame_id": "sonar", "orientation": "PITCH_270"},
        "ahead": {"id": 5, "subscriber": True, "orientation": "NONE", "covariance": 9},
        "wrong": {"id": 6, "subscriber": "yes"},
    },
}


@pytest.fixture(scope="module")
def peer(session_ros: Ros) -> Iterator[Peer]:
    """A vehicle that beats, and a node that is connected to it."""
    with connected_peer(session_ros, PARAMETERS) as one:
        yield one


def test_a_pose_of_a_motion_capture_is_a_fix(peer: Peer) -> None:
    pose = PoseStamped()
    pose.header.stamp = rospy.Time(100)
    pose.pose.position.y, pose.pose.position.z = 111.5, 5.0
    came = ask_by(peer, "fake_gps/mocap/pose", pose, "HIL_GPS")
    assert (came.fix_type, came.satellites_visible, came.eph) == (3, 5, 200)
    assert came.lat == pytest.approx(630010000, abs=100)  # 1e-3 deg are 111.5 m there
    assert came.alt == pytest.approx(413_000, abs=10)


def test_wheels_become_odometry_in_the_vehicles_heading(peer: Peer) -> None:
    peer.send.attitude_send(1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)  # to the north
    with (
        recorder("/uav1/mavros/wheel_odometry/odom", Odometry) as odometries,
        recorder("/uav1/mavros/wheel_odometry/distance", WheelOdomStamped) as raw,
        recorder("/tf", TFMessage) as transforms,
    ):
        for time_us, distance_m in ((1_000_000, 2.0), (2_000_000, 3.5)):
            peer.send.wheel_distance_send(time_us, 2, [distance_m] * 2 + [0.0] * 14)
        odometry = odometries.received()[0]
        assert list(raw.received(2)[1].data) == [3.5, 3.5]
        assert transforms.received()[0].transforms[0].child_frame_id == "uav1/base_link"
    assert odometry.header.frame_id == "uav1/odom"
    assert odometry.pose.pose.position.y == pytest.approx(1.5)
    assert odometry.twist.twist.linear.x == pytest.approx(1.5)


def test_the_covariance_of_a_velocity_goes_to_the_vehicle_in_ned(peer: Peer) -> None:
    speed = TwistWithCovarianceStamped()
    speed.twist.twist.linear.x = 2.0
    covariance = [0.0] * 36
    covariance[0], covariance[7], covariance[14] = 1.0, 2.0, 3.0
    covariance[1] = covariance[6] = 0.5
    covariance[2] = covariance[12] = 0.25
    speed.twist.covariance = covariance
    came = ask_by(peer, "vision_speed/speed_twist_cov", speed, "VISION_SPEED_ESTIMATE")
    assert (came.x, came.y) == (0.0, 2.0)
    assert list(came.covariance) == [2.0, 0.5, 0.0, 0.5, 1.0, -0.25, 0.0, -0.25, 3.0]
    plain = ask_by(peer, "vision_speed/speed_vector", Vector3Stamped(), "VISION_SPEED_ESTIMATE")
    assert math.isnan(plain.covariance[0])


def transform(child: str) -> TransformStamped:
    """Of a child of uav1/map, 4 m to the east of it."""
    message = TransformStamped(child_frame_id=child)
    message.header.stamp = rospy.Time.now()
    message.header.frame_id = "uav1/map"
    message.transform.translation.x = 4.0
    message.transform.rotation.w = 1.0
    return message


@pytest.mark.parametrize(
    ("child", "kind"),
    [
        ("target_position", "SET_POSITION_TARGET_LOCAL_NED"),
        ("vision_estimate", "VISION_POSITION_ESTIMATE"),
    ],
)
def test_a_transform_is_followed(peer: Peer, child: str, kind: str) -> None:
    publisher = rospy.Publisher("/tf", TFMessage, queue_size=10)
    came = peer.asked(
        lambda: publisher.publish(TFMessage([transform(f"uav1/{child}")])),
        kind,
        lambda message: bool(message.y == 4.0),
    )
    publisher.unregister()
    assert came.x == pytest.approx(0.0)


def test_ranges_come_and_go_by_the_sections_of_the_sensors(peer: Peer) -> None:
    with recorder("/uav1/mavros/distance_sensor/down", Range) as ranges:
        peer.send.distance_sensor_send(1, 20, 700, 150, 1, 4, 24, 0)  # looks up: refused
        peer.send.distance_sensor_send(1, 20, 700, 250, 1, 4, 25, 0)
        came = ranges.received()[0]
        assert (came.range, came.header.frame_id) == (2.5, "uav1/sonar")
    ahead = Range(range=3.0, min_range=0.2, max_range=9.0, field_of_view=0.5)
    sent = ask_by(peer, "distance_sensor/ahead", ahead, "DISTANCE_SENSOR")
    assert (sent.id, sent.orientation, sent.covariance) == (5, 0, 9)
    assert (sent.current_distance, sent.horizontal_fov) == (300, 0.5)
