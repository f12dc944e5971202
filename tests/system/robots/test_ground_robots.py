# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Ground robots as their users start them, driven over /cmd_vel."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import pytest
import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import Twist
from harness import Launch, Recorder, box_sdf, eventually, pose, recorder
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
    rates = dict(zip(state.name, state.velocity, strict=True))
    rear = "rear_" if "wheel_rear_left_joint" in rates else ""
    left, right = (rates[f"wheel_{rear}{side}_joint"] for side in ("left", "right"))
    return (left + right > 0.2) == (v > 0) and (right - left > 0.2) == (w > 0)


def status_of(heard: Recorder, name: str) -> DiagnosticStatus | None:
    """The newest status of that name."""
    newest = heard.messages[-1].status if heard.messages else []
    return next((status for status in newest if status.name == f"gazebo: {name}"), None)


def command(run: Launch, v: float, w: float, seconds: float) -> None:
    """Commands a velocity and lets it act, the world being paused."""
    publisher = rospy.Publisher("/cmd_vel", Twist, queue_size=1, latch=True)
    eventually(lambda: publisher.get_num_connections() > 0, "a reader of /cmd_vel")
    publisher.publish(twist(v, w))
    with recorder("/joint_states", JointState) as states:
        # Delivered on a socket of its own: the wheels show when it has arrived.
        run.step_until(
            lambda: bool(states.messages) and acts(states.messages[-1], v, w), "an answer"
        )
    run.step(round(seconds / run.dt()))
    publisher.unregister()


#: Fraction of its path that a robot may slip; the burger's wheels have a friction of 0.1 only.
SLIP = {
    "ackermann_car": 0.03,
    "my_nav_robot": 0.03,
    "tutorial_ugv": 0.03,
    "turtlebot3_burger": 0.15,
}


@pytest.mark.parametrize("robot", SLIP)
def test_a_robot_in_a_room_goes_where_it_is_commanded(launch: Start, robot: str) -> None:
    run = launch(
        "trident_bringup", "robot_in_room.launch", robot=robot, paused=True, x=-2, y=-1, yaw=0.5
    ).spawned(robot)
    with (
        recorder("/odom", Odometry) as odometry,
        recorder("/ground_truth/odom", Odometry) as truth,
        recorder("/tf", TFMessage) as tf,
    ):
        wheel = "wheel_rear_left_link" if robot == "ackermann_car" else "wheel_left_link"
        # The publisher of the wheels may start after everybody else, and a paused world waits for
        # none.
        eventually(lambda: run.step(20) > 0.0 and wheel in transforms(tf.messages), "wheels in /tf")
        run.step(200)
        command(run, 0.2, 0.0, 3.0)
        command(run, 0.2, 0.3, 3.0)
        # Standing, so that messages of two topics need not be of one moment.
        command(run, 0.0, 0.0, 1.0)
        late = run.time() - 0.5
        for heard in (odometry, truth):
            eventually(partial(is_after, heard, late), "the last odometry")
    odom, actual = odometry.messages[-1], truth.messages[-1]
    assert (odom.header.frame_id, odom.child_frame_id) == ("odom", "base_footprint")
    distance = math.hypot(actual.pose.pose.position.x + 2, actual.pose.pose.position.y + 1)
    assert distance > 0.8
    tree = transforms(tf.messages)
    assert tree["base_footprint"] == "odom"
    assert tree[wheel] == "base_link"
    # The encoders count from where it started, in its heading then.
    x, y = odom.pose.pose.position.x, odom.pose.pose.position.y
    seen = (-2 + x * math.cos(0.5) - y * math.sin(0.5), -1 + x * math.sin(0.5) + y * math.cos(0.5))
    error = math.dist(seen, (actual.pose.pose.position.x, actual.pose.pose.position.y))
    assert error < SLIP[robot] * distance + 0.01
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
    with recorder("/odom", Odometry) as odometry:
        run.step(500)
        command(run, 0.15, 0.0, 2.0)
        eventually(partial(is_after, odometry, run.time() - 0.1), "the last odometry")
    pose = odometry.messages[-1].pose.pose
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
    in_the_inner_wall = pose(-1.0, 2.0, 0.5)
    run.ask(
        "spawn_sdf_model",
        model_name="crate",
        model_xml=box_sdf("crate"),
        initial_pose=in_the_inner_wall,
    )
    with recorder("/diagnostics", DiagnosticArray) as heard:
        found = partial(status_of, heard)
        refused = "model 'my_nav_robot' plugin 'diff_drive': velocity command refused"
        eventually(lambda: found(refused) is not None, "the refusal in /diagnostics")
        eventually(lambda: found("model 'crate': spawned inside") is not None, "the crate")
    status = found(refused)
    assert status is not None
    assert status.level == DiagnosticStatus.ERROR
    values = {pair.key: pair.value for pair in status.values}
    assert values["value"].startswith("(nan, 0.0")
    assert values["legal"] == "finite, up to 1e5 m/s and 1e4 rad/s"
    assert int(values["count"]) == 1
    status = found("model 'crate': spawned inside")
    assert status is not None
    assert status.level == DiagnosticStatus.WARN
    assert {pair.key for pair in status.values} >= {"obstacle", "depth_m", "count"}
    before = run.position("my_nav_robot")
    run.step(1000)
    assert math.dist(before, run.position("my_nav_robot")) == pytest.approx(0.2, abs=0.02)
