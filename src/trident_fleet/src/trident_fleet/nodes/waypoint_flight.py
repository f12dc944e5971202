# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Flies one vehicle through places that are counted from where it starts.

Parameters: `~vehicle`, name of the model and namespace of its topics; `~waypoints`, a list of
[x, y, z]: ahead, left and above of the start [m]; `~yaw_deg` of the start and of the whole
flight; limits and waits as those of a formation node (`v_max`, `a_max`, `hold_first` ...).
"""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import rospy
from trident_base.params import Recorded

from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource
from trident_fleet.core.quintic import Array
from trident_fleet.core.settings import FleetSettings, Vehicle, read_settings
from trident_fleet.nodes.flights import Flight, FlightContext, FlightMaker, formation_flight
from trident_fleet.nodes.formation_runner import FormationRunner, refuse
from trident_fleet.nodes.params import get_param, warn_of_unknown
from trident_ros import MISSION_PARAMETERS, init_node

_SPACING_M = 3.0


def rows_from(start: Array, yaw_rad: float, places: Array) -> Array:
    """Places of the world.

    Args:
        start: p_world of the vehicle [m], shape (3,).
        yaw_rad: its heading.
        places: ahead, left, above of the start [m], shape (n, 3).

    Returns:
        p_world [m], shape (n, 1, 3).
    """
    c, s = math.cos(yaw_rad), math.sin(yaw_rad)
    turned = places @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    return np.asarray((start + turned)[:, None])


def along_lines(places: Array, spacing_m: float) -> Array:
    """The same path with more places on its straight lines, so that a smooth flight keeps to them.

    Args:
        places: shape (n, 3) [m].
        spacing_m: between neighbours, at most [m].

    Returns:
        Shape (m, 3), m >= n, the given ones among them [m].
    """
    parts = [places[:1]]
    for begin, end in pairwise(places):
        count = max(math.ceil(float(np.linalg.norm(end - begin)) / spacing_m), 1)
        share = np.arange(1, count + 1)[:, None] / count
        parts.append(begin + share * (end - begin))
    return np.concatenate(parts)


def read_places(given: Any) -> Array:
    """`~waypoints`.

    Raises:
        FormationError: not a list of three finite numbers each.
    """
    legal = "a list of one or more [x, y, z]"
    try:
        places = np.array(given, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise FormationError(f"waypoints: {given!r}; legal: {legal}") from error
    if places.ndim != 2 or places.shape[1] != 3 or not np.isfinite(places).all():
        raise FormationError(f"waypoints: {given!r}; legal: {legal}")
    return places


def waypoint_flight(places: Array) -> FlightMaker:
    """Flights of one vehicle through places, shape (n, 3), counted from its start."""

    def make(context: FlightContext, spawn: Array, start_ns: int) -> Flight:
        path = along_lines(places, _SPACING_M)
        rows = rows_from(spawn[0], context.settings.plan.yaw_rad, path)
        return formation_flight(rows)(context, spawn, start_ns)

    return make


def main() -> int:
    """Run until the node is shut down.

    Returns:
        Exit code of the process.
    """
    init_node("waypoint_flight")
    name = str(rospy.get_param("~vehicle", ""))
    own = [Vehicle(name, f"/{name}/", 0)]
    settings = FleetSettings(FormationSource("waypoints"))
    try:
        if not name:
            raise FormationError("vehicle: ''; legal: the name of a model")
        get = Recorded(get_param)
        settings = replace(read_settings(get, "waypoints"), mode="time")
        warn_of_unknown({*get.asked, *MISSION_PARAMETERS})
        maker = waypoint_flight(read_places(get_param("waypoints")))
        FormationRunner(settings, own, own, maker, None).run()
    except FormationError as error:
        rospy.logfatal("waypoint_flight: %s", error)
        refuse(error, settings, own, None)
        return 1
    except (rospy.ROSException, rospy.ServiceException) as error:
        if not rospy.core.is_shutdown_requested():
            rospy.logfatal("waypoint_flight: %s", error)
            return 1
    return 0
