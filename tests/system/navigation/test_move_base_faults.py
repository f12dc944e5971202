# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What move_base says and does when something about it is wrong."""

from __future__ import annotations

import math
import os
import signal
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from xmlrpc.client import ServerProxy

import actionlib
import pytest
import rospy
import xacro
from actionlib_msgs.msg import GoalStatus
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Point32, Twist
from harness import Gazebo, Process, Ros, eventually, package, pose, recorder
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from nav_msgs.msg import OccupancyGrid, Odometry
from sensor_msgs.msg import LaserScan, PointCloud
from stand_in import StandIn

LIMIT_S = 60.0
PARAMETERS = """
base_local_planner: dwa_local_planner/DWAPlannerROS
controller_frequency: 10.0
planner_patience: 1.0
recovery_behavior_enabled: false
global_costmap: {global_frame: odom, rolling_window: true, width: 20.0, height: 20.0,
  robot_radius: 0.2, plugins: [{name: inflation_layer, type: "costmap_2d::InflationLayer"}]}
local_costmap: {global_frame: odom, rolling_window: true, width: 4.0, height: 4.0,
  robot_radius: 0.2, plugins: [{name: obstacle_layer, type: "costmap_2d::ObstacleLayer"},
    {name: inflation_layer, type: "costmap_2d::InflationLayer"}],
  obstacle_layer: {observation_sources: scan points,
    scan: {data_type: LaserScan, topic: /scan, marking: true, max_source_age: 0.0},
    points: {data_type: PointCloud, topic: /points, marking: true, max_source_age: 0.0}}}
DWAPlannerROS: {max_vel_x: 0.5, acc_lim_x: 2.5, max_vel_theta: 1.5}
"""


@pytest.fixture
def robot() -> Iterator[StandIn]:
    stand_in = StandIn()
    yield stand_in
    stand_in.close()


@pytest.fixture
def move_base(ros: Ros, tmp_path: Path, robot: StandIn) -> Process:
    assert robot.timer.is_alive()
    file = tmp_path / "parameters.yaml"
    file.write_text(PARAMETERS, encoding="utf-8")
    subprocess.run(["rosparam", "load", str(file), "/move_base"], check=True)
    return ros.launch(["rosrun", "move_base", "move_base"])


def client_of(node: Process) -> actionlib.SimpleActionClient:
    client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
    assert client.wait_for_server(rospy.Duration(LIMIT_S)), node.log
    return client


def goal_at(x: float, frame: str = "odom", w: float = 1.0) -> MoveBaseGoal:
    goal = MoveBaseGoal()
    goal.target_pose.header.frame_id = frame
    goal.target_pose.pose.position.x = x
    goal.target_pose.pose.orientation.w = w
    return goal


def counts(arrays: list[DiagnosticArray]) -> set[str]:
    """The kinds of problems that move_base has counted."""
    names = {status.name for array in arrays for status in array.status}
    return {name.split(": ")[1] for name in names if name.startswith("move_base: ")}


def scan(ranges: int, value: float, frame: str = "base_link") -> LaserScan:
    message = LaserScan(range_min=0.1, range_max=5.0, angle_increment=0.02)
    message.angle_min, message.angle_max = -1.8, 1.8
    message.header.frame_id = frame
    message.ranges = [value] * ranges
    return message


# What is sent on which topic, and what one message then says.
BAD: dict[str, tuple[str, Callable[[], object], str]] = {
    "blind scan": (
        "/scan",
        lambda: scan(181, math.nan),
        "all 181 ranges are NaN or below range_min = 0.1 m, legal: at least one",
    ),
    "cut scan": ("/scan", lambda: scan(60, 1.0), "ranges has 60 beams, legal: 181"),
    "frame": ("/scan", lambda: scan(181, 1.0, "nowhere"), "nowhere"),
    "odometry": ("/odom", lambda: odometry(math.nan), "linear.x is nan, legal: up to"),
    "goal": ("/move_base_simple/goal", lambda: goal_at(math.nan).target_pose, "position is (nan"),
}
KINDS = {"data", "transform", "odometry", "goal"}


def odometry(vx: float) -> Odometry:
    message = Odometry()
    message.twist.twist.linear.x = vx
    return message


def stamped(message: object) -> object:
    message.header.stamp = rospy.Time.now()  # type: ignore[attr-defined]
    return message


def test_bad_messages_are_each_named_and_counted(move_base: Process) -> None:
    client_of(move_base)
    with recorder("/diagnostics", DiagnosticArray) as reported:
        for topic, make, words in BAD.values():
            publisher = rospy.Publisher(topic, type(make()), queue_size=1)
            eventually(lambda out=publisher: out.get_num_connections() > 0, topic)

            def is_named(out: rospy.Publisher = publisher, made: object = make) -> bool:
                out.publish(stamped(made()))  # type: ignore[operator]
                return words in move_base.log  # noqa: B023

            eventually(is_named, words)
        eventually(lambda: counts(reported.messages) >= KINDS, str(KINDS))
    assert move_base.running


