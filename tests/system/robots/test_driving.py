# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that drive a robot: by its lidar, along waypoints, from a joystick."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path as FilePath

import numpy as np
import rospy
from geometry_msgs.msg import Twist
from harness import Launch, Ros, eventually, recorder
from nav_msgs.msg import Path
from PIL import Image
from sensor_msgs.msg import Joy
from std_msgs.msg import Bool

Start = Callable[..., Launch]
ROBOT = "my_nav_robot"


def has_gone(run: Launch, meters: float) -> bool:
    return math.dist(run.position(ROBOT)[:2], (0.0, 0.0)) > meters


def test_a_robot_wanders(launch: Start) -> None:
    run = launch(
        "trident_bringup", "robot_in_room.launch", drive="wander", real_time_factor=4
    ).spawned(ROBOT)
    eventually(lambda: has_gone(run, 1.0), "a metre of path")
    assert abs(run.position(ROBOT)[2]) < 0.05


def test_a_robot_follows_waypoints_to_the_last_one(launch: Start) -> None:
    run = launch(
        "trident_bringup",
        "robot_in_room.launch",
        drive="waypoints",
        waypoints="[[1.0, 0.0], [1.0, 1.0]]",
        loop=False,
        speed=0.5,
        real_time_factor=4,
    ).spawned(ROBOT)
    with recorder("/path", Path) as path, recorder("/waypoint_follower/done", Bool) as done:
        eventually(lambda: bool(done.messages) and done.messages[-1].data, "the last waypoint")
        eventually(lambda: bool(path.messages), "the path")
    message = path.messages[-1]
    assert message.header.frame_id == "odom"
    assert [(p.pose.position.x, p.pose.position.y) for p in message.poses] == [(1, 0), (1, 1)]
    assert math.dist(run.position(ROBOT)[:2], (1.0, 1.0)) < 0.15


def test_a_joystick_commands_while_its_button_is_held(ros: Ros) -> None:
    node = ros.launch(
        ["rosrun", "teleop_twist_joy", "teleop_node", "_axis_linear:={x: 1}", "_enable_button:=4"]
    )
    sender = rospy.Publisher("/joy", Joy, queue_size=5)
    with recorder("/cmd_vel", Twist) as heard:
        eventually(lambda: sender.get_num_connections() > 0, "the node")
        heard.connected()
        sender.publish(Joy(axes=[0.0, 1.0], buttons=[0, 0, 0, 0, 1]))
        eventually(lambda: len(heard.messages) == 1, "a command")
        sender.publish(Joy(axes=[0.0, 1.0], buttons=[0, 0, 0, 0, 0]))
        eventually(lambda: len(heard.messages) == 2, "a stop")
    assert [message.linear.x for message in heard.messages] == [0.5, 0.0]
    sender.unregister()
    assert node.running, node.log


def test_a_follower_without_waypoints_says_so(ros: Ros) -> None:
    node = ros.launch(["rosrun", "trident_nav", "waypoint_follower.py"])
    assert node.wait() == 1
    assert "neither given, legal: one of them" in node.log
    assert "Traceback" not in node.log


def test_an_observer_draws_what_happens(launch: Start, tmp_path: FilePath) -> None:
    run = launch("trident_bringup", "robot_in_room.launch", real_time_factor=1).spawned(ROBOT)
    before = run.models()
    words = ["--model", ROBOT, "--from", "2", "-2", "1.5", "--at", "0", "0", "0"]
    words += ["--size", "160x100"]
    out = tmp_path / "seen.png"
    run.ros.call(
        *("rosrun", "trident_viewer", "observer.py", *words),
        *("--count", "2", "--every", "0.2", "--out", out),
    )
    first, second = (Image.open(tmp_path / f"seen_000{n}.png") for n in (0, 1))
    assert first.size == second.size == (160, 100)
    # The robot is dark before a bright floor.
    middle = np.asarray(first.convert("L"), dtype=float)[40:60, 70:90]
    assert np.ptp(middle) > 30.0
    eventually(lambda: run.models() == before, "the end of the camera")
