# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""slam_toolbox' parameters, map updates, interactive mode and merge tool."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Pose, PoseWithCovarianceStamped
from map_msgs.msg import OccupancyGridUpdate
from nav_msgs.msg import OccupancyGrid
from nav_msgs.srv import GetMap
from scan_bag import diagnosed, play, service, start_slam
from sensor_msgs.msg import LaserScan
from slam_toolbox_msgs.srv import (
    AddSubmap,
    Clear,
    ClearQueue,
    LoopClosure,
    MergeMaps,
    SerializePoseGraph,
    ToggleInteractive,
)
from std_srvs.srv import Empty
from trident.testing import Ros, eventually, recorder
from visualization_msgs.msg import (
    InteractiveMarkerFeedback,
    InteractiveMarkerInit,
    MarkerArray,
)

SCANS = 60

#: Every parameter of slam_toolbox' files that means something here ...
USED = {
    "odom_frame": "odom",
    "map_frame": "map",
    "base_frame": "base_footprint",
    "scan_topic": "/scan",
    "mode": "mapping",
    "map_file_name": "",
    "map_start_at_dock": True,
    "debug_logging": False,
    "throttle_scans": 1,
    "transform_publish_period": 0.02,
    "map_update_interval": 1000.0,
    "resolution": 0.05,
    "max_laser_range": 20.0,
    "minimum_time_interval": 0.05,
    "transform_timeout": 0.2,
    "tf_buffer_duration": 30.0,
    "enable_interactive_mode": True,
    "use_scan_matching": True,
    "minimum_travel_distance": 0.2,
    "minimum_travel_heading": 0.3,
    "loop_search_maximum_distance": 3.0,
    "do_loop_closing": True,
    "loop_match_minimum_chain_size": 3,
    "loop_match_minimum_response_fine": 0.45,
    "solver_plugin": "solver_plugins::CeresSolver",
    "ceres_linear_solver": "SPARSE_NORMAL_CHOLESKY",
    "ceres_preconditioner": "SCHUR_JACOBI",
    "ceres_trust_strategy": "LEVENBERG_MARQUARDT",
    "ceres_dogleg_type": "TRADITIONAL_DOGLEG",
    "ceres_loss_function": "None",
    "position_covariance_scale": 4.0,
    "yaw_covariance_scale": 1.0,
    "map_changes_interval": 0.1,
    "scan_buffer_size": 10,
    "scan_buffer_maximum_scan_distance": 10.0,
    "lifelong_search_use_tree": False,
    "lifelong_minimum_score": 0.1,
    "lifelong_iou_match": 0.85,
    "lifelong_node_removal_score": 0.1,
    "lifelong_overlap_score_scale": 0.5,
    "lifelong_constraint_multiplier": 0.05,
    "lifelong_nearby_penalty": 0.001,
}
#: ... and every other one.
WITHOUT_EFFECT = {
    "stack_size_to_use": 40000000,
    "use_scan_barycenter": True,
    "link_match_minimum_response_fine": 0.1,
    "link_scan_maximum_distance": 1.5,
    "loop_match_maximum_variance_coarse": 3.0,
    "loop_match_minimum_response_coarse": 0.35,
    "correlation_search_space_dimension": 0.5,
    "correlation_search_space_resolution": 0.01,
    "correlation_search_space_smear_deviation": 0.1,
    "loop_search_space_dimension": 8.0,
    "loop_search_space_resolution": 0.05,
    "loop_search_space_smear_deviation": 0.03,
    "distance_variance_penalty": 0.5,
    "angle_variance_penalty": 1.0,
    "fine_search_angle_offset": 0.00349,
    "coarse_search_angle_offset": 0.349,
    "coarse_angle_resolution": 0.0349,
    "minimum_angle_penalty": 0.9,
    "minimum_distance_penalty": 0.5,
    "use_response_expansion": True,
    "lifelong_candidates_scale": 0.03,
}


def cells(whole: OccupancyGrid, update: OccupancyGridUpdate) -> np.ndarray:
    """The map that a subscriber has after an update."""
    grid = np.array(whole.data, np.int8).reshape(whole.info.height, whole.info.width)
    rows, columns = (
        slice(update.y, update.y + update.height),
        slice(update.x, update.x + update.width),
    )
    grid[rows, columns] = np.array(update.data, np.int8).reshape(update.height, update.width)
    return grid


def drag(publisher: rospy.Publisher, marker: Any, x: float, y: float) -> None:
    """What rviz sends when a marker is dragged to a place [m]."""
    feedback = InteractiveMarkerFeedback(marker_name=marker.name)
    feedback.header.frame_id = "map"
    feedback.event_type = InteractiveMarkerFeedback.POSE_UPDATE
    feedback.pose = Pose(orientation=marker.pose.orientation)
    feedback.pose.position.x, feedback.pose.position.y = x, y
    publisher.publish(feedback)


def loops(markers: MarkerArray) -> int:
    """Loops among the lines of a graph."""
    return len(next(marker for marker in markers.markers if marker.ns == "loops").points) // 2


