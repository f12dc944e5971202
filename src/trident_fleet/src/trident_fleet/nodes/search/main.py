# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Entry point of a team that searches and rescues in the simulator.

Parameters: `~scene`, the record of a coast as `./trident worldgen coast` writes it; `~numbers` and
`~tree`, files of config/missions; `~mode`, `~method`, `~links`, `~seed`, see `Setup`; `~duration`,
simulated time at which the mission is over at the latest [s], 0: as `~numbers` has it; `~kill`,
robots that die: `usv1@270, uav1@300` [s]. Models are called as the robots: uav1, ugv1, usv1.
"""

from __future__ import annotations

import rospy
from trident_base.params import Recorded

from trident_fleet.core.errors import FormationError
from trident_fleet.nodes.params import out_dir, warn_of_unknown
from trident_fleet.nodes.search.settings import read_team
from trident_fleet.nodes.search.team import TeamNode
from trident_ros import init_node


def main() -> int:
    """Run until the mission and the world are over, or the node is shut down.

    Returns:
        Exit code of the process.
    """
    init_node("search_and_rescue")
    try:
        get = Recorded(lambda name: rospy.get_param("~" + name, None))
        settings = read_team(get)
        warn_of_unknown(get.asked)
        TeamNode(settings, out_dir()).run()
    except FormationError as error:
        rospy.logfatal("search_and_rescue: %s", error)
        return 1
    except (rospy.ROSException, rospy.ServiceException) as error:
        # A simulator that goes away while it is asked something; on shutdown that is no news.
        if not rospy.core.is_shutdown_requested():
            rospy.logfatal("search_and_rescue: %s", error)
            return 1
    return 0
