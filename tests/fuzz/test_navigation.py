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
from costmap_2d.msg import VoxelGrid
from geometry_msgs.msg import Point32, Polygon, PoseStamped
from hostile import Robot, endures, messages, odometry, room_scan, started, transform, withstands
from move_base_msgs.msg import MoveBaseActionGoal
from nav_msgs.msg import OccupancyGrid, Odometry
from nav_msgs.srv import GetMap, GetPlan, GetPlanRequest
from navfn.srv import MakeNavPlan, MakeNavPlanRequest
from tf2_msgs.msg import TFMessage
from trident.testing import LIMIT_S, Process, Ros, eventually, package, program, recorder
from trident.testing.fuzz import Target
from visualization_msgs.msg import Marker

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
    # Hostile footprints have been legal, too.
    shapes = [
        rospy.Publisher(f"/move_base/{name}_costmap/footprint", Polygon, queue_size=1)
        for name in ("global", "local")
    ]
    for topic in shapes:
        eventually(lambda t=topic: t.get_num_connections() > 0, topic.name)  # type: ignore[misc]
    corners = ((-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1))
    square = Polygon(points=[Point32(x=x, y=y) for x, y in corners])
    request = GetPlanRequest(start=place(-1.0, -1.0), goal=place(1.5, 1.0), tolerance=0.2)

    def still_plans() -> None:
        rospy.wait_for_service("/move_base/make_plan", LIMIT_S)
        ask = rospy.ServiceProxy("/move_base/make_plan", GetPlan)
        maps.publish(whole)  # hostile ones have been legal, too
        for shape in shapes:
            shape.publish(square)

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
    for topic in (frames, odometries, maps, *shapes):
        topic.unregister()
    driver.close()


COSTMAP = {
    "global_frame": "odom",
    "robot_base_frame": "base_footprint",
    "rolling_window": True,
    "width": 6.0,
    "height": 6.0,
    "robot_radius": 0.2,
    # Apart from the one that is published, which is of another type: the master knows one a topic.
    "footprint_topic": "robot_footprint",
    "update_frequency": 20.0,
    "publish_frequency": 20.0,
    "plugins": [
        {"name": "obstacle_layer", "type": "costmap_2d::ObstacleLayer"},
        {"name": "inflation_layer", "type": "costmap_2d::InflationLayer"},
    ],
    "obstacle_layer": {"observation_sources": "scan", "scan": {"data_type": "LaserScan"}},
}


def standalone(ros: Ros, package_name: str, name: str) -> tuple[Process, Robot]:
    """A node with a costmap of its own, and the robot that it listens to."""
    ros.set_param("/node", {"costmap": COSTMAP})
    command = [program(package_name, name), "__name:=node"]
    process = started(ros, "/node", command)
    return process, Robot("base_footprint").connected()


@pytest.mark.fuzzes("costmap_2d/costmap_2d_node")
def test_a_costmap_alone(ros: Ros) -> None:
    process, driver = standalone(ros, "costmap_2d", "costmap_2d_node")

    def is_published() -> None:
        with recorder("/node/costmap/costmap", OccupancyGrid) as grids:
            driver.drives_until(lambda: bool(grids.messages), "a costmap")

    examples = {"/scan": room_scan(), "/tf": TFMessage([transform("odom", "base_footprint")])}
    withstands(process, "/node", is_published, examples, driver.step, batch=40)
    driver.close()


@pytest.mark.fuzzes("costmap_2d/costmap_2d_markers")
def test_cubes_of_voxels(ros: Ros) -> None:
    command = [program("costmap_2d", "costmap_2d_markers"), "__name:=cubes"]
    process = started(ros, "/cubes", command)
    grid = VoxelGrid(size_x=2, size_y=1, size_z=3, data=[1 << 17, 0])
    grid.resolutions.x = grid.resolutions.y = grid.resolutions.z = 0.1
    grids = rospy.Publisher("/voxel_grid", VoxelGrid, queue_size=1)
    eventually(lambda: grids.get_num_connections() > 0, grids.name)

    def still_shows() -> None:
        with recorder("/visualization_marker", Marker) as markers:

            def is_shown() -> bool:
                grids.publish(grid)
                return bool(markers.messages) and len(markers.messages[-1].points) == 1

            eventually(is_shown, "a cube")

    withstands(process, "/cubes", still_shows, {"/voxel_grid": grid})
    grids.unregister()


@pytest.mark.fuzzes("navfn/navfn_node", "global_planner/planner")
@pytest.mark.parametrize("names", [("navfn", "navfn_node"), ("global_planner", "planner")])
def test_a_planner_alone(ros: Ros, names: tuple[str, str]) -> None:
    process, driver = standalone(ros, *names)
    request = MakeNavPlanRequest(start=place(-0.2, 0.1), goal=place(0.4, 0.2))
    for pose in (request.start, request.goal):
        pose.header.frame_id = "odom"

    def still_plans() -> None:
        rospy.wait_for_service("/node/make_plan", LIMIT_S)
        ask = rospy.ServiceProxy("/node/make_plan", MakeNavPlan)

        def has_plan() -> bool:
            try:
                return bool(ask(request).plan_found == 1)
            except rospy.ServiceException:
                return False

        driver.drives_until(has_plan, "a plan")

    examples = {
        "/scan": room_scan(),
        "/tf": TFMessage([transform("odom", "base_footprint")]),
        "/node/goal": request.goal,
        "/node/make_plan": request,
    }
    withstands(process, "/node", still_plans, examples, driver.step, batch=40)
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
    # What it has started takes an interrupt as soon as one node of each is there.
    find = partial(ros.master.lookupNode, "/fuzz")

    def has_started() -> bool:
        assert process.running, process.log[-3000:]
        assert "RLException" not in process.log, process.log[-3000:]
        return all(find(node)[0] == 1 for node in ("/robot_state_publisher", "/move_base"))

    eventually(has_started, "the nodes of the drive", START_LIMIT_S)
    assert process.stop(limit_s=60.0) != 0, process.log[-3000:]  # it has reached no goal
    own = process.log.split("Traceback")
    assert len(own) == 1, own[1][:3000]
