# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Ground robots as their users start them, driven over /cmd_vel."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import pytest
import rospy
from geometry_msgs.msg import Twist
from harness import Launch, Recorder, eventually, recorder
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

Start = Callable[..., Launch]


def twist(v: float, w: float) -> Twist:
    message = Twist()
    message.linear.x = v
    message.angular.z = w
    return message


def yaw_of(message: Odometry) -> float:
    q = message.pose.pose.orientation
    return 2.0 * math.atan2(q.z, q.w)


def transforms(messages: list[TFMessage]) -> dict[str, str]:
    return {t.child_frame_id: t.header.frame_id for m in messages for t in m.transforms}


def is_after(heard: Recorder, seconds: float) -> bool:
    return bool(heard.messages) and heard.messages[-1].header.stamp.to_sec() > seconds


def acts(state: JointState, v: float, w: float) -> bool:
    """Whether the wheels turn as a velocity wants them to."""
    left, right = state.velocity
    return (left + right > 0.2) == (v > 0) and (right - left > 0.2) == (w > 0)


def command(run: Launch, v: float, w: float, seconds: float) -> None:
    """Commands a velocity and lets it act, the world being paused."""
    publisher = rospy.Publisher("/cmd_vel", Twist, queue_size=1, latch=True)
    eventually(lambda: publisher.get_num_connections() > 0, "a reader of /cmd_vel")
    publisher.publish(twist(v, w))
    with recorder("/joint_states", JointState) as states:
        # Delivered on a socket of its own: the wheels tell when it has arrived.
        run.step_until(
            lambda: bool(states.messages) and acts(states.messages[-1], v, w), "an answer"
        )
    run.step(round(seconds / run.dt()))
    publisher.unregister()


#: How much of its way a robot may slip; the burger's wheels have a friction of 0.1 only.
SLIP = {"my_nav_robot": 0.03, "tutorial_ugv": 0.03, "turtlebot3_burger": 0.15}


@pytest.mark.parametrize("robot", SLIP)
def test_a_robot_in_a_room_goes_where_it_is_told(launch: Start, robot: str) -> None:
    run = launch(
        "trident_bringup", "robot_in_room.launch", robot=robot, paused=True, x=-2, y=-1, yaw=0.5
    ).spawned(robot)
    with (
        recorder("/odom", Odometry) as told,
        recorder("/ground_truth/odom", Odometry) as truth,
        recorder("/tf", TFMessage) as tf,
    ):
        run.step(200)
        command(run, 0.2, 0.0, 3.0)
        command(run, 0.2, 0.3, 3.0)
        # Standing, so that messages of two topics need not be of one moment.
        command(run, 0.0, 0.0, 1.0)
        late = run.time() - 0.5
        for heard in (told, truth):
            eventually(partial(is_after, heard, late), "the last odometry")
        eventually(lambda: "wheel_left_link" in transforms(tf.messages), "wheels in /tf")
    odom, actual = told.messages[-1], truth.messages[-1]
    assert (odom.header.frame_id, odom.child_frame_id) == ("odom", "base_footprint")
    way = math.hypot(actual.pose.pose.position.x + 2, actual.pose.pose.position.y + 1)
    assert way > 0.8
    tree = transforms(tf.messages)
    assert tree["base_footprint"] == "odom"
    assert tree["wheel_left_link"] == "base_link"
    # The encoders count from where it started, in its heading then.
    x, y = odom.pose.pose.position.x, odom.pose.pose.position.y
    seen = (-2 + x * math.cos(0.5) - y * math.sin(0.5), -1 + x * math.sin(0.5) + y * math.cos(0.5))
    error = math.dist(seen, (actual.pose.pose.position.x, actual.pose.pose.position.y))
    assert error < SLIP[robot] * way + 0.01
    turned = math.remainder(yaw_of(odom) + 0.5 - yaw_of(actual), 2 * math.pi)
    assert abs(turned) < 2 * SLIP[robot]


def test_turtlebot3_world_starts_with_a_burger(launch: Start) -> None:
    run = launch(
        "turtlebot3_gazebo",
        "turtlebot3_world.launch",
        gui=False,
        paused=True,
        env={"TURTLEBOT3_MODEL": "burger"},
    ).spawned("turtlebot3_burger", "hexagon_arena")
    with recorder("/odom", Odometry) as told:
        run.step(500)
        command(run, 0.15, 0.0, 2.0)
        eventually(partial(is_after, told, run.time() - 0.1), "the last odometry")
    pose = told.messages[-1].pose.pose
    # World odometry: it begins where the robot was spawned.
    assert pose.position.x > -2.0 + 0.2
    assert pose.position.y == pytest.approx(-0.5, abs=0.05)
    assert pose.position.z == pytest.approx(0.0, abs=0.005)


def test_a_command_that_is_not_a_number_is_named(launch: Start) -> None:
    run = launch("trident_bringup", "robot_in_room.launch", paused=True).spawned("my_nav_robot")
    command(run, 0.2, 0.0, 0.5)
    publisher = rospy.Publisher("/cmd_vel", Twist, queue_size=1, latch=True)
    eventually(lambda: publisher.get_num_connections() > 0, "a reader of /cmd_vel")
    publisher.publish(twist(math.nan, 0.0))
    run.step_until(lambda: "must be finite; such commands are refused" in run.log, "a refusal")
    before = run.position("my_nav_robot")
    run.step(1000)
    assert math.dist(before, run.position("my_nav_robot")) == pytest.approx(0.2, abs=0.02)