@pytest.mark.parametrize(
    ("goal", "words"),
    [
        (goal_at(math.nan), "invalid position"),
        (goal_at(1.0, w=0.0), "invalid quaternion: orientation is a quaternion of length 0"),
        (goal_at(1.0, frame="atlantis"), "planner_patience of 1 s is over: there is no transform"),
        (goal_at(50.0), "50"),
        (goal_at(1.0, frame=""), "it has no frame"),
    ],
    ids=["nan", "quaternion", "frame", "outside", "no frame"],
)
def test_goals_that_cannot_be_are_aborted_with_their_cause(
    move_base: Process, goal: MoveBaseGoal, words: str
) -> None:
    client = client_of(move_base)
    client.send_goal(goal)
    assert client.wait_for_result(rospy.Duration(LIMIT_S)), move_base.log
    assert client.get_state() == GoalStatus.ABORTED
    assert words in client.get_goal_status_text()


def test_a_robot_without_odometry_stands_and_continues_by_itself(
    move_base: Process, robot: StandIn
) -> None:
    client = client_of(move_base)
    client.send_goal(goal_at(8.0))
    with recorder("/cmd_vel", Twist) as commands:
        eventually(lambda: robot.x > 0.3, "motion")
        publisher, robot.odometry = robot.odometry, rospy.Publisher("unheard", Odometry)

        def stands() -> bool:
            newest = commands.messages[-3:]
            return len(newest) == 3 and all(one.linear.x == 0.0 for one in newest)

        eventually(stands, "the robot stands")
        eventually(lambda: "odometry" in move_base.log and "odom" in move_base.log, "a name")
        at_x = robot.x
        robot.odometry = publisher
        eventually(lambda: robot.x > at_x + 0.3, "motion again")
    assert client.get_state() == GoalStatus.ACTIVE


def hall(least_x: float, greatest_x: float, resolution: float) -> OccupancyGrid:
    """A free map about the robot's start, 8 m wide."""
    message = OccupancyGrid()
    message.header.frame_id = "odom"
    message.info.resolution = resolution
    message.info.width = round((greatest_x - least_x) / resolution)
    message.info.height = round(8.0 / resolution)
    message.info.origin.position.x, message.info.origin.position.y = least_x, -4.0
    message.info.origin.orientation.w = 1.0
    message.data = [0] * (message.info.width * message.info.height)
    return message


def test_a_goal_is_pursued_while_maps_of_other_sizes_and_resolutions_come(
    ros: Ros, tmp_path: Path, robot: StandIn
) -> None:
    file = tmp_path / "parameters.yaml"
    static = 'plugins: [{name: static_layer, type: "costmap_2d::StaticLayer"}, {'
    text = PARAMETERS.replace(
        "rolling_window: true, width: 20.0, height: 20.0,", "publish_frequency: 5.0,", 1
    )
    file.write_text(text.replace("plugins: [{", static, 1), encoding="utf-8")
    subprocess.run(["rosparam", "load", str(file), "/move_base"], check=True)
    node = ros.launch(["rosrun", "move_base", "move_base"])
    maps = rospy.Publisher("/map", OccupancyGrid, queue_size=1, latch=True)
    maps.publish(hall(-2.0, 4.0, 0.1))
    client = client_of(node)
    client.send_goal(goal_at(3.0))
    with recorder("/move_base/global_costmap/costmap", OccupancyGrid) as costmaps:

        def takes(map_: OccupancyGrid) -> None:
            maps.publish(map_)
            size = (map_.info.width, map_.info.height)
            eventually(
                lambda: any((m.info.width, m.info.height) == size for m in costmaps.messages),
                f"{size}: {node.log}",
            )

        eventually(lambda: robot.x > 0.3, "motion")
        takes(hall(-5.0, 10.0, 0.05))
        eventually(lambda: robot.x > 0.8, "motion in the second map")
        takes(hall(-1.0, 5.0, 0.08))
        assert client.wait_for_result(rospy.Duration(LIMIT_S)), node.log
    assert client.get_state() == GoalStatus.SUCCEEDED, node.log
    assert node.running


def test_rivals_that_command_the_robot_are_both_named(move_base: Process, robot: StandIn) -> None:
    client = client_of(move_base)
    client.send_goal(goal_at(8.0))
    rival = rospy.Publisher("/cmd_vel", Twist, queue_size=1)
    with recorder("/diagnostics", DiagnosticArray) as reported:
        eventually(lambda: robot.x > 0.1, "motion")
        eventually(lambda: rospy.get_name() in move_base.log, "the name of the rival")
        eventually(lambda: "command" in counts(reported.messages), "a count")
    (line,) = [line for line in move_base.log.splitlines() if rospy.get_name() in line]
    assert "/move_base" in line
    assert "/cmd_vel" in line
    rival.unregister()