def correct_by_hand() -> None:
    """Move a node as a user does: where nothing fits, then where it belongs."""
    toggle = service("/slam_toolbox/toggle_interactive_mode", ToggleInteractive)
    close = service("/slam_toolbox/manual_loop_closure", LoopClosure)
    pointer = rospy.Publisher("/slam_toolbox/feedback", InteractiveMarkerFeedback, queue_size=10)
    with (
        recorder("/slam_toolbox/update_full", InteractiveMarkerInit) as markers,
        recorder("/slam_toolbox/scan_visualization", LaserScan) as scans,
        recorder("/slam_toolbox/graph_visualization", MarkerArray) as graphs,
    ):
        toggle()
        eventually(lambda: bool(markers.messages and markers.messages[-1].markers), "markers")
        assert rospy.get_param("/slam_toolbox/interactive_mode") is True
        newest = max(markers.messages[-1].markers, key=lambda marker: int(marker.name))
        place = newest.pose.position
        eventually(lambda: pointer.get_num_connections() == 1, "the node")
        drag(pointer, newest, 40.0, 40.0)
        assert scans.received()[0].header.frame_id == "scan_visualization"
        assert min(scans.messages[0].ranges) < 3.0
        with pytest.raises(rospy.ServiceException):
            close()
        drag(pointer, newest, 40.0, 40.0)
        scans.received(2)
        service("/slam_toolbox/clear_changes", Clear)()
        drag(pointer, newest, place.x + 0.2, place.y - 0.1)
        scans.received(3)
        before = loops(graphs.messages[-1])
        close()
        eventually(lambda: loops(graphs.messages[-1]) == before + 1, "the loop")
        toggle()
        eventually(lambda: not markers.messages[-1].markers, "no markers")


def test_the_whole_interface_of_slam_toolbox(ros: Ros, bag: Path, tmp_path: Path) -> None:
    node = start_slam(
        ros,
        "slam_toolbox",
        "sync_slam_toolbox_node",
        name="slam_toolbox",
        parameters={**USED, **WITHOUT_EFFECT},
    )
    dynamic_map = service("/slam_toolbox/dynamic_map", GetMap)
    reported = [line for line in node.log.splitlines() if "parameters" in line]
    assert len(reported) == 1
    named = set(reported[0].split("here: ")[1].split("\x1b")[0].split(", "))
    # Those of lifelong mode may mean something.
    assert named <= set(WITHOUT_EFFECT)
    assert {name for name in WITHOUT_EFFECT if not name.startswith("lifelong_")} <= named
    with (
        recorder("/diagnostics", DiagnosticArray) as seen,
        recorder("/map", OccupancyGrid) as maps,
        recorder("/map_updates", OccupancyGridUpdate) as updates,
        recorder("/pose", PoseWithCovarianceStamped) as poses,
        recorder("/slam_toolbox/pose", PoseWithCovarianceStamped) as own_poses,
    ):
        play(ros, bag, "--rate", "5")
        eventually(lambda: diagnosed(seen, "scans used") == str(SCANS), "all scans")
        assert len(poses.received(SCANS)) == len(own_poses.received(SCANS))
        covariance = np.array(poses.messages[-1].pose.covariance).reshape(6, 6)
        assert np.all(np.diag(covariance)[[0, 1, 5]] > 0)
        # Whole maps where the map has grown, else what has changed since the last one.
        assert updates.messages
        assert all(len(update.data) == update.width * update.height for update in updates.messages)
        now = dynamic_map().map
        whole = maps.messages[-1]
        later = [u for u in updates.messages if u.header.stamp >= whole.header.stamp]
        if later and now.info.width * now.info.height == len(whole.data):
            known = cells(whole, later[-1])
            assert np.mean(known.ravel() == np.array(now.data, np.int8)) > 0.99
        assert len(maps.messages) + len(updates.messages) > 5
    service("/slam_toolbox/clear_queue", ClearQueue)()
    service("/slam_toolbox/clear_localization_buffer", Empty)()
    correct_by_hand()
    session = str(tmp_path / "session")
    service("/slam_toolbox/serialize_map", SerializePoseGraph)(session)
    merge(ros, session, tmp_path)


def merge(ros: Ros, session: str, tmp_path: Path) -> None:
    """The same session twice, the second one put at a small offset from the first."""
    node = start_slam(
        ros,
        "slam_toolbox",
        "merge_maps_kinematic",
        "_loop_match_minimum_chain_size:=3",
        "map:=merged_map",
        name="merge",
    )
    add = service("/map_merging/add_submap", AddSubmap)
    merge_submaps = service("/map_merging/merge_submaps", MergeMaps)
    with pytest.raises(rospy.ServiceException):
        merge_submaps()
    with pytest.raises(rospy.ServiceException, match="no_such_session"):
        add(str(tmp_path / "no_such_session"))
    node.eventually_logs("no_such_session")
    add(session)
    add(session)
    pointer = rospy.Publisher("/merge_maps_tool/feedback", InteractiveMarkerFeedback, queue_size=10)
    eventually(lambda: pointer.get_num_connections() == 1, "the tool")
    with (
        recorder("/merge_maps_tool/update_full", InteractiveMarkerInit) as markers,
        recorder("/map_2", OccupancyGrid) as second,
        recorder("/merged_map", OccupancyGrid) as merged,
    ):
        eventually(lambda: bool(markers.messages and len(markers.messages[-1].markers) == 2), "two")
        marker = markers.messages[-1].markers[1]
        drag(pointer, marker, marker.pose.position.x + 0.2, marker.pose.position.y)
        eventually(
            lambda: any(
                m.pose.position.x > marker.pose.position.x + 0.1
                for message in markers.messages
                for m in message.markers
            ),
            "the marker there",
        )
        merge_submaps()
        whole = merged.received()[0]
        # The walls of both lie on each other again: the map is no larger than one of them.
        assert abs(whole.info.width - second.received()[0].info.width) <= 2
    node.eventually_logs("map_2: found in the others")
    service("/map_merging/serialize_map", SerializePoseGraph)(str(tmp_path / "merged"))
    assert (tmp_path / "merged.posegraph").stat().st_size > 1000
