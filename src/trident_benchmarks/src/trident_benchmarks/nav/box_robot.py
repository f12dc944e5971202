# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A rectangular robot for tight places: a box on two wheels within its outline, lidar, gyro."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path

from trident_eval.ros_paths import package_folder

from trident_benchmarks.nav.trials import Robot

LENGTH_M, WIDTH_M = 0.42, 0.31

_XACRO = """<?xml version="1.0"?>
<robot name="box" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include filename="{urdf}/parts.xacro"/>
  <xacro:include filename="{urdf}/sensors.xacro"/>
  <xacro:footprint height="0.06"/>
  <link name="base_link">
    <xacro:box_inertial mass="8.0" x="0.4" y="0.3" z="0.1">
      <origin xyz="-0.04 0 0"/>
    </xacro:box_inertial>
    <collision>
      <origin xyz="0 0 0.02"/>
      <geometry><box size="{length} {width} 0.1"/></geometry>
    </collision>
  </link>
  <xacro:wheel name="wheel_left" x="0" y="0.13" z="0" radius="0.06" width="0.03" mass="0.3"
               mu="1.0" rate_limit="30" torque_limit="5"/>
  <xacro:wheel name="wheel_right" x="0" y="-0.13" z="0" radius="0.06" width="0.03" mass="0.3"
               mu="1.0" rate_limit="30" torque_limit="5"/>
  <xacro:caster name="caster" x="-0.16" z="-0.04" radius="0.02" mass="0.05"/>
  <xacro:lidar_2d link="laser_link" parent="base_link" x="0" y="0" z="0.1" samples="720"
                  min_range="0.05" max_range="30" sigma="0.001" resolution="0.001" rate="20"/>
  <xacro:diff_drive separation="0.26" diameter="0.12" torque="5" acceleration="2" rate="50"
                    source="encoder"/>
  <gazebo>
    <plugin name="imu" filename="libhector_gazebo_ros_imu.so">
      <bodyName>base_link</bodyName>
      <topicName>imu/data</topicName>
      <frameId>base_link</frameId>
      <updateRate>50</updateRate>
      <rateGaussianNoise>0.005 0.005 0.005</rateGaussianNoise>
    </plugin>
  </gazebo>
</robot>
"""
_LIMITS = """global_costmap: {{footprint: &footprint {corners}}}
local_costmap: {{footprint: *footprint}}
MPPIController:
  max_vel_x: 0.5
  min_vel_x: -0.25
  max_vel_y: 0.0
  max_vel_theta: 1.5
  acc_lim_x: 1.0
  acc_lim_theta: 3.0
  xy_goal_tolerance: 0.1
  yaw_goal_tolerance: 0.1
"""


@dataclass(frozen=True)
class BoxRobot(Robot):
    """The box."""

    def urdf(self) -> str:
        """Its description.

        Raises:
            trident_sim.Error: it cannot be expanded.
        """
        from trident_sim import expand_xacro

        urdf = package_folder("trident_description") / "urdf"
        text = _XACRO.format(urdf=urdf, length=LENGTH_M, width=WIDTH_M)
        with tempfile.TemporaryDirectory(prefix="trident_bench_box_") as name:
            file = Path(name) / "box.urdf.xacro"
            file.write_text(text, encoding="utf-8")
            return expand_xacro(file)


BOX = BoxRobot("box", "laser_link", "scan", 0.06, ("wheel_left_joint",), ("wheel_right_joint",))


def limits_file(folder: Path) -> Path:
    """Write its footprint and limits as a file of config/nav/robots has them."""
    x, y = LENGTH_M / 2, WIDTH_M / 2
    file = folder / "box.yaml"
    corners = [[-x, -y], [x, -y], [x, y], [-x, y]]
    file.write_text(_LIMITS.format(corners=corners), encoding="utf-8")
    return file
