# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Descriptions of what tests put into a world."""

from __future__ import annotations

import math
import subprocess
from functools import cache

from geometry_msgs.msg import Point, Pose, Quaternion

from trident.testing.programs import package

_NAMESPACE = "NAMESPACE_TO_REPLACE"


@cache
def _vehicle_template(mav_name: str) -> str:
    model = package("rotors_description") / "urdf" / "mav_generic_odometry_sensor.gazebo"
    arguments = {
        "mav_name": mav_name,
        "namespace": _NAMESPACE,
        "enable_ground_truth": "true",
        "enable_logging": "false",
        "log_file": mav_name,
        "wait_to_record_bag": "false",
        "enable_mavlink_interface": "false",
    }
    command = [str(package("xacro") / "xacro"), str(model)]
    command += [f"{name}:={value}" for name, value in arguments.items()]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def vehicle_urdf(namespace: str, mav_name: str = "firefly") -> str:
    """URDF of a multirotor with odometry, as spawn_mav.launch makes it."""
    return _vehicle_template(mav_name).replace(_NAMESPACE, namespace)


def box_sdf(name: str, size_m: float = 0.2, mass_kg: float = 2.0, extra: str = "") -> str:
    """SDF of a free box; `extra` goes into the model element."""
    inertia = mass_kg * size_m**2 / 6.0
    box = f"<geometry><box><size>{size_m} {size_m} {size_m}</size></box></geometry>"
    return f"""<?xml version="1.0"?>
<sdf version="1.6"><model name="{name}"><link name="link">
  <inertial><mass>{mass_kg}</mass><inertia><ixx>{inertia}</ixx><iyy>{inertia}</iyy>
    <izz>{inertia}</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>
  <collision name="collision">{box}</collision><visual name="visual">{box}</visual>
</link>{extra}</model></sdf>"""


def pose(x: float = 0.0, y: float = 0.0, z: float = 0.0, yaw_rad: float = 0.0) -> Pose:
    """A pose from its position [m] and heading, in the frame that it is used in."""
    turn = Quaternion(0.0, 0.0, math.sin(yaw_rad / 2.0), math.cos(yaw_rad / 2.0))
    return Pose(Point(x, y, z), turn)
