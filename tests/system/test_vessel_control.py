# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A vessel under its controller's node goes as under the plugin; one without obeys VRX' topics."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import numpy.typing as npt
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, Twist
from harness import REPO, Launch, Ros, eventually, recorder
from nav_msgs.msg import Path as PathMessage
from std_msgs.msg import Float32, Header

import trident_sim

Start = Callable[..., Launch]
START_S = 0.5
END_S = 15.0
WAYPOINTS = ((20.0, 0.0, 0.0), (20.0, 30.0, 0.0))
LAUNCH = """<launch>
  <param name="/gazebo/wait_for" type="int" value="1"/>
  <include file="$(find trident_bringup)/launch/sim/world.launch">
    <arg name="world" value="ocean"/>
    <arg name="paused" value="true"/>
  </include>
  <include ns="usv1" file="$(find trident_bringup)/launch/robot/vessel.launch">
    <arg name="vessel" value="otter"/>
    <arg name="xacro_args" value="lidar:=false"/>
    <arg name="control" value="true"/>
  </include>
  <include ns="usv2" file="$(find trident_bringup)/launch/robot/vessel.launch">
    <arg name="vessel" value="wamv"/>
    <arg name="layout" value="X"/>
    <arg name="xacro_args" value="lidar:=false"/>
    <arg name="y" value="-20"/>
  </include>
</launch>
"""


def path_message() -> PathMessage:
    message = PathMessage(header=Header(stamp=rospy.Time.from_sec(START_S), frame_id="world"))
    for x, y, _ in WAYPOINTS:
        pose = PoseStamped()
        pose.pose.position.x, pose.pose.position.y = x, y
        pose.pose.orientation.w = 1.0
        message.poses.append(pose)
    return message


def position_by_the_plugin() -> npt.NDArray[np.float64]:
    """Where the same controller inside the simulator brings the Otter by END_S [m], shape (3,)."""
    world = trident_sim.World("package://trident_bringup/worlds/ocean.world", seed=0)
    urdf = REPO / "src" / "trident_description" / "urdf" / "otter.urdf.xacro"
    text = trident_sim.expand_xacro(urdf, lidar="false", control="plugin")
    boat = world.spawn("otter", urdf=text, namespace="usv1")
    world.ports["usv1/command/path"].write(trident_sim.PathCommand(WAYPOINTS, START_S))
    world.step(round(END_S / world.dt))
    assert not [message.text for message in world.messages]
    return np.array(boat.position)


def test_the_node_and_the_plugin_take_a_vessel_along_one_path(
    launch: Start, tmp_path: Path
) -> None:
    file = tmp_path / "vessels.launch"
    file.write_text(LAUNCH, encoding="utf-8")
    run = launch(file).spawned("otter", "wamv")
    path = rospy.Publisher("/usv1/command/path", PathMessage, queue_size=1, latch=True)
    thrusters = [
        rospy.Publisher(f"/usv2/thrusters/{name}_thrust_cmd", Float32, queue_size=1, latch=True)
        for name in ("left_rear", "right_rear", "left_front", "right_front")
    ]
    with recorder("/usv1/command/accepted_setpoint", Header) as accepted:
        path.publish(path_message())
        assert accepted.received()[0].stamp.to_sec() == START_S
    for publisher in thrusters:
        eventually(lambda: publisher.get_num_connections() > 0, "the thruster")  # noqa: B023
        publisher.publish(Float32(0.5))
    with recorder("/usv1/thrusters/left_thrust_cmd", Float32) as command:
        command.connected()
        run.step_to(END_S)
        # The single commands come in addition to those in lockstep; a slow listener misses some.
        assert len(command.received(10)) >= 10
    assert np.array_equal(run.position("otter"), position_by_the_plugin())
    assert run.position("otter")[0] > 10.0
    assert run.position("wamv")[0] > 5.0

    wrong = rospy.Publisher("/usv1/cmd_vel", Twist, queue_size=1)
    eventually(lambda: wrong.get_num_connections() > 0, "the controller")
    with recorder("/diagnostics", DiagnosticArray) as diagnostics:
        diagnostics.connected(2)
        twist = Twist()
        twist.linear.x = math.nan
        wrong.publish(twist)
        eventually(lambda: "surge speed = nan m/s, legal is a number up to" in run.log, "an error")
        run.step_to(END_S + 2.5)
        eventually(
            lambda: any(
                status.name.endswith("cmd_vel refused") and status.level == status.ERROR
                for array in diagnostics.messages
                for status in array.status
            ),
            "the diagnostics",
        )
    for publisher in (path, wrong, *thrusters):
        publisher.unregister()


def test_a_bad_file_is_one_error(ros: Ros, tmp_path: Path) -> None:
    file = tmp_path / "bad.yaml"
    file.write_text("speed: {cruise: 9.0}", encoding="utf-8")
    vessel = REPO / "config" / "vessels" / "otter.yaml"
    command = ["rosrun", "trident_control", "vessel_controller_node"]
    node = ros.launch([*command, f"_vessel:={vessel}", f"_controller:={file}"])
    assert node.wait() == 1
    assert node.log.count("[FATAL]") == 1
    assert f"{file}:1: speed: cruise = 9 m/s, legal is at most max, 2 m/s" in node.log
