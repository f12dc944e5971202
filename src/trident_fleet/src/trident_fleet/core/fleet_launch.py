# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Launch file of a fleet of any size: multi_uav_simulation.launch with another vehicles part.

Forty vehicles started like six would be forty xacro calls, forty spawners and forty rospy nodes. So
one node spawns all of them from one expanded description, and one feeds all of them; each vehicle
keeps its namespace with its controller.
"""

from __future__ import annotations

from dataclasses import dataclass
from xml.sax.saxutils import quoteattr

import numpy as np

from trident_fleet.core.assignment import assign
from trident_fleet.core.errors import FormationError
from trident_fleet.core.patterns import Pattern, places
from trident_fleet.core.quintic import Array

MAX_VEHICLES = 100
NAMESPACE_TOKEN = "VEHICLE_NAMESPACE"

_SPAWN_Z_M = 0.1
_FOLDER = "$(find trident_bringup)/launch/"
_BEGIN, _END = "  <!-- Vehicles:", "  <!-- End of the vehicles -->\n"
_FLEET_NODES = f"""\
  <!-- One process feeds all, one spawns all from a description that is expanded once. -->
  <node name="formation" pkg="trident_fleet" type="formation_all.py" output="screen"/>
  <node name="spawn_fleet" pkg="trident_fleet" type="spawn_fleet.py" output="screen">
    <param name="namespace_token" value="{NAMESPACE_TOKEN}"/>
    <param name="robot_description" command="$(find xacro)/xacro
      '$(find rotors_description)/urdf/mav_generic_odometry_sensor.gazebo'
      mav_name:=$(arg mav_name) namespace:={NAMESPACE_TOKEN} log_file:=$(arg mav_name)
      enable_ground_truth:=$(arg enable_ground_truth) enable_logging:=false
      wait_to_record_bag:=false enable_mavlink_interface:=false"/>
"""
_VEHICLE = """\
  <include file="{folder}robot/uav.launch"{condition}>
    <arg name="namespace" value="UAV{number}"/>
    <arg name="spawn" value="false"/>
    <arg name="formation" value="false"/>
    <arg name="mav_name" value="$(arg mav_name)"/>
  </include>
"""


@dataclass(frozen=True)
class Fleet:
    """What a launch file is made for.

    Attributes:
        spawn: where each vehicle stands at first [m, world], shape (N, 3).
        formation_file: default of that argument.
        vehicles_in_file: default of that argument; 0: the file's shape or continuity says.
        layout: default of that argument.
        mav_name: default of that argument.
        command: the command line that makes the file, for its reader.
    """

    spawn: Array
    formation_file: str
    vehicles_in_file: int
    layout: str
    mav_name: str
    command: str


def spawn_grid(first_row: Array, spacing_m: float) -> Array:
    """Places on the ground below a first row, assigned so that nobody's take-off crosses another's.

    Args:
        first_row: p_world of each vehicle [m], shape (N, 3).
        spacing_m: of the grid [m].

    Returns:
        p_world of each vehicle [m], shape (N, 3).

    Raises:
        FormationError: an illegal spacing.
    """
    grid = places(Pattern("grid", spacing_m), len(first_row))
    center = first_row.mean(axis=0)
    grid += [center[0], center[1], _SPAWN_Z_M]
    return np.round(grid[assign(first_row, grid)], 3) + 0.0


def _around_vehicles(template: str) -> tuple[str, str]:
    """What stands before and behind the part with the vehicles."""
    head, begin, rest = template.partition(_BEGIN)
    _, end, tail = rest.partition(_END)
    if not begin or not end:
        raise FormationError(f"launch template: no '{(begin and _END.strip()) or _BEGIN.strip()}'")
    return head, tail


def fleet_launch(template: str, fleet: Fleet) -> str:
    """Write the launch file.

    Args:
        template: content of multi_uav_simulation.launch.
        fleet: of how many, where, with which file.

    Raises:
        FormationError: too many vehicles, or a template without the parts that are replaced.
    """
    count = len(fleet.spawn)
    if not 1 <= count <= MAX_VEHICLES:
        raise FormationError(f"uavs: {count}; legal: 1 to {MAX_VEHICLES}")
    head, tail = _around_vehicles(template)
    head = _with_title(head, count)
    for name, value in (
        ("formation_file", fleet.formation_file),
        ("vehicles_in_file", str(fleet.vehicles_in_file)),
        ("uavs", str(count)),
        ("layout", fleet.layout),
        ("mav_name", fleet.mav_name),
    ):
        head = _with_default(head, name, value)
    doc = quoteattr(f"how many fly, 1 to {count}; the file was made by {fleet.command}")
    head = _replaced(head, 'doc="how many fly, 1 to 6"', f"doc={doc}")
    sources = '<param name="/gazebo/wait_for_sources" type="int" value='
    head = _replaced(head, sources + '"$(arg uavs)"', sources + '"1"')
    return (head + _vehicles(fleet) + tail).replace("$(dirname)/robot/", _FOLDER + "robot/")


def _vehicles(fleet: Fleet) -> str:
    lines = [_FLEET_NODES, "    <rosparam>\n      positions:\n"]
    for number, (x, y, z) in enumerate(fleet.spawn.tolist(), start=1):
        lines.append(f"        UAV{number}: [{x:g}, {y:g}, {z:g}]\n")
    lines.append("    </rosparam>\n  </node>\n")
    for number in range(1, len(fleet.spawn) + 1):
        condition = f' if="$(eval int(uavs) &gt;= {number})"' if number > 1 else ""
        lines.append(_VEHICLE.format(folder=_FOLDER, condition=condition, number=number))
    return "".join(lines)


def _with_title(head: str, count: int) -> str:
    begin = head.rindex("<!--", 0, head.index("<launch>"))
    end = head.index("-->", begin)
    title = (
        f"<!-- {count} vehicles fly a formation from a position file. How it was made: see uavs. "
    )
    return head[:begin] + title + head[end:]


def _with_default(head: str, name: str, value: str) -> str:
    start = head.find(f'<arg name="{name}" default=')
    if start < 0:
        raise FormationError(f"launch template: no argument {name} with a default")
    begin = head.index("default=", start) + len("default=")
    end = head.index('"', begin + 1) + 1
    return head[:begin] + quoteattr(value) + head[end:]


def _replaced(text: str, old: str, new: str) -> str:
    if text.count(old) != 1:
        raise FormationError(f"launch template: {text.count(old)} times '{old}'; legal: once")
    return text.replace(old, new)
