# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Sea and wind are changed over topics; what is not legal is reported once, and what was stays."""

from __future__ import annotations

from collections.abc import Callable

import rospy
import yaml
from harness import REPO, Gazebo, eventually, logged_problems, pose, recorder
from rotors_comm.msg import WindSpeed
from std_msgs.msg import Float64, String

from trident_msgs.msg import EnvironmentState

OTTER = """<robot name="otter">
  <link name="base_link">
    <inertial>
      <origin xyz="0.153125 0 0.246875"/>
      <mass value="80"/>
      <inertia ixx="16.678920" iyy="21.516699" izz="15.102100" ixy="0" ixz="-2.516650" iyz="0"/>
    </inertial>
  </link>
  <gazebo>
    <plugin name="vessel" filename="libtrident_vessel.so">
      <vessel>package://trident_bringup/config/vessels/otter.yaml</vessel>
      <bodyName>base_link</bodyName>
    </plugin>
  </gazebo>
</robot>
"""


class Say:
    """Messages that have reached the server when it is stepped next."""

    def __init__(self, topic: str, kind: type[String] | type[Float64]) -> None:
        self._publisher = rospy.Publisher(topic, kind, queue_size=10)
        eventually(lambda: self._publisher.get_num_connections() == 1, f"a reader of {topic}")

    def __call__(self, data: str | float) -> None:
        self._publisher.publish(data=data)


def test_the_environment_changes_live(start_gazebo: Callable[..., Gazebo]) -> None:
    gazebo = start_gazebo(REPO / "worlds" / "coast.world").ready()
    with (
        recorder("/environment/state", EnvironmentState) as state,
        recorder("/environment/wind_speed", WindSpeed) as wind,
    ):

        def now() -> dict[str, dict[str, object]]:
            return dict(yaml.safe_load(state.messages[-1].yaml))

        def step_until(is_so: Callable[[], bool], what: str) -> None:
            eventually(lambda: gazebo.step(1) > 0.0 and is_so(), what)

        # Latched: it reaches subscribers that come late, before the first step.
        eventually(lambda: bool(state.messages), "the state of a paused world")
        assert now()["waves"]["significant_height"] == 0.2
        assert now()["bathymetry"]["kind"] == "terrain"
        waves, air = Say("/environment/waves", String), Say("/environment/wind", String)
        waves("significant_height: -1")
        step_until(lambda: "significant_height: -1" in gazebo.log, "the refusal")
        waves("{significant_height: 0.5}")
        air("{speed: 7, direction: 0}")
        Say("/environment/water_level", Float64)(0.5)
        step_until(lambda: now()["water_level"] == 0.5, "the new level")
        step_until(lambda: now()["wind"]["speed"] == 7, "the new wind")
        step_until(lambda: now()["waves"]["significant_height"] == 0.5, "the new waves")
        step_until(lambda: wind.messages[-1].velocity.x == 7.0, "the wind")
        gazebo.call("reset_world")
        step_until(lambda: now()["waves"]["significant_height"] == 0.2, "the file's waves")
    reported = [line for line in logged_problems(gazebo.log) if "environment/waves" in line]
    assert len(reported) == 1
    assert "must be a number in [0, 30] m" in reported[0]


def test_a_vessel_on_land_is_refused(start_gazebo: Callable[..., Gazebo]) -> None:
    gazebo = start_gazebo(REPO / "worlds" / "coast.world").ready()
    status = gazebo.refusal(
        "spawn_urdf_model", model_name="usv", model_xml=OTTER, initial_pose=pose(y=120.0)
    )
    for part in ("model 'usv'", "vessel 'otter'", "x = ", "y = ", "m deep there", "0.19512 m"):
        assert part in status
    gazebo.spawn("usv", OTTER, pose(y=-100.0))
