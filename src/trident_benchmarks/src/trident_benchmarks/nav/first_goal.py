# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Starts a world that stands with one goal: python3 -m ...first_goal SCAN_TOPIC FRAME X Y YAW.

Sends the goal to move_base once that hears the world's scans, lets the world run, and ends with the
goal; prints one line of JSON: state and text.
"""

from __future__ import annotations

import json
import math
import sys
import threading
import time

import rosgraph
import rospy
from move_base_msgs.msg import MoveBaseActionGoal, MoveBaseActionResult
from std_srvs.srv import Empty

from trident_benchmarks.nav.drive_node import readers_of_simulator
from trident_ros import init_node

_POLL_S = 0.02  # wall time


def message(frame: str, x: float, y: float, yaw: float) -> MoveBaseActionGoal:
    """A goal as an action's client sends it."""
    goal = MoveBaseActionGoal()
    goal.goal_id.id = "first"
    target = goal.goal.target_pose
    target.header.frame_id = frame
    target.pose.position.x, target.pose.position.y = x, y
    target.pose.orientation.z, target.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return goal


def _hears(topic: str) -> bool:
    try:
        return (topic, "/move_base") in readers_of_simulator()
    except (OSError, rosgraph.MasterException):
        return False


def _wait_for_readers(goals: rospy.Publisher, topic: str) -> None:
    """Return when move_base hears goals and the world's scans."""
    while not rospy.is_shutdown() and not (goals.get_num_connections() and _hears(topic)):
        time.sleep(_POLL_S)  # of wall time: the world stands


def main() -> int:
    """Send the goal.

    Returns:
        Exit code 0.
    """
    topic, frame, *numbers = rospy.myargv(sys.argv)[1:]
    x, y, yaw = (float(number) for number in numbers)
    init_node("first_goal")
    has_ended = threading.Event()
    results: list[MoveBaseActionResult] = []

    def receive(result: MoveBaseActionResult) -> None:
        results.append(result)
        has_ended.set()

    rospy.Subscriber("move_base/result", MoveBaseActionResult, receive)
    goals = rospy.Publisher("move_base/goal", MoveBaseActionGoal, queue_size=1, latch=True)
    _wait_for_readers(goals, topic)
    goals.publish(message(frame, x, y, yaw))
    rospy.ServiceProxy("/gazebo/unpause_physics", Empty)()
    while not rospy.is_shutdown() and not has_ended.wait(_POLL_S):
        pass
    if results:
        status = results[0].status
        print(json.dumps({"state": status.status, "text": status.text}), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
