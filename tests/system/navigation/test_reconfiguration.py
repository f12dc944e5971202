# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""dynamic_reconfigure's own client and dynparam change move_base while it runs."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from pathlib import Path

import dynamic_reconfigure.client
import pytest
import rospy
from geometry_msgs.msg import Twist
from harness import Process, Ros, eventually, recorder
from move_base_msgs.msg import MoveBaseActionGoal
from nav_msgs.msg import OccupancyGrid
from stand_in import StandIn

LIMIT_S = 60.0
PARAMETERS = """
base_local_planner: dwa_local_planner/DWAPlannerROS
controller_frequency: 10.0
recovery_behavior_enabled: false
global_costmap: {global_frame: odom, rolling_window: true, width: 20.0, height: 20.0,
  robot_radius: 0.2, plugins: [{name: inflation_layer, type: costmap_2d::InflationLayer}]}
local_costmap: {global_frame: odom, rolling_window: true, width: 4.0, height: 4.0,
  robot_radius: 0.2, plugins: [{name: inflation_layer, type: costmap_2d::InflationLayer}]}
DWAPlannerROS: {max_vel_x: 0.5, acc_lim_x: 2.5, max_rot_vel: 1.5}
"""
SERVERS = {
    "/move_base": "planner_frequency",
    "/move_base/NavfnROS": "allow_unknown",
    "/move_base/DWAPlannerROS": "max_vel_x",
    "/move_base/global_costmap": "footprint_padding",
    "/move_base/global_costmap/inflation_layer": "inflation_radius",
    "/move_base/local_costmap": "width",
    "/move_base/local_costmap/inflation_layer": "cost_scaling_factor",
}


@pytest.fixture
def move_base(ros: Ros, tmp_path: Path) -> Iterator[Process]:
    file = tmp_path / "parameters.yaml"
    file.write_text(PARAMETERS, encoding="utf-8")
    subprocess.run(["rosparam", "load", str(file), "/move_base"], check=True)
    stand_in = StandIn()
    node = ros.launch(["rosrun", "move_base", "move_base"])
    rospy.wait_for_service("/move_base/set_parameters", LIMIT_S)
    yield node
    stand_in.close()


def client_of(name: str) -> dynamic_reconfigure.client.Client:
    return dynamic_reconfigure.client.Client(name, timeout=LIMIT_S)


@pytest.fixture
def goal_far_ahead(move_base: Process) -> None:
    goals = rospy.Publisher("/move_base/goal", MoveBaseActionGoal, queue_size=1)
    eventually(lambda: goals.get_num_connections() > 0, "move_base")
    goal = MoveBaseActionGoal()
    goal.goal.target_pose.header.frame_id = "odom"
    goal.goal.target_pose.pose.position.x = 8.0
    goal.goal.target_pose.pose.orientation.w = 1.0
    goals.publish(goal)


def fastest_of_the_last(commands: list[Twist], count: int) -> float:
    return max((twist.linear.x for twist in commands[-count:]), default=0.0)


@pytest.mark.usefixtures("goal_far_ahead")
def test_dynparam_slows_the_robot_down_while_it_drives(move_base: Process) -> None:
    with recorder("/cmd_vel", Twist) as commands:
        eventually(lambda: fastest_of_the_last(commands.messages, 3) > 0.4, move_base.log)
        subprocess.run(
            [
                *("rosrun", "dynamic_reconfigure", "dynparam", "set"),
                *("/move_base/DWAPlannerROS", "max_vel_x", "0.1"),
            ],
            check=True,
            timeout=LIMIT_S,
        )
        # 0.4 m/s to shed at 2.5 m/s^2, in periods of 0.1 s.
        seen = len(commands.messages)
        eventually(lambda: len(commands.messages) > seen + 8, "more commands")
        speeds = [twist.linear.x for twist in commands.messages[seen + 4 : seen + 8]]
    assert max(speeds) <= 0.1 + 1e-9, speeds
    assert min(speeds) > 0.0, speeds
    assert rospy.get_param("/move_base/DWAPlannerROS/max_vel_x") == 0.1


@pytest.mark.parametrize("name", SERVERS)
def test_each_part_has_a_server_under_upstreams_name(move_base: Process, name: str) -> None:
    client = client_of(name)
    described = {one["name"] for one in client.get_parameter_descriptions(LIMIT_S)}
    assert SERVERS[name] in described, move_base.log
    assert SERVERS[name] in client.get_configuration(LIMIT_S)


def test_values_are_those_of_the_parameters_under_their_new_names(move_base: Process) -> None:
    config = client_of("/move_base/DWAPlannerROS").get_configuration(LIMIT_S)
    assert config["max_vel_x"] == 0.5
    assert config["max_vel_theta"] == 1.5
    assert config["sim_time"] == 1.7, move_base.log


def test_values_out_of_range_are_cut_or_refused_with_one_message(move_base: Process) -> None:
    client = client_of("/move_base/DWAPlannerROS")
    assert client.update_configuration({"vx_samples": 5000})["vx_samples"] == 1000
    eventually(lambda: "vx_samples = 5000 has become 1000" in move_base.log, "a message")
    client = client_of("/move_base/local_costmap")
    before = client.get_configuration(LIMIT_S)["width"]
    assert client.update_configuration({"width": -1.0})["width"] == before
    eventually(lambda: "width" in move_base.log.split("has become 1000")[-1], "another message")


def test_a_costmap_takes_another_size_and_inflation(move_base: Process) -> None:
    client_of("/move_base/local_costmap").update_configuration(
        {"width": 2.0, "publish_frequency": 5.0}
    )
    with recorder("/move_base/local_costmap/costmap", OccupancyGrid) as grids:
        eventually(lambda: bool(grids.messages), "a costmap")
        eventually(lambda: grids.messages[-1].info.width == 40, move_base.log)
    changed = client_of("/move_base/local_costmap/inflation_layer").update_configuration(
        {"inflation_radius": 0.3, "enabled": False}
    )
    assert changed["inflation_radius"] == 0.3
    assert not changed["enabled"]


def test_defaults_are_restored(move_base: Process) -> None:
    client = client_of("/move_base")
    assert client.update_configuration({"planner_frequency": 3.0})["planner_frequency"] == 3.0
    restored = client.update_configuration({"restore_defaults": True})
    assert restored["planner_frequency"] == 0.0, move_base.log
    assert not restored["restore_defaults"]
