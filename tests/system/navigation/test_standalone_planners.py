# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""costmap_2d_node, navfn_node and global_planner's planner do what they do without move_base."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
import rospy
from geometry_msgs.msg import PoseStamped
from harness import Ros, eventually, recorder
from nav_msgs.msg import OccupancyGrid
from nav_msgs.msg import Path as PathMessage
from navfn.srv import MakeNavPlan, MakeNavPlanRequest
from stand_in import StandIn

LIMIT_S = 60.0
PARAMETERS = """
costmap: {global_frame: odom, rolling_window: true, width: 8.0, height: 8.0, robot_radius: 0.2,
  update_frequency: 10.0, publish_frequency: 5.0,
  plugins: [{name: inflation_layer, type: "costmap_2d::InflationLayer"}]}
"""
# Package, program, what the planner's topics are below.
PLANNERS = {
    "navfn_node": ("navfn", "navfn_planner"),
    "planner": ("global_planner", "planner"),
}


@pytest.fixture
def robot() -> Iterator[StandIn]:
    stand_in = StandIn()
    yield stand_in
    stand_in.close()


def start(ros: Ros, folder: Path, package: str, program: str) -> str:
    """Its name."""
    file = folder / "parameters.yaml"
    file.write_text(PARAMETERS, encoding="utf-8")
    subprocess.run(["rosparam", "load", str(file), "/node"], check=True)
    ros.launch(["rosrun", package, program, "__name:=node"])
    return "/node"


def at(x: float) -> PoseStamped:
    pose = PoseStamped()
    pose.header.frame_id = "odom"
    pose.pose.position.x = x
    pose.pose.orientation.w = 1.0
    return pose


def ends_at(plan: PathMessage, x: float) -> bool:
    return bool(plan.poses) and plan.poses[-1].pose.position.x == pytest.approx(x)


@pytest.mark.usefixtures("robot")
def test_a_costmap_is_published_without_a_planner(ros: Ros, tmp_path: Path) -> None:
    name = start(ros, tmp_path, "costmap_2d", "costmap_2d_node")
    with recorder(f"{name}/costmap/costmap", OccupancyGrid) as grids:
        eventually(lambda: bool(grids.messages), "a costmap")
    assert grids.messages[0].info.width == 160
    assert grids.messages[0].header.frame_id == "odom"


@pytest.mark.usefixtures("robot")
@pytest.mark.parametrize("program", PLANNERS)
def test_a_planner_plans_on_a_costmap_of_its_own(ros: Ros, tmp_path: Path, program: str) -> None:
    package, below = PLANNERS[program]
    name = start(ros, tmp_path, package, program)
    rospy.wait_for_service(f"{name}/make_plan", LIMIT_S)
    make_plan = rospy.ServiceProxy(f"{name}/make_plan", MakeNavPlan)
    request = MakeNavPlanRequest(start=at(-1.0), goal=at(2.0))
    eventually(lambda: make_plan(request).plan_found == 1, "a plan")
    path = make_plan(request).path
    assert path[0].pose.position.x == pytest.approx(-1.0)
    assert path[-1].pose.position.x == pytest.approx(2.0)
    outside = make_plan(MakeNavPlanRequest(start=at(0.0), goal=at(100.0)))
    assert outside.plan_found == 0
    assert outside.error_message
    goals = rospy.Publisher(f"{name}/goal", PoseStamped, queue_size=1)
    with recorder(f"{name}/{below}/plan", PathMessage) as plans:
        eventually(lambda: goals.get_num_connections() > 0, "the node")
        goals.publish(at(1.0))
        eventually(lambda: any(ends_at(plan, 1.0) for plan in plans.messages), "a plan")
