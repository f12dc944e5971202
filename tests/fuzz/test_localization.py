# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""amcl and the map's server under hostile messages."""

from __future__ import annotations

from pathlib import Path

import pytest
import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped
from hostile import MAP_CELLS, Robot, room_scan, started, transform, withstands
from nav_msgs.srv import GetMap, LoadMapRequest, SetMapRequest
from std_srvs.srv import Empty
from tf2_msgs.msg import TFMessage
from trident.testing import LIMIT_S, Ros, program, recorder


def still_serves() -> None:
    rospy.wait_for_service("/static_map", LIMIT_S)
    assert rospy.ServiceProxy("/static_map", GetMap)().map.info.width == MAP_CELLS[0]


@pytest.mark.fuzzes("map_server/map_server")
def test_map_server(ros: Ros, map_file: Path) -> None:
    command = [program("map_server", "map_server"), str(map_file), "__name:=maps"]
    process = started(ros, "/maps", command)
    withstands(process, "/maps", still_serves, {"/change_map": LoadMapRequest(str(map_file))})


@pytest.mark.fuzzes("amcl/amcl")
def test_amcl(ros: Ros, map_file: Path) -> None:
    started(ros, "/maps", [program("map_server", "map_server"), str(map_file), "__name:=maps"])
    still_serves()
    whole = rospy.ServiceProxy("/static_map", GetMap)().map
    process = started(
        ros, "/amcl", [program("amcl", "amcl"), "__name:=amcl", "_max_particles:=500"]
    )
    place = PoseWithCovarianceStamped()
    place.header.frame_id, place.pose.pose.orientation.w = "map", 1.0
    place.pose.covariance[0] = place.pose.covariance[7] = place.pose.covariance[35] = 0.1
    driver = Robot("base_link").connected()

    def still_localizes() -> None:
        rospy.wait_for_service("/request_nomotion_update", LIMIT_S)
        start = rospy.Publisher("/initialpose", PoseWithCovarianceStamped, queue_size=1)
        with recorder("/amcl_pose", PoseWithCovarianceStamped) as poses:
            seen = len(poses.messages)
            driver.drives_until(lambda: len(poses.messages) > seen + 2, "poses")
            rospy.ServiceProxy("/request_nomotion_update", Empty)()
        start.unregister()

    examples = {
        "/scan": room_scan(),
        "/tf": TFMessage([transform("odom", "base_link")]),
        "/initialpose": place,
        "/set_map": SetMapRequest(whole, place),
    }
    withstands(process, "/amcl", still_localizes, examples, driver.step, batch=40)
    driver.close()
