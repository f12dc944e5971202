# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters of a formation node: its own ones, else those common to the fleet."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import rospkg
import rospy

from trident_ros import warn_of_unknown_parameters

COMMON_NAMESPACE = "/formation"
#: What the nodes of a fleet read in addition to the settings of a flight.
NODE_PARAMETERS = frozenset({"UAV", "seq", "vehicles", "vehicle", "waypoints", "out_dir"})
DEFAULT_FORMATION = "config/formations/hexagon_translate_rotate.txt"


def get_param(name: str) -> Any:
    """`~name`, else `/formation/name`, else None."""
    value = rospy.get_param("~" + name, None)
    return rospy.get_param(f"{COMMON_NAMESPACE}/{name}", None) if value is None else value


def get_fleet_param(name: str) -> Any:
    """The same, with the formation file's path made absolute."""
    value = get_param(name)
    is_path = name == "formation_file" and isinstance(value, str) and value
    return where_the_user_is(value) if is_path else value


def warn_of_unknown(known: Iterable[str], with_common: bool = False) -> None:
    """One warning about private parameters that are not known, and one about the fleet's.

    Args:
        known: names that the node reads.
        with_common: whether this node reports the common ones, which all nodes of a fleet see.
    """
    names = {*known, *NODE_PARAMETERS}
    if rospy.get_name() != COMMON_NAMESPACE:
        warn_of_unknown_parameters(names)
    if with_common:
        warn_of_unknown_parameters(names, COMMON_NAMESPACE)


def where_the_user_is(file: str) -> str:
    """Roslaunch starts nodes in ROS_HOME, but leaves PWD as it was where it was called."""
    path = Path(file).expanduser()
    return str(path if path.is_absolute() else Path(os.environ.get("PWD", ".")) / path)


def default_formation_file() -> str:
    """Path of the formation that is flown when none is given; "" if it is not installed."""
    try:
        path = Path(rospkg.RosPack().get_path("trident_bringup")) / DEFAULT_FORMATION
    except rospkg.ResourceNotFound:
        return ""
    return str(path)


def out_dir() -> Path | None:
    """Folder of the run's results: `~out_dir`, else the simulator's; None: nothing is written."""
    folder = get_param("out_dir") or rospy.get_param("/gazebo/out_dir", "")
    folder = folder or os.environ.get("TRIDENT_OUT")
    return Path(folder) if folder else None
