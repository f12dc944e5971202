# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Topics of local planners, planners and costmaps have upstream's names and types."""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import rospy
from costmap_2d.msg import VoxelGrid
from costmap_converter.msg import ObstacleArrayMsg, ObstacleMsg
from geometry_msgs.msg import Point32, Polygon, PolygonStamped, PoseArray, PoseStamped, Twist
from harness import Process, Recorder, Ros, eventually, recorder
from move_base_msgs.msg import MoveBaseActionGoal
from nav_msgs.msg import OccupancyGrid
from nav_msgs.msg import Path as PathMessage
from sensor_msgs.msg import PointCloud, PointCloud2
from stand_in import StandIn
from teb_local_planner.msg import FeedbackMsg
from visualization_msgs.msg import Marker, MarkerArray

COMMON = """
controller_frequency: 10.0
recovery_behavior_enabled: false
planner_frequency: 2.0
base_global_planner: {planner}
base_local_planner: {controller}
global_costmap: {{global_frame: odom, rolling_window: true, width: 12.0, height: 12.0,
  robot_radius: 0.2, plugins: [{{name: inflation_layer, type: "costmap_2d::InflationLayer"}}]}}
local_costmap: {{global_frame: odom, rolling_window: true, width: 4.0, height: 4.0,
  publish_frequency: 5.0, update_frequency: 10.0,
  footprint: [[-0.2, -0.2], [0.2, -0.2], [0.2, 0.2], [-0.2, 0.2]],
  plugins: [{{name: obstacle_layer, type: "costmap_2d::VoxelLayer"}},
    {{name: inflation_layer, type: "costmap_2d::InflationLayer"}}],
  obstacle_layer: {{publish_voxel_map: true, observation_sources: points, points:
    {{data_type: PointCloud, topic: /points, marking: true, clearing: true,
      max_source_age: 0.0}}}}}}
"""
LIMITS = "max_vel_x: 0.4, acc_lim_x: 1.0, max_vel_theta: 1.0, acc_lim_theta: 2.0"
PLUGINS = {
    "teb": ("navfn/NavfnROS", "teb_local_planner/TebLocalPlannerROS"),
    "dwa": ("global_planner/GlobalPlanner", "dwa_local_planner/DWAPlannerROS"),
    "mppi": ("navfn/NavfnROS", "nav2_mppi_controller::MPPIController"),
}
OWN = f"""
NavfnROS: {{visualize_potential: true}}
TebLocalPlannerROS: {{publish_feedback: true, {LIMITS}}}
DWAPlannerROS: {{publish_traj_pc: true, publish_cost_grid_pc: true, {LIMITS}}}
MPPIController: {{visualize: true, batch_size: 400, {LIMITS}}}
"""
# Below the local planner's name: type, and what says that a message is not empty.
Filled = Callable[[Any], int]
TOPICS: dict[str, dict[str, tuple[type, Filled]]] = {
    "teb": {
        "TebLocalPlannerROS/local_plan": (PathMessage, lambda m: len(m.poses)),
        "TebLocalPlannerROS/teb_poses": (PoseArray, lambda m: len(m.poses)),
        "TebLocalPlannerROS/teb_markers": (Marker, lambda m: len(m.points)),
        "TebLocalPlannerROS/teb_feedback": (FeedbackMsg, lambda m: len(m.trajectories)),
        "NavfnROS/potential": (PointCloud2, lambda m: m.width),
    },
    "dwa": {
        "DWAPlannerROS/local_plan": (PathMessage, lambda m: len(m.poses)),
        "DWAPlannerROS/cost_cloud": (PointCloud2, lambda m: m.width),
        "DWAPlannerROS/trajectory_cloud": (PointCloud2, lambda m: m.width),
        "GlobalPlanner/potential": (OccupancyGrid, lambda m: max(m.data)),
    },
    "mppi": {
        "MPPIController/local_plan": (PathMessage, lambda m: len(m.poses)),
        "MPPIController/optimal_trajectory": (PathMessage, lambda m: len(m.poses)),
        "MPPIController/trajectories": (MarkerArray, lambda m: len(m.markers[0].points)),
    },
}


@pytest.fixture
def robot() -> Iterator[StandIn]:
    stand_in = StandIn()
    yield stand_in
    stand_in.close()


def start(ros: Ros, folder: Path, name: str) -> Process:
    planner, controller = PLUGINS[name]
    file = folder / "parameters.yaml"
    text = COMMON.format(planner=planner, controller=controller) + OWN
    file.write_text(text, encoding="utf-8")
    if rospy.has_param("/move_base"):
        rospy.delete_param("/move_base")
    subprocess.run(["rosparam", "load", str(file), "/move_base"], check=True)
    return ros.launch(["rosrun", "move_base", "move_base"])


def send_goal(x: float) -> None:
    goals = rospy.Publisher("/move_base/goal", MoveBaseActionGoal, queue_size=1)
    eventually(lambda: goals.get_num_connections() > 0, "move_base")
    goal = MoveBaseActionGoal()
    goal.goal.target_pose.header.frame_id = "odom"
    goal.goal.target_pose.pose.position.x = x
    goal.goal.target_pose.pose.orientation.w = 1.0
    goals.publish(goal)


@pytest.mark.usefixtures("robot")
@pytest.mark.parametrize("name", PLUGINS)
def test_what_a_local_planner_weighs_is_published(ros: Ros, tmp_path: Path, name: str) -> None:
    node = start(ros, tmp_path, name)
    send_goal(5.0)
    for topic, (kind, filled) in TOPICS[name].items():
        with recorder(f"/move_base/{topic}", kind) as heard:

            def is_filled(seen: Recorder = heard, fills: Filled = filled) -> bool:
                return any(map(fills, seen.messages))

            eventually(is_filled, topic)
    assert "ERROR" not in node.log, node.log


