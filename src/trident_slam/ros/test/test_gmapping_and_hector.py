# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""gmapping's and hector_mapping's topics, services and parameters, and what each does."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import rospy
import tf2_ros
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Pose, PoseStamped, PoseWithCovarianceStamped
from hector_mapping.srv import ResetMapping
from nav_msgs.msg import MapMetaData, OccupancyGrid, Odometry
from nav_msgs.srv import GetMap
from scan_bag import ROOM, diagnosed, play, service, start_slam
from sensor_msgs.msg import PointCloud
from std_msgs.msg import Float64, String
from std_srvs.srv import SetBool, Trigger
from trident.testing import Ros, eventually, recorder

SCANS = 30
ROOM_M = ROOM[2] - ROOM[0]


def width_m(seen: OccupancyGrid) -> float:
    """From the first to the last column with a wall [m]."""
    grid = np.array(seen.data, np.int8).reshape(seen.info.height, seen.info.width)
    columns = np.flatnonzero((grid == 100).any(axis=0))
    return float((columns[-1] - columns[0] + 1) * seen.info.resolution)


def test_gmapping_does_what_its_parameters_say(
    ros: Ros, bag: Path, transforms: tf2_ros.Buffer
) -> None:
    particles = 5
    node = start_slam(
        ros,
        "gmapping",
        "slam_gmapping",
        parameters={
            "base_frame": "base_footprint",
            "map_frame": "plan",
            "odom_frame": "odom",
            "particles": particles,
            "delta": 0.1,
            "maxUrange": 3.5,
            "linearUpdate": 0.1,
            "angularUpdate": 0.1,
            "temporalUpdate": 0.5,
            "resampleThreshold": 0.5,
            "minimumScore": 50,
            "lskip": 1,
            "srr": 0.1,
            "srt": 0.2,
            "str": 0.1,
            "stt": 0.2,
            "ogain": 3.0,
            "throttle_scans": 2,
            "map_update_interval": 0.5,
            "transform_publish_period": 0.05,
            "tf_delay": 0.1,
            "maxRange": 12.0,
            "sigma": 0.05,
            "kernelSize": 1,
            "lstep": 0.05,
            "astep": 0.05,
            "iterations": 5,
            "lsigma": 0.075,
            "xmin": -50.0,
            "ymin": -50.0,
            "xmax": 50.0,
            "ymax": 50.0,
            "occ_thresh": 0.25,
            "llsamplerange": 0.01,
            "llsamplestep": 0.01,
            "lasamplerange": 0.005,
            "lasamplestep": 0.005,
            "partikles": 30,
        },
    )
    with (
        recorder("/slam_gmapping/entropy", Float64) as entropies,
        recorder("/map", OccupancyGrid) as maps,
        recorder("/map_metadata", MapMetaData) as sizes,
        recorder("/diagnostics", DiagnosticArray) as seen,
    ):
        play(ros, bag, "--rate", "5")
        eventually(lambda: "plan" in transforms.all_frames_as_string(), "the map's frame")
        assert transforms.can_transform("plan", "odom", rospy.Time())
        eventually(lambda: int(diagnosed(seen, "scans used") or 0) > 3, "scans")
        assert int(diagnosed(seen, "scans received")) <= SCANS // 2
        assert maps.received(2)[-1].info.resolution == pytest.approx(0.1)
        assert sizes.received()[-1].width > 10
        # 30 equal particles would give ln 30 = 3.4.
        assert 0.0 <= entropies.received()[-1].data <= math.log(particles) + 1e-9
    whole = service("/dynamic_map", GetMap)().map
    assert whole.header.frame_id == "plan"
    # The far wall is beyond maxUrange; a map of 100 m would be that of xmin and xmax.
    assert width_m(whole) < ROOM_M - 0.3
    assert whole.info.width * whole.info.resolution < 20.0
    node.eventually_logs("parameters without effect here: astep, iterations, kernelSize, lasample")
    node.eventually_logs("partikles is unknown, not used; did you mean particles?")


def test_hector_needs_no_odometry(ros: Ros, bag: Path, transforms: tf2_ros.Buffer) -> None:
    node = start_slam(
        ros,
        "hector_mapping",
        "hector_mapping",
        parameters={
            "base_frame": "base_footprint",
            "odom_frame": "base_footprint",
            "map_frame": "map",
            "map_resolution": 0.1,
            "map_multi_res_levels": 2,
            "update_factor_free": 0.4,
            "update_factor_occupied": 0.9,
            "map_update_distance_thresh": 0.1,
            "map_update_angle_thresh": 0.1,
            "laser_min_dist": 0.2,
            "laser_max_dist": 10.0,
            "laser_z_min_value": -1.0,
            "laser_z_max_value": 1.0,
            "pub_map_odom_transform": False,
            "pub_odometry": True,
            "tf_map_scanmatch_transform_frame_name": "matched",
            "use_tf_pose_start_estimate": False,
            "use_tf_scan_transformation": True,
            "map_with_known_poses": False,
            "map_pub_period": 0.5,
            "scan_subscriber_queue_size": 25,
            "map_size": 512,
            "map_start_x": 0.5,
            "map_start_y": 0.5,
            "bag_loop": "continue",
        },
    )
    with (
        recorder("/slam_out_pose", PoseStamped) as poses,
        recorder("/poseupdate", PoseWithCovarianceStamped) as updates,
        recorder("/scanmatch_odom", Odometry) as odometry,
        recorder("/slam_cloud", PointCloud) as clouds,
        recorder("/map", OccupancyGrid) as maps,
    ):
        play(ros, bag, "--rate", "3")
        assert maps.received()[-1].info.resolution == pytest.approx(0.1)
        assert updates.received()[-1].pose.covariance[0] > 0.0
        assert odometry.received()[-1].child_frame_id == "base_footprint"
        assert poses.received()[-1].header.frame_id == "map"
        cloud = clouds.received()[-1]
        assert cloud.header.frame_id == "base_footprint"
        assert max(point.x for point in cloud.points) < ROOM_M
        eventually(lambda: transforms.can_transform("map", "matched", rospy.Time()), "its pose")
        assert not transforms.can_transform("map", "odom", rospy.Time())
        # The drive was 0.9 m to the side and forward, see scan_bag.path().
        place = transforms.lookup_transform("map", "matched", rospy.Time()).transform.translation
        assert 0.5 < math.hypot(place.x, place.y) < 2.0
    node.eventually_logs(
        "parameters without effect here: laser_z_max_value, laser_z_min_value, map_size"
    )
    commands_of_hector(ros, bag)


def commands_of_hector(ros: Ros, bag: Path) -> None:
    """Pause, reset, and where it is."""
    whole = service("/dynamic_map", GetMap)
    assert width_m(whole().map) > ROOM_M - 0.3
    command = rospy.Publisher("/syscommand", String, queue_size=1)
    eventually(lambda: command.get_num_connections() == 1, "the node")
    command.publish("reset")
    eventually(lambda: not whole().map.data, "an empty map")
    assert service("/reset_map", Trigger)().success
    assert service("/pause_mapping", SetBool)(True).success
    start = Pose()
    start.position.x, start.orientation.w = 20.0, 1.0
    service("/restart_mapping_with_new_pose", ResetMapping)(start)
    with recorder("/slam_out_pose", PoseStamped) as poses:
        seen = len(poses.messages)  # the last one is latched
        play(ros, bag, "--rate", "3", "--duration", "1")
        assert poses.received(seen + 2)[-1].pose.position.x == pytest.approx(20.0, abs=1.0)