@pytest.mark.usefixtures("robot")
def test_data_from_before_the_transforms_are_passed_over_when_newer_ones_are_used(
    move_base: Process,
) -> None:
    client_of(move_base)
    clouds = rospy.Publisher("/points", PointCloud, queue_size=5)
    eventually(lambda: clouds.get_num_connections() > 0, "move_base")
    cloud = PointCloud(points=[Point32(x=1.0, z=0.3)])
    cloud.header.frame_id = "base_link"
    begin = rospy.Time.now()
    with recorder("/odom", Odometry) as heard:
        while (rospy.Time.now() - begin).to_sec() < 3.0:
            seen = len(heard.messages)
            eventually(lambda count=seen: len(heard.messages) > count + 5, "odometry")
            cloud.header.stamp = rospy.Time.now()
            clouds.publish(cloud)
            cloud.header.stamp = begin - rospy.Duration(30.0)
            clouds.publish(cloud)
    assert "xtrapolation" not in move_base.log, move_base.log
    assert "are not used" not in move_base.log, move_base.log


def driven(ros: Ros, start_gazebo: Callable[..., Gazebo], folder: Path) -> tuple[Gazebo, Process]:
    """A simulated robot whose commands time out, and move_base."""
    name = "my_nav_robot"
    urdf = Path(package("trident_description")) / f"urdf/{name}.urdf.xacro"
    description = xacro.process_file(str(urdf), mappings={"command_timeout": "0.2"}).toxml()
    ros.set_param("/use_sim_time", True)
    ros.set_param("/robot_description", description)
    gazebo = start_gazebo(
        str(Path(package("trident_bringup")) / "worlds/room.world"),
        paused=False,
        real_time_factor=1.0,
    )
    gazebo.spawn(name, xml=description, at=pose(0.0, 0.0, 0.0), robot_namespace="/")
    ros.launch(["rosrun", "robot_state_publisher", "robot_state_publisher"])
    file = folder / "parameters.yaml"
    text = PARAMETERS.replace("global_frame:", "robot_base_frame: base_footprint, global_frame:")
    file.write_text(text, encoding="utf-8")
    subprocess.run(["rosparam", "load", str(file), "/move_base"], check=True)
    return gazebo, ros.launch(["rosrun", "move_base", "move_base"])


def pid_of(ros: Ros, name: str) -> int:
    node: Any = ServerProxy(ros.master.lookupNode("/test", name)[2])
    return int(node.getPid("/test")[2])


def speed(message: Odometry) -> float:
    twist = message.twist.twist
    return math.hypot(twist.linear.x, twist.linear.y) + 0.1 * abs(twist.angular.z)


def moved_m(a: Odometry, b: Odometry) -> float:
    p, q = a.pose.pose.position, b.pose.pose.position
    return math.dist((p.x, p.y), (q.x, q.y))


def test_a_killed_move_base_leaves_a_robot_that_stands_and_can_be_started_again(
    ros: Ros, start_gazebo: Callable[..., Gazebo], tmp_path: Path
) -> None:
    _gazebo, node = driven(ros, start_gazebo, tmp_path)
    client = client_of(node)
    client.send_goal(goal_at(3.5))
    with recorder("/ground_truth/odom", Odometry) as truth:
        eventually(lambda: bool(truth.messages) and speed(truth.messages[-1]) > 0.4, node.log)
        os.kill(pid_of(ros, "/move_base"), signal.SIGKILL)
        killed_s = truth.messages[-1].header.stamp.to_sec()
        eventually(lambda: truth.messages[-1].header.stamp.to_sec() > killed_s + 0.8, "time")
        late = [m for m in truth.messages if m.header.stamp.to_sec() > killed_s + 0.5]
        # It may rock on its springless caster, but it goes nowhere.
        assert moved_m(late[0], late[-1]) < 0.005
    again = ros.launch(["rosrun", "move_base", "move_base"])
    eventually(lambda: client.get_state() == GoalStatus.LOST, "the client knows")
    client = client_of(again)
    client.send_goal(goal_at(0.0))
    assert client.wait_for_result(rospy.Duration(LIMIT_S)), again.log
    assert client.get_state() == GoalStatus.SUCCEEDED


def test_a_goal_is_pursued_though_time_jumps_back(
    ros: Ros, start_gazebo: Callable[..., Gazebo], tmp_path: Path
) -> None:
    gazebo, node = driven(ros, start_gazebo, tmp_path)
    client = client_of(node)
    with recorder("/ground_truth/odom", Odometry) as truth:
        eventually(lambda: bool(truth.messages), "the truth")
        eventually(lambda: truth.messages[-1].header.stamp.to_sec() > 4.0, "some time to lose")
        client.send_goal(goal_at(2.0))
        eventually(lambda: truth.messages[-1].pose.pose.position.x > 0.3, node.log)
        gazebo.ask("reset_simulation")
        eventually(lambda: "time went back by" in node.log, node.log)
        assert client.wait_for_result(rospy.Duration(LIMIT_S)), node.log
        assert client.get_state() == GoalStatus.SUCCEEDED, node.log
        assert abs(truth.messages[-1].pose.pose.position.x - 2.0) < 0.2
