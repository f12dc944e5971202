# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""move_base and the drive that judges it under hostile messages."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

import pytest
import rospy
import yaml
from geometry_msgs.msg import PoseStamped
from hostile import Robot, endures, messages, odometry, room_scan, started, transform, withstands
from move_base_msgs.msg import MoveBaseActionGoal
from nav_msgs.msg import OccupancyGrid, Odometry
from nav_msgs.srv import GetMap, GetPlan, GetPlanRequest
from tf2_msgs.msg import TFMessage
from trident.testing import LIMIT_S, Ros, eventually, package, program
from trident.testing.fuzz import Target

#: For two roslaunch and what they start, one after the other.
START_LIMIT_S = 3 * LIMIT_S
CONFIG = package("trident_bringup") / "config" / "nav"


def parameters() -> dict[str, Any]:
    """What navigation.launch gives move_base."""
    result: dict[str, Any] = {}
    for file in ("move_base.yaml", "costmaps.yaml", "robots/my_nav_robot.yaml"):
        for key, value in yaml.safe_load((CONFIG / file).read_text(encoding="utf-8")).items():
            old = result.get(key)
            result[key] = {**old, **value} if isinstance(old, dict) else value
    return result


def place(x: float, y: float) -> PoseStamped:
    message = PoseStamped()
    message.header.frame_id = "map"
    message.pose.position.x, message.pose.position.y, message.pose.orientation.w = x, y, 1.0
    return message


@pytest.mark.fuzzes("move_base/move_base")
def test_move_base(ros: Ros, map_file: Path) -> None:
    started(ros, "/maps", [program("map_server", "map_server"), str(map_file), "__name:=maps"])
    ros.set_param("/move_base", parameters())
    process = started(ros, "/move_base", [program("move_base", "move_base"), "__name:=move_base"])
    driver = Robot("base_footprint").connected()
    frames = rospy.Publisher("/tf", TFMessage, queue_size=100, tcp_nodelay=True)
    odometries = rospy.Publisher("/odom", Odometry, queue_size=10, tcp_nodelay=True)
    for topic in (frames, odometries):
        eventually(lambda t=topic: t.get_num_connections() > 0, topic.name)  # type: ignore[misc]

    def step() -> None:
        frames.publish(TFMessage([transform("map", "odom")]))
        odometries.publish(odometry())
        driver.step()

    rospy.wait_for_service("/static_map", LIMIT_S)
    whole = rospy.ServiceProxy("/static_map", GetMap)().map
    maps = rospy.Publisher("/map", OccupancyGrid, queue_size=1)
    eventually(lambda: maps.get_num_connections() > 0, maps.name)
    request = GetPlanRequest(start=place(-1.0, -1.0), goal=place(1.5, 1.0), tolerance=0.2)

    def still_plans() -> None:
        rospy.wait_for_service("/move_base/make_plan", LIMIT_S)
        ask = rospy.ServiceProxy("/move_base/make_plan", GetPlan)
        maps.publish(whole)  # hostile ones have been legal, too

        def has_plan() -> bool:
            step()
            try:
                return len(ask(request).plan.poses) > 1
            except rospy.ServiceException:
                return False

        eventually(has_plan, "a plan")

    goal = MoveBaseActionGoal()
    goal.goal.target_pose = place(1.0, 1.0)
    examples = {
        "/scan": room_scan(),
        "/tf": TFMessage([transform("odom", "base_footprint")]),
        "/odom": odometry(),
        "/move_base/goal": goal,
        "/move_base_simple/goal": place(1.0, 1.0),
        "/move_base/make_plan": request,
    }
    withstands(process, "/move_base", still_plans, examples, step, batch=40)
    for topic in (frames, odometries, maps):
        topic.unregister()
    driver.close()


@pytest.mark.fuzzes("trident_benchmarks/navigate.py")
def test_a_drive_to_goals_waits_on(ros: Ros, tmp_path: Path) -> None:
    """There is no simulator: it hears where its robot is said to be, and waits for move_base."""
    ros.set_param("/run_id", "fuzz")  # as an outer roslaunch does: the inner ones share it
    robot = str(CONFIG / "robots" / "my_nav_robot.yaml")
    ros.set_param("/drive", {"world": "room", "robot_config": robot, "out_dir": str(tmp_path)})
    command = [program("trident_benchmarks", "navigate.py"), "__name:=drive"]
    process = started(ros, "/drive", command)
    target = Target("/drive")
    eventually(lambda: "/move_base/recovery_status" in target.subscriptions(), "its subscriptions")
    endures(target, messages(10))
    # What it has started takes an interrupt as soon as one node of it is there.
    is_there = partial(ros.master.lookupNode, "/fuzz", "/robot_state_publisher")

    def has_started() -> bool:
        assert process.running, process.log[-3000:]
        assert "RLException" not in process.log, process.log[-3000:]
        return bool(is_there()[0] == 1)

    eventually(has_started, "the nodes of the drive", START_LIMIT_S)
    assert process.stop(limit_s=60.0) != 0, process.log[-3000:]  # it has reached no goal
    own = process.log.split("Traceback")
    assert len(own) == 1, own[1][:3000]