def wall_across(x: float) -> ObstacleArrayMsg:
    message = ObstacleArrayMsg()
    message.header.frame_id = "odom"
    message.obstacles = [ObstacleMsg(id=4)]
    message.obstacles[0].polygon.points = [Point32(x=x, y=-6.0), Point32(x=x, y=6.0)]
    return message


@pytest.mark.parametrize("name", ["teb", "dwa"])
def test_a_robot_stops_before_an_obstacle_that_others_report(
    ros: Ros, tmp_path: Path, robot: StandIn, name: str
) -> None:
    node = start(ros, tmp_path, name)
    space = PLUGINS[name][1].split("/")[1]
    topic = f"/move_base/{space}/obstacles"
    obstacles = rospy.Publisher(topic, ObstacleArrayMsg, queue_size=1)
    eventually(lambda: obstacles.get_num_connections() > 0, topic)
    wall = wall_across(1.5)

    def report(_event: object) -> None:
        wall.header.stamp = rospy.Time.now()
        obstacles.publish(wall)

    timer = rospy.Timer(rospy.Duration(0.1), report)
    send_goal(4.0)
    try:
        with recorder("/cmd_vel", Twist) as commands:
            eventually(lambda: robot.x > 0.3, "motion")
            seen = len(commands.messages)
            eventually(lambda: len(commands.messages) > seen + 60, "commands")
    finally:
        timer.shutdown()
    assert robot.x + 0.2 < 1.5, robot.x
    wall.obstacles[0].radius = -1.0
    obstacles.publish(wall)
    eventually(lambda: "obstacles[0]: radius = -1 m, legal: 0 to" in node.log, "a refusal")


@pytest.mark.usefixtures("robot")
def test_bands_pass_the_via_points_of_a_message(ros: Ros, tmp_path: Path) -> None:
    start(ros, tmp_path, "teb")
    topic = "/move_base/TebLocalPlannerROS/via_points"
    points = rospy.Publisher(topic, PathMessage, queue_size=1, latch=True)
    path = PathMessage()
    path.header.frame_id = "odom"
    point = PoseStamped()
    point.pose.position.x, point.pose.position.y = 1.0, 0.5
    path.poses = [point]
    eventually(lambda: points.get_num_connections() > 0, topic)
    points.publish(path)
    send_goal(5.0)
    with recorder("/move_base/TebLocalPlannerROS/teb_markers", Marker) as markers:
        eventually(
            lambda: any(m.ns == "ViaPoints" and len(m.points) == 1 for m in markers.messages),
            "the via point",
        )


@pytest.mark.usefixtures("robot")
def test_a_footprint_of_another_node_replaces_the_one_of_the_file(ros: Ros, tmp_path: Path) -> None:
    node = start(ros, tmp_path, "dwa")
    topic = "/move_base/local_costmap/footprint"
    with recorder(topic, PolygonStamped) as footprints:
        eventually(lambda: bool(footprints.messages), topic)
        polygons = rospy.Publisher(topic, Polygon, queue_size=1)
        eventually(lambda: polygons.get_num_connections() > 0, topic)
        corners = ((-0.3, -0.1), (0.3, -0.1), (0.3, 0.1), (-0.3, 0.1))
        polygons.publish(Polygon(points=[Point32(x=x, y=y) for x, y in corners]))

        def width() -> float:
            xs = [p.x for p in footprints.messages[-1].polygon.points]
            return max(xs) - min(xs)

        eventually(lambda: abs(width() - 0.6 - 2 * 0.01) < 1e-3, "the new footprint")
        polygons.publish(Polygon(points=[Point32(x=1.0), Point32(x=2.0)]))
        eventually(lambda: "is not used" in node.log, "a refusal")
        assert abs(width() - 0.62) < 1e-3


@pytest.mark.usefixtures("robot")
def test_voxels_and_ends_of_clearing_beams_are_published(ros: Ros, tmp_path: Path) -> None:
    start(ros, tmp_path, "dwa")
    below = "/move_base/local_costmap/obstacle_layer"
    clouds = rospy.Publisher("/points", PointCloud, queue_size=1)
    cloud = PointCloud(points=[Point32(x=1.02, y=0.52, z=0.5)])
    cloud.header.frame_id = "base_link"
    ros.launch(["rosrun", "costmap_2d", "costmap_2d_markers", f"voxel_grid:={below}/voxel_grid"])
    with (
        recorder("/visualization_marker", Marker) as cubes,
        recorder(f"{below}/voxel_grid", VoxelGrid) as voxels,
        recorder(f"{below}/clearing_endpoints", PointCloud) as ends,
    ):

        def is_marked() -> bool:
            cloud.header.stamp = rospy.Time.now()
            clouds.publish(cloud)
            return any(any(column >> 18 & 1 for column in m.data) for m in voxels.messages)

        eventually(is_marked, "a voxel at 0.5 m")
        eventually(lambda: bool(ends.messages), "ends of beams")
        eventually(lambda: any(m.points for m in cubes.messages), "cubes")
    cube = next(m.points[0] for m in cubes.messages if m.points)
    assert (cube.x, cube.y, cube.z) == pytest.approx((1.025, 0.525, 0.5), abs=0.03)
    grid = voxels.messages[-1]
    assert (grid.size_x, grid.size_y, grid.size_z) == (80, 80, 10)
    assert grid.resolutions.z == pytest.approx(0.2)
    assert grid.header.frame_id == "odom"
    assert ends.messages[-1].points[0].x == pytest.approx(1.02, abs=1e-4)
