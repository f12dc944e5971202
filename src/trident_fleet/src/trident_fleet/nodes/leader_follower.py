# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Entry point of the leader-follower node: one process feeds all followers of a leader."""

from __future__ import annotations

import rospy
from trident_base.params import Recorded

from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource
from trident_fleet.core.follow.follow_settings import read_follow_settings
from trident_fleet.core.settings import FleetSettings, Vehicle, names_of
from trident_fleet.nodes.follow_flight import follow_flight
from trident_fleet.nodes.formation_runner import FormationRunner, refuse
from trident_fleet.nodes.params import out_dir, warn_of_unknown
from trident_ros import init_node


def main() -> int:
    """Node that keeps `~followers` in their places around `~leader`.

    Returns:
        Exit code of the process.
    """
    init_node("leader_follower")
    folder = out_dir()
    try:
        get = Recorded(lambda name: rospy.get_param("~" + name, None))
        settings = read_follow_settings(get)
        warn_of_unknown({*get.asked, "pattern", "spacing", "opening_deg"})
        FormationRunner(
            settings.fleet, settings.followers, settings.followers, follow_flight(settings), folder
        ).run()
    except FormationError as error:
        rospy.logfatal("leader_follower: %s", error)
        names = names_of(rospy.get_param("~followers", None))
        fed = [Vehicle(name, f"/{name}/", index) for index, name in enumerate(names)]
        refuse(error, FleetSettings(FormationSource("")), fed, folder)
        return 1
    except (rospy.ROSException, rospy.ServiceException) as error:
        # A simulator that goes away while it is asked something; on shutdown that is no news.
        if not rospy.core.is_shutdown_requested():
            rospy.logfatal("leader_follower: %s", error)
            return 1
    return 0
