# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Private parameters that a node does not know: most likely typing errors."""

from __future__ import annotations

from collections.abc import Iterable

import rospy
from trident_base.params import unknown

#: Of a mission's file, which nodes are given as it is: where it starts, what the run is judged by.
MISSION_PARAMETERS = ("kind", "start", "reach", "tracking_limit")


def warn_of_unknown_parameters(known: Iterable[str], namespace: str = "~") -> None:
    """One warning about the parameters in a node's namespace that it does not read.

    Args:
        known: names that it reads, also those of its topics and services that have parameters.
        namespace: where to look; the private one by default.
    """
    given = rospy.get_param(namespace, {})
    texts = unknown(given, known) if isinstance(given, dict) else []
    if texts:
        where = rospy.resolve_name(namespace)
        rospy.logwarn("parameters of %s are not used: %s", where, ", ".join(texts))
