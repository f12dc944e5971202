# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""navigation.launch in lockstep: map, amcl and move_base give equal drives, equal to the bit."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any
from xmlrpc.client import ServerProxy

import pytest
import rospy
import xacro
from harness import Gazebo, Ros, eventually, fresh_folder, package, pose
from move_base_msgs.msg import MoveBaseActionGoal
from std_srvs.srv import Empty
from trident_sim.occupancy import MapConfig, occupancy_map

from trident_sim import SimulationWarning, World

StartGazebo = Callable[..., Gazebo]
ROBOT = "my_nav_robot"
LIDAR_Z_M = 0.15
GOAL = (2.0, -1.0)
END_S = 14.0
READERS = {(topic, node) for topic in ("/scan", "/tf") for node in ("/amcl", "/move_base")}
WORLD = Path(package("trident_bringup")) / "worlds/room.world"


@pytest.fixture(scope="module")
def room_map(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The true map."""
    folder = tmp_path_factory.mktemp("map")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SimulationWarning)
        grid = occupancy_map(World(WORLD), MapConfig(heights=(LIDAR_Z_M,)))
    grid.save(folder / "room.pgm")
    return folder / "room.yaml"


def readers(ros: Ros) -> set[tuple[str, str]]:
    """Topic and node of connections that the simulator has: what it sends before reaches nobody."""
    node: Any = ServerProxy(ros.master.lookupNode("/test", "/gazebo")[2])
    return {(row[4], row[1]) for row in node.getBusInfo("/test")[2] if row[2] == "o"}


def amcl_has_a_map() -> bool:
    try:
        rospy.ServiceProxy("/request_nomotion_update", Empty)()
    except rospy.ServiceException:
        return False
    return True


def send_goal() -> None:
    """Before time begins."""
    goals = rospy.Publisher("/move_base/goal", MoveBaseActionGoal, queue_size=1, latch=True)
    eventually(lambda: goals.get_num_connections() > 0, "move_base")
    goal = MoveBaseActionGoal()
    goal.goal_id.id = "only"
    goal.goal.target_pose.header.frame_id = "map"
    goal.goal.target_pose.pose.position.x, goal.goal.target_pose.pose.position.y = GOAL
    goal.goal.target_pose.pose.orientation.w = 1.0
    goals.publish(goal)


def drive(ros: Ros, start_gazebo: StartGazebo, room_map: Path, label: str) -> dict[str, Any]:
    """A drive to the goal, its results."""
    out_dir = fresh_folder(ros.folder / label)
    urdf = Path(package("trident_description")) / f"urdf/{ROBOT}.urdf.xacro"
    description = xacro.process_file(str(urdf), mappings={"odometry_source": "encoder"}).toxml()
    for name in ("amcl", "move_base"):
        if rospy.has_param(name):
            rospy.delete_param(name)
    ros.set_param("/robot_description", description)
    gazebo = start_gazebo(
        str(WORLD),
        paused=True,
        real_time_factor=0.0,
        end_time=END_S,
        out_dir=out_dir,
        seed=3,
        lockstep_timeout=60.0,
        answers={"move_base": {"state": "/odom", "commands": ["/cmd_vel"]}},
    )
    gazebo.spawn(ROBOT, xml=description, at=pose(0.0, 0.0, 0.0), robot_namespace="/")
    ros.launch(["rosrun", "robot_state_publisher", "robot_state_publisher"])
    ros.launch(
        [
            *("roslaunch", "trident_bringup", "navigation.launch"),
            *(f"map_file:={room_map}", "lockstep:=true"),
        ]
    )
    eventually(amcl_has_a_map, "amcl's map")
    eventually(lambda: readers(ros) >= READERS, "all who read what the world publishes")
    send_goal()
    gazebo.ask("unpause_physics")
    results = gazebo.ended(limit_s=300.0)
    results["states"] = (Path(out_dir) / "states.csv").read_bytes()
    ros.clean()
    return results


def test_drives_with_amcl_repeat_to_the_bit(
    ros: Ros, start_gazebo: StartGazebo, room_map: Path
) -> None:
    first = drive(ros, start_gazebo, room_map, "first")
    assert first["end_reason"] == "end_time"
    again = drive(ros, start_gazebo, room_map, "again")
    assert first["states"] == again["states"]
    assert first["state_hash"] == again["state_hash"]
    rows = [row.split(",") for row in first["states"].decode().splitlines()]
    header, last = rows[0], [row for row in rows if ROBOT in row][-1]
    end = tuple(float(last[header.index(axis)]) for axis in ("x", "y"))
    assert math.dist(end, GOAL) < 0.2, end
