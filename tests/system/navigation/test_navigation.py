# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""move_base drives a robot to goals of an ordinary action client, judged by the truth."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from pathlib import Path

import actionlib
import pytest
import rospy
from actionlib_msgs.msg import GoalStatus
from harness import Launch, Process, Ros, eventually, package
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from nav_msgs.msg import OccupancyGrid
from nav_msgs.srv import GetPlan, GetPlanRequest
from trident_sim.occupancy import MapConfig, occupancy_map

from trident_sim import SimulationWarning, World

Start = Callable[..., Launch]
ROBOT = "my_nav_robot"
LIDAR_Z_M = 0.15
GOAL_LIMIT_S = 90.0


@pytest.fixture(scope="module")
def room_map(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The true map of worlds/room.world."""
    folder = tmp_path_factory.mktemp("map")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SimulationWarning)
        world = World(Path(package("trident_bringup")) / "worlds/room.world")
        occupancy_map(world, MapConfig(heights=(LIDAR_Z_M,))).save(folder / "room.pgm")
    return folder / "room.yaml"


def navigation(ros: Ros, room_map: Path) -> Process:
    return ros.launch(
        ["roslaunch", "trident_bringup", "navigation.launch", f"map_file:={room_map}"]
    )


def goal_at(x: float, y: float, yaw: float) -> MoveBaseGoal:
    goal = MoveBaseGoal()
    goal.target_pose.header.frame_id = "map"
    goal.target_pose.pose.position.x = x
    goal.target_pose.pose.position.y = y
    goal.target_pose.pose.orientation.z = math.sin(yaw / 2)
    goal.target_pose.pose.orientation.w = math.cos(yaw / 2)
    return goal


def client_of(process: Process) -> actionlib.SimpleActionClient:
    client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
    assert client.wait_for_server(rospy.Duration(60.0)), process.log
    return client


def test_a_robot_reaches_goals_around_a_wall(launch: Start, ros: Ros, room_map: Path) -> None:
    run = launch("trident_bringup", "robot_in_room.launch", real_time_factor=2).spawned(ROBOT)
    nodes = navigation(ros, room_map)
    client = client_of(nodes)
    for x, y, yaw in ((-1.0, 3.5, 3.1), (3.0, -3.5, -1.57), (0.0, 0.0, 0.0)):
        client.send_goal(goal_at(x, y, yaw))
        assert client.wait_for_result(rospy.Duration(GOAL_LIMIT_S)), nodes.log
        assert client.get_goal_status_text() == "Goal reached.", nodes.log
        assert client.get_state() == GoalStatus.SUCCEEDED
        # The tolerance, and what amcl is off.
        assert math.dist(run.position(ROBOT)[:2], (x, y)) < 0.1 + 0.1
        assert abs(run.position(ROBOT)[2]) < 0.05


def test_a_goal_in_a_wall_is_given_up_with_its_cause(
    launch: Start, ros: Ros, room_map: Path
) -> None:
    launch("trident_bringup", "robot_in_room.launch", real_time_factor=4).spawned(ROBOT)
    nodes = navigation(ros, room_map)
    client = client_of(nodes)
    client.send_goal(goal_at(-1.0, 2.0, 0.0))
    assert client.wait_for_result(rospy.Duration(120.0)), nodes.log
    assert client.get_state() == GoalStatus.ABORTED
    text = client.get_goal_status_text()
    sentence = "Failed to find a valid plan. Even after executing recovery behaviors. "
    assert text.startswith(sentence)
    assert "planner_patience of 5 s is over" in text
    assert "-1.00, 2.00" in text


def test_services_and_topics_are_upstreams(launch: Start, ros: Ros, room_map: Path) -> None:
    launch("trident_bringup", "robot_in_room.launch", real_time_factor=4).spawned(ROBOT)
    nodes = navigation(ros, room_map)
    client_of(nodes)
    costs = rospy.wait_for_message("/move_base/global_costmap/costmap", OccupancyGrid, 60.0)
    assert costs.header.frame_id == "map"
    assert {-1, 0, 99, 100} >= set(costs.data) - set(range(1, 99))
    request = GetPlanRequest()
    request.start = goal_at(0.0, 0.0, 0.0).target_pose
    request.goal = goal_at(-1.0, 3.5, 0.0).target_pose
    make_plan = rospy.ServiceProxy("/move_base/make_plan", GetPlan)
    eventually(lambda: len(make_plan(request).plan.poses) > 10, "a plan")
    poses = make_plan(request).plan.poses
    assert poses[-1].pose.position.x == pytest.approx(-1.0)
    assert poses[-1].pose.position.y == pytest.approx(3.5)
