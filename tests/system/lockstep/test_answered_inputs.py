# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""/gazebo/answers: the world waits for nodes whose commands carry no stamp."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from harness import Gazebo, Ros, eventually, logged_problems, pose, recorder
from nav_msgs.msg import Odometry

CART = """<?xml version="1.0"?>
<sdf version="1.6"><model name="cart">
  <link name="base">
    <inertial><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
  </link>
  <plugin name="move" filename="libgazebo_ros_planar_move.so">
    <robotNamespace>cart</robotNamespace><commandTopic>cmd_vel</commandTopic>
    <odometryTopic>odom</odometryTopic><odometryFrame>odom</odometryFrame>
    <odometryRate>10</odometryRate><robotBaseFrame>base</robotBaseFrame>
  </plugin>
</model></sdf>
"""
ANSWERS = {"state": "/cart/odom", "commands": ["/cart/cmd_vel"], "delay": 0.02}


@pytest.mark.parametrize(
    ("wrong", "named"),
    [
        ({"delay": math.nan}, "/delay: nan is out of range; must be a number in [0, 10] s"),
        ({"commands": [3]}, ": topic '3': "),
        ({"stat": "/odom", "state": None}, "state"),
    ],
    ids=["delay nan", "no topic", "no state"],
)
def test_a_parameter_that_cannot_be_is_one_error(
    ros: Ros, wrong: dict[str, Any], named: str
) -> None:
    answers = {key: value for key, value in {**ANSWERS, **wrong}.items() if value is not None}
    gazebo = Gazebo(ros, answers={"cart": answers})
    assert gazebo.process.wait() == 1, gazebo.log
    (error,) = [line for line in logged_problems(gazebo.log) if "FATAL" in line or "ERROR" in line]
    assert "parameter /gazebo/answers/cart" in error
    assert named in error


@contextmanager
def driver(speeds: list[float]) -> Iterator[list[float]]:
    """Answers each odometry by the next speed, later by the last; the stamps it saw [s]."""
    stamps: list[float] = []
    publisher = rospy.Publisher("/cart/cmd_vel", Twist, queue_size=10)

    def answer(odometry: Odometry) -> None:
        twist = Twist()
        twist.linear.x = speeds[min(len(stamps), len(speeds) - 1)]
        stamps.append(odometry.header.stamp.to_sec())
        publisher.publish(twist)

    subscriber = rospy.Subscriber("/cart/odom", Odometry, answer, queue_size=10)
    try:
        # Of the same topic in the same node: it has the subscriber's connection.
        with recorder("/cart/odom", Odometry):
            eventually(lambda: publisher.get_num_connections() > 0, "the world as a listener")
        yield stamps
    finally:
        subscriber.unregister()
        publisher.unregister()


def is_reported(messages: list[DiagnosticArray], words: str) -> bool:
    return any(words in status.message for array in messages for status in array.status)


def test_bad_answers_and_a_reset_do_not_stop_the_world(ros: Ros) -> None:
    gazebo = Gazebo(ros, answers={"cart": ANSWERS}, lockstep_timeout=60.0).ready()
    with recorder("/diagnostics", DiagnosticArray) as reported:
        eventually(
            lambda: is_reported(reported.messages, "a model that publishes /cart/odom for cart"),
            "what is missing, by name",
        )
    gazebo.spawn("cart", CART, pose(z=0.5))
    with driver([1.0, math.nan, math.inf, 1.0]) as stamps:
        gazebo.step_to(1.0)
        distance = gazebo.position("cart")[0]
        # 1 m/s from the first answer on, 20 ms after the first sample: what is not finite is an
        # answer that changes nothing.
        assert distance == pytest.approx(1.0 - stamps[0] - ANSWERS["delay"], abs=0.011)
        refused = [line for line in logged_problems(gazebo.log) if "nan" in line]
        assert len(refused) == 1, gazebo.log
        # The world does not wait for the answer to the step that it ends with.
        eventually(lambda: stamps[-1] == pytest.approx(1.0), "the last sample of the second")
        answered = len(stamps)
        gazebo.ask("reset_simulation")
        gazebo.step_to(0.5)
        assert stamps[answered] == stamps[0], "time began again, and the world waited again"
        eventually(lambda: len(stamps) == answered + 5, "five samples of the half second")
        # One whose model has gone is waited for no longer.
        gazebo.ask("delete_model", model_name="cart")
        assert gazebo.step_to(1.0) == pytest.approx(1.0)


def test_who_commands_in_addition_to_the_awaited_node_is_named(ros: Ros) -> None:
    gazebo = Gazebo(ros, answers={"cart": ANSWERS}, lockstep_timeout=60.0).ready()
    gazebo.spawn("cart", CART, pose(z=0.5))
    words = "more than one message on /cart/cmd_vel a sample"
    second = rospy.Publisher("/cart/cmd_vel", Twist, queue_size=10)
    with recorder("/diagnostics", DiagnosticArray) as reported, driver([1.0]):
        eventually(lambda: second.get_num_connections() > 0, "the world as a listener")
        gazebo.step_to(0.55)
        assert words not in gazebo.log
        assert not is_reported(reported.messages, words)
        second.publish(Twist())
        later = itertools.count(6)

        def is_named() -> bool:
            gazebo.step_to(0.1 * next(later))
            return is_reported(reported.messages, words)

        eventually(is_named, "what is not repeatable, by name")
    second.unregister()
