# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""turtlebot3_navigation drives turtlebot3_gazebo's robots; upstream's packages are found."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from pathlib import Path

import actionlib
import pytest
import rospy
import yaml
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import PoseWithCovarianceStamped
from harness import REPO, Launch, Ros, eventually, package, recorder
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from trident_sim.occupancy import MapConfig, occupancy_map

from trident_sim import SimulationWarning, World

Start = Callable[..., Launch]
MODELS = {"burger": 0.182, "waffle": 0.132}  # heights of their lidars [m]
START = (-2.0, -0.5)  # of turtlebot3_world.launch
NAMES = (
    "base_local_planner",
    "carrot_planner",
    "clear_costmap_recovery",
    "costmap_2d",
    "dwa_local_planner",
    "global_planner",
    "move_slow_and_clear",
    "nav_core",
    "navfn",
    "rotate_recovery",
    "voxel_grid",
)


@pytest.fixture(params=MODELS)
def model(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
def pillars_map(tmp_path: Path, model: str) -> Path:
    """The true map of turtlebot3_world, as the model's lidar sees it."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SimulationWarning)
        world = World(Path(package("turtlebot3_gazebo")) / "worlds/turtlebot3_world.world")
        occupancy_map(world, MapConfig(heights=(MODELS[model],), start=START)).save(
            tmp_path / "map.pgm"
        )
    return tmp_path / "map.yaml"


def pose_estimate() -> PoseWithCovarianceStamped:
    """As a click in rviz sends it."""
    message = PoseWithCovarianceStamped()
    message.header.frame_id = "map"
    message.pose.pose.position.x, message.pose.pose.position.y = START
    message.pose.pose.orientation.w = 1.0
    message.pose.covariance[0] = message.pose.covariance[7] = 0.25
    message.pose.covariance[35] = (math.pi / 12.0) ** 2
    return message


def test_a_turtlebot3_reaches_a_goal_between_the_pillars(
    launch: Start, ros: Ros, pillars_map: Path, model: str
) -> None:
    robot = f"turtlebot3_{model}"
    run = launch(
        "turtlebot3_gazebo",
        "turtlebot3_world.launch",
        gui=False,
        real_time_factor=2,  # more, and data are late
        env={"TURTLEBOT3_MODEL": model},
    ).spawned(robot)
    nodes = ros.launch(
        [
            *("roslaunch", "turtlebot3_navigation", "turtlebot3_navigation.launch"),
            *(f"map_file:={pillars_map}", "open_rviz:=false", "move_forward_only:=true"),
        ],
        TURTLEBOT3_MODEL=model,
    )
    client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
    assert client.wait_for_server(rospy.Duration(60.0)), nodes.log
    estimates = rospy.Publisher("/initialpose", PoseWithCovarianceStamped, queue_size=1)
    eventually(lambda: estimates.get_num_connections() > 0, "amcl")
    with recorder("/amcl_pose", PoseWithCovarianceStamped) as poses:

        def is_placed() -> bool:
            at = [message.pose.pose.position for message in poses.messages]
            if at and math.dist((at[-1].x, at[-1].y), START) < 0.3:
                return True
            estimates.publish(pose_estimate())  # before there is a map, amcl refuses it
            return False

        eventually(is_placed, "the pose")
    goal = MoveBaseGoal()
    goal.target_pose.header.frame_id = "map"
    goal.target_pose.pose.position.x, goal.target_pose.pose.position.y = 0.55, 0.55
    goal.target_pose.pose.orientation.w = 1.0
    client.send_goal(goal)
    assert client.wait_for_result(rospy.Duration(120.0)), nodes.log
    assert client.get_state() == GoalStatus.SUCCEEDED, nodes.log
    assert math.dist(run.position(robot)[:2], (0.55, 0.55)) < 0.05 + 0.15
    assert rospy.get_param("/move_base/DWAPlannerROS/min_vel_x") == 0.0
    assert "has no effect" not in nodes.log
    assert "is now called" not in nodes.log


@pytest.mark.parametrize("name", NAMES)
def test_upstreams_packages_are_found(name: str) -> None:
    assert (Path(package(name)) / "package.xml").is_file()


RVIZ = {
    "turtlebot3_navigation": Path(package("turtlebot3_navigation")) / "rviz",
    "navigation": REPO / "config" / "rviz",
}


@pytest.mark.parametrize("name", RVIZ)
def test_rviz_loads_its_configuration_without_a_display(ros: Ros, name: str) -> None:
    file = RVIZ[name] / f"{name}.rviz"
    viewer = ros.launch(["xvfb-run", "-a", "rosrun", "rviz", "rviz", "-d", str(file)])
    eventually(lambda: "/move_base_simple/goal" in topics(), viewer.log)
    assert not [line for line in viewer.log.splitlines() if "could not be loaded" in line]
    assert "ERROR" not in viewer.log, viewer.log


def topics() -> set[str]:
    return {name for name, _type in rospy.get_published_topics()}


@pytest.mark.parametrize("name", RVIZ)
def test_rviz_shows_topics_that_move_base_has(name: str) -> None:
    file = RVIZ[name] / f"{name}.rviz"
    manager = yaml.safe_load(file.read_text(encoding="utf-8"))["Visualization Manager"]
    shown = {display["Topic"] for display in manager["Displays"] if "Topic" in display}
    assert {f"/move_base/{one}_costmap/costmap" for one in ("global", "local")} <= shown
    assert {"/map", "/scan", "/move_base/NavfnROS/plan", "/move_base/current_goal"} <= shown
    tools = [tool.get("Topic") for tool in manager["Tools"]]
    assert {"/initialpose", "/move_base_simple/goal"} <= set(tools)
