# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""move_base in lockstep with the simulator: as fast as possible, and equal to the bit."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import rospy
import xacro
from geometry_msgs.msg import Twist
from harness import Gazebo, Ros, eventually, fresh_folder, package, pose, recorder
from move_base_msgs.msg import MoveBaseActionGoal

StartGazebo = Callable[..., Gazebo]
ROBOT = "turtlebot3_burger"
START, GOAL = (-2.0, -0.5), (0.55, 0.55)  # between the pillars of turtlebot3_world
END_S = 30.0
SETTLED = 60  # answers: two seconds, by which goals are taken
PARAMETERS = Path(package("turtlebot3_navigation")) / "param"
# Odometry in the world's frame, so that neither a map nor a localization is needed.
COSTMAPS = """
lockstep: true
base_local_planner: dwa_local_planner/DWAPlannerROS
global_costmap: {global_frame: odom, static_map: false, rolling_window: true, width: 12.0,
  height: 12.0}
"""


LATE = "a goal has come after"


def load(file: Path, name_space: str) -> None:
    subprocess.run(["rosparam", "load", str(file), name_space], check=True)


def start_move_base(ros: Ros) -> None:
    for costmap in ("global_costmap", "local_costmap"):
        load(PARAMETERS / "costmap_common_params_burger.yaml", f"/move_base/{costmap}")
    for name in ("local_costmap", "global_costmap", "move_base", "dwa_local_planner"):
        suffix = "_burger" if name == "dwa_local_planner" else ""
        load(PARAMETERS / f"{name}_params{suffix}.yaml", "/move_base")
    file = ros.folder / "lockstep.yaml"
    file.write_text(COSTMAPS, encoding="utf-8")
    load(file, "/move_base")
    ros.launch(["rosrun", "move_base", "move_base"])


def send_goal() -> None:
    """Before time begins it is there with the first odometry of each run, later by chance."""
    goals = rospy.Publisher("/move_base/goal", MoveBaseActionGoal, queue_size=1, latch=True)
    eventually(lambda: goals.get_num_connections() > 0, "move_base")
    goal = MoveBaseActionGoal()
    goal.goal_id.id = "only"
    goal.goal.target_pose.header.frame_id = "odom"
    goal.goal.target_pose.pose.position.x, goal.goal.target_pose.pose.position.y = GOAL
    goal.goal.target_pose.pose.orientation.w = 1.0
    goals.publish(goal)


def drive(
    ros: Ros, start_gazebo: StartGazebo, label: str, *, is_late: bool = False
) -> dict[str, Any]:
    """A drive to the goal, its results; late: the goal comes when the world runs already."""
    out_dir = fresh_folder(ros.folder / label)
    urdf = Path(package("turtlebot3_description")) / f"urdf/{ROBOT}.urdf.xacro"
    description = xacro.process_file(str(urdf), mappings={}).toxml()
    ros.set_param("/robot_description", description)
    gazebo = start_gazebo(
        str(Path(package("turtlebot3_gazebo")) / "worlds/turtlebot3_world.world"),
        paused=True,
        real_time_factor=0.0,
        **({} if is_late else {"end_time": END_S}),
        out_dir=out_dir,
        seed=1,
        lockstep_timeout=60.0,
        answers={"move_base": {"state": "/odom", "commands": ["/cmd_vel"]}},
    )
    gazebo.spawn(ROBOT, xml=description, at=pose(*START, 0.0), robot_namespace="/")
    ros.launch(["rosrun", "robot_state_publisher", "robot_state_publisher"])
    start_move_base(ros)
    if is_late:
        with recorder("/cmd_vel", Twist) as answers:
            gazebo.ask("unpause_physics")
            eventually(lambda: len(answers.messages) > SETTLED, "answers without a goal")
            send_goal()
            eventually(lambda: LATE in gazebo.log, "the simulator's word about it")
        results = gazebo.finish()
    else:
        send_goal()
        gazebo.ask("unpause_physics")
        results = gazebo.ended(limit_s=300.0)
    results["states"] = (Path(out_dir) / "states.csv").read_bytes()
    ros.clean()
    return results


def test_a_goal_that_comes_by_chance_is_named_in_the_verdict(
    ros: Ros, start_gazebo: StartGazebo
) -> None:
    results = drive(ros, start_gazebo, "late", is_late=True)
    assert not results["repeatable"]
    assert any(LATE in str(note) for note in results["not_repeatable"])


def test_a_drive_as_fast_as_possible_repeats_to_the_bit(
    ros: Ros, start_gazebo: StartGazebo
) -> None:
    first = drive(ros, start_gazebo, "first")
    assert first["end_reason"] == "end_time"
    again = drive(ros, start_gazebo, "again")
    assert first["states"] == again["states"]
    assert first["state_hash"] == again["state_hash"]
    rows = [row.split(",") for row in first["states"].decode().splitlines()]
    header, last = rows[0], [row for row in rows if ROBOT in row][-1]
    x, y = (float(last[header.index(axis)]) for axis in ("x", "y"))
    assert abs(x - GOAL[0]) < 0.15, (x, y)
    assert abs(y - GOAL[1]) < 0.15, (x, y)
