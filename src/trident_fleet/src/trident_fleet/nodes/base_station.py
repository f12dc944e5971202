# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Entry point of a base station: flies one UAV to where some radio links are best."""

from __future__ import annotations

import rospy
from trident_base.params import Recorded

from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource
from trident_fleet.core.settings import FleetSettings, Vehicle
from trident_fleet.core.station.settings import TEXTS, read_station_settings
from trident_fleet.nodes.formation_runner import FormationRunner, refuse
from trident_fleet.nodes.params import out_dir, warn_of_unknown
from trident_fleet.nodes.station_flight import station_flight
from trident_ros import init_node


def main() -> int:
    """Run until the node is shut down.

    Returns:
        Exit code of the process.
    """
    init_node("base_station")
    folder = out_dir()
    try:
        get = Recorded(lambda name: rospy.get_param("~" + name, None))
        settings = read_station_settings(get)
        warn_of_unknown(get.asked)
        vehicles = [settings.vehicle]
        maker = station_flight(settings, folder)
        FormationRunner(settings.fleet, vehicles, vehicles, maker, folder).run()
    except FormationError as error:
        rospy.logfatal("base_station: %s", error)
        name = str(rospy.get_param("~vehicle", TEXTS["vehicle"])).strip("/")
        refuse(error, FleetSettings(FormationSource("")), [Vehicle(name, f"/{name}/", 0)], None)
        return 1
    except (rospy.ROSException, rospy.ServiceException) as error:
        # A simulator that goes away while it is asked something; on shutdown that is no news.
        if not rospy.core.is_shutdown_requested():
            rospy.logfatal("base_station: %s", error)
            return 1
    return 0
