# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Entry points of the formation nodes: one vehicle per process, or all vehicles in one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import rospy
from trident_base.params import Recorded

from trident_fleet.core.errors import FormationError
from trident_fleet.core.file_check import too_close
from trident_fleet.core.files.formation_file import FormationSource, flying_rows, read_formation
from trident_fleet.core.quintic import Array
from trident_fleet.core.settings import (
    FleetSettings,
    Vehicle,
    fleet_around,
    fleet_of_names,
    names_of,
    read_settings,
    vehicle_of_line,
)
from trident_fleet.nodes.flights import formation_flight
from trident_fleet.nodes.formation_runner import FormationRunner, refuse
from trident_fleet.nodes.params import (
    default_formation_file,
    get_fleet_param,
    get_param,
    out_dir,
    warn_of_unknown,
)
from trident_ros import init_node

Lineup = tuple[list[Vehicle], list[Vehicle], Array]
"""The whole formation, the vehicles this process feeds, and the rows to fly."""

Getter = Callable[[str], Any]


def main_one(guard: bool = False) -> int:
    """Node that feeds one vehicle: `~UAV` is its topic prefix, `~seq` its first line in the file.

    Args:
        guard: default of `~guard`.

    Returns:
        Exit code of the process.
    """
    init_node("formation")
    prefix, seq = str(rospy.get_param("~UAV", "")), rospy.get_param("~seq", 0)
    own = Vehicle(prefix.strip("/").rsplit("/", 1)[-1], prefix, 0)

    def lineup(settings: FleetSettings) -> Lineup:
        if isinstance(seq, bool) or not isinstance(seq, int):
            raise FormationError(f"seq: {seq!r}; legal: a whole number, 0 or more")
        positions = read_formation(settings.source)
        uavs = settings.source.uavs or positions.shape[1]
        index, row = vehicle_of_line(seq, positions.shape[1], uavs)
        vehicles = fleet_around(prefix, index, uavs)
        return vehicles, [vehicles[index]], flying_rows(positions, uavs, row)

    # All processes read the same file: its error is reported once.
    return _run(lineup, [own], guard, is_spokesman=seq in (0, None))


def main_all() -> int:
    """Node that feeds all vehicles of the formation: `~vehicles`, by default UAV1, UAV2, ...

    Returns:
        Exit code of the process.
    """
    init_node("formation")
    given = get_param("vehicles")

    def lineup(settings: FleetSettings) -> Lineup:
        positions = read_formation(settings.source)
        uavs = settings.source.uavs or positions.shape[1]
        names = names_of(given) or [f"UAV{number + 1}" for number in range(uavs)]
        if len(names) != uavs:
            raise FormationError(f"vehicles: {len(names)} names for {uavs} vehicles; legal: {uavs}")
        vehicles = fleet_of_names(names)
        return vehicles, vehicles, flying_rows(positions, uavs)

    # A world that waits for this node has to hear of it even if the formation cannot be read.
    uavs = get_param("uavs")
    count = uavs if isinstance(uavs, int) and uavs > 0 else 1
    names = names_of(given) or [f"UAV{number + 1}" for number in range(count)]
    fed = [Vehicle(name, f"/{name}/", index) for index, name in enumerate(names)]
    return _run(lineup, fed, False, is_spokesman=True)


def _run(
    lineup: Callable[[FleetSettings], Lineup],
    fallback: list[Vehicle],
    guard: bool,
    is_spokesman: bool,
) -> int:
    settings = FleetSettings(FormationSource(default_formation_file()), guard=guard)
    folder = out_dir()
    try:
        get = Recorded(_with_default("guard", guard))
        settings = read_settings(get, settings.source.file)
        warn_of_unknown(get.asked, with_common=is_spokesman)
        vehicles, fed, rows = lineup(settings)
        for line in too_close(rows, settings) if is_spokesman else []:
            rospy.logwarn("formation: %s", line)
        FormationRunner(settings, vehicles, fed, formation_flight(rows), folder).run()
    except FormationError as error:
        (rospy.logfatal if is_spokesman else rospy.loginfo)("formation: %s", error)
        refuse(error, settings, fallback, folder)
        return 1
    except (rospy.ROSException, rospy.ServiceException) as error:
        # A simulator that goes away while it is asked something; on shutdown that is no news.
        if not rospy.core.is_shutdown_requested():
            rospy.logfatal("formation: %s", error)
            return 1
    return 0


def _with_default(name: str, default: Any) -> Getter:
    def get(asked: str) -> Any:
        value = get_fleet_param(asked)
        return default if value is None and asked == name else value

    return get
