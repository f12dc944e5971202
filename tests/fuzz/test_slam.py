# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""SLAM nodes under hostile messages."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import rospy
from geometry_msgs.msg import Pose2D, PoseStamped, PoseWithCovarianceStamped
from hostile import Robot, room_scan, service, started, transform, withstands
from nav_msgs.srv import GetMap
from slam_toolbox_msgs.srv import (
    AddSubmap,
    DeserializePoseGraph,
    DeserializePoseGraphRequest,
    MergeMaps,
    Pause,
    Reset,
    SerializePoseGraph,
    ToggleInteractive,
)
from std_srvs.srv import SetBool, Trigger
from tf2_msgs.msg import TFMessage
from trident.testing import Process, Ros, program, recorder
from visualization_msgs.msg import InteractiveMarkerFeedback

#: A sane scan after so many messages, of which no more go to one topic than its queue holds.
BATCH = 40
#: They write files, wherever a message says.
FILES = ("*/save_map", "*/serialize_map")


@contextmanager
def robot(base: str) -> Iterator[Robot]:
    result = Robot(base)
    yield result.connected()
    result.close()


def toolbox(ros: Ros, mode: str, *words: str) -> Process:
    command = [program("slam_toolbox", f"{mode}_slam_toolbox_node"), "__name:=slam"]
    return started(ros, "/slam", [*command, "_minimum_time_interval:=0.0", *words])


def drives(driver: Robot, topic: str, kind: Any) -> None:
    """Poses come out of scans that are sent now."""
    with recorder(topic, kind) as poses:
        driver.drives_until(lambda: len(poses.messages) > 5, "poses")


@pytest.fixture
def session(ros: Ros, tmp_path: Path) -> str:
    """A kept map."""
    process = toolbox(ros, "sync")
    path = str(tmp_path / "session")
    with robot("base_footprint") as driver:
        drives(driver, "/slam/pose", PoseWithCovarianceStamped)
        service("/slam/serialize_map", SerializePoseGraph)(path)
    process.stop()
    return path


def still_works(driver: Robot, session: str, is_localizing: bool) -> None:
    """After a reset, or with its map loaded again: whatever state it was put into."""
    if rospy.get_param("/slam/interactive_mode", False):
        service("/slam/toggle_interactive_mode", ToggleInteractive)()
    if is_localizing:
        if rospy.get_param("/slam/paused_new_measurements", False):
            service("/slam/pause_new_measurements", Pause)()
        service("/slam/deserialize_map", DeserializePoseGraph)(session, 1, Pose2D())
    else:
        service("/slam/reset", Reset)(False)
    drives(driver, "/slam/pose", PoseWithCovarianceStamped)
    # The first scan after the reset may be one of the hostile ones, which came late: then the
    # map begins when the robot has moved.
    ask = service("/slam/dynamic_map", GetMap)
    driver.drives_until(lambda: ask().map.info.width > 0, "a map")


@pytest.mark.fuzzes(
    "slam_toolbox/sync_slam_toolbox_node",
    "slam_toolbox/async_slam_toolbox_node",
    "slam_toolbox/localization_slam_toolbox_node",
    "slam_toolbox/lifelong_slam_toolbox_node",
)
@pytest.mark.parametrize("mode", ["sync", "async", "localization", "lifelong"])
def test_slam_toolbox(ros: Ros, session: str, mode: str) -> None:
    is_localizing = mode == "localization"
    words = [f"_map_file_name:={session}"] if is_localizing else []
    process = toolbox(ros, mode, *words)
    place = PoseWithCovarianceStamped()
    place.pose.pose.orientation.w = 1.0
    examples = {
        "/scan": room_scan(),
        "/tf": TFMessage([transform("odom", "base_footprint")]),
        "/initialpose": place,
        "/slam/deserialize_map": DeserializePoseGraphRequest(session, 2, Pose2D()),
        "/slam_toolbox/feedback": InteractiveMarkerFeedback(marker_name="1", event_type=1),
    }
    with robot("base_footprint") as driver:
        withstands(
            process,
            "/slam",
            lambda: still_works(driver, session, is_localizing),
            examples,
            driver.step,
            FILES,
            batch=BATCH,
        )


@pytest.mark.fuzzes("gmapping/slam_gmapping")
def test_gmapping(ros: Ros) -> None:
    process = started(
        ros, "/slam", [program("gmapping", "slam_gmapping"), "__name:=slam", "_particles:=5"]
    )
    with robot("base_link") as driver:
        withstands(
            process,
            "/slam",
            lambda: drives(driver, "/pose", PoseWithCovarianceStamped),
            {"/scan": room_scan(), "/tf": TFMessage([transform("odom", "base_link")])},
            driver.step,
            batch=BATCH,
        )


@pytest.mark.fuzzes("hector_mapping/hector_mapping")
def test_hector_mapping(ros: Ros) -> None:
    process = started(ros, "/slam", [program("hector_mapping", "hector_mapping"), "__name:=slam"])
    place = PoseWithCovarianceStamped()
    place.pose.pose.orientation.w = 1.0

    def still_works(driver: Robot) -> None:
        service("/reset_map", Trigger)()
        service("/pause_mapping", SetBool)(False)
        drives(driver, "/slam_out_pose", PoseStamped)

    with robot("base_link") as driver:
        examples = {
            "/scan": room_scan(),
            "/tf": TFMessage([transform("odom", "base_link")]),
            "/initialpose": place,
        }
        withstands(
            process, "/slam", lambda: still_works(driver), examples, driver.step, batch=BATCH
        )


@pytest.mark.fuzzes("slam_toolbox/merge_maps_kinematic")
def test_merge_maps(ros: Ros, session: str) -> None:
    process = started(
        ros, "/merge", [program("slam_toolbox", "merge_maps_kinematic"), "__name:=merge"]
    )

    def still_works() -> None:
        service("/map_merging/add_submap", AddSubmap)(session)
        service("/map_merging/merge_submaps", MergeMaps)()

    withstands(
        process,
        "/merge",
        still_works,
        {"/merge_maps_tool/feedback": InteractiveMarkerFeedback(marker_name="1", event_type=1)},
        # A sane session is added once: a thousand maps are a thousand maps.
        skip=("/map_merging/serialize_map", "/map_merging/merge_submaps"),
    )
