# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A client of move_base as users write it: python3 -m ...goal_client [--for SECONDS] X,Y,YAW ...

Sends the goals one after the other, from the beginning again for so many simulated seconds, and
prints a line of JSON for each: state, text, and the simulated time that it took.
"""

from __future__ import annotations

import argparse
import itertools
import json
import math
import sys

import actionlib
import rospy
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal


def message(x: float, y: float, yaw: float) -> MoveBaseGoal:
    """A goal in the map."""
    goal = MoveBaseGoal()
    goal.target_pose.header.frame_id = "map"
    goal.target_pose.pose.position.x = x
    goal.target_pose.pose.position.y = y
    goal.target_pose.pose.orientation.z = math.sin(yaw / 2.0)
    goal.target_pose.pose.orientation.w = math.cos(yaw / 2.0)
    return goal


def main() -> int:
    """Send the goals.

    Returns:
        Exit code 0.
    """
    parser = argparse.ArgumentParser()
    parser.add_argument("--for", dest="duration_s", type=float, default=0.0)
    parser.add_argument("goals", nargs="+")
    options = parser.parse_args(rospy.myargv(sys.argv)[1:])
    goals = [[float(value) for value in goal.split(",")] for goal in options.goals]
    rospy.init_node("goal_client")
    client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
    client.wait_for_server()
    begun_s = rospy.get_time()
    for number, (x, y, yaw) in enumerate(itertools.cycle(goals)):
        if number >= len(goals) and rospy.get_time() - begun_s >= options.duration_s:
            break
        sent_s = rospy.get_time()
        client.send_goal(message(x, y, yaw))
        client.wait_for_result()
        time_s = rospy.get_time() - sent_s
        row = {"state": client.get_state(), "text": client.get_goal_status_text(), "time_s": time_s}
        print(json.dumps(row), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
