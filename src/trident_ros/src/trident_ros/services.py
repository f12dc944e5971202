# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What the master knows of services."""

import rosgraph
import rospy


def is_offered(service: str) -> bool:
    """Whether a node offers a service at present; does not wait for one."""
    try:
        rosgraph.Master(rospy.get_name()).lookupService(service)
    except rosgraph.MasterError:
        return False
    return True
