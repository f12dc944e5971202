# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What our nodes share: their start, checks of incoming messages, refusals that are counted."""

from trident_ros.message_checks import (
    FARTHEST_M,
    LATEST_STAMP_S,
    numbers_problem,
    point_problem,
    pose_problem,
    quoted,
    stamp_problem,
)
from trident_ros.node import init_node
from trident_ros.refusals import Refusals
from trident_ros.services import is_offered
from trident_ros.unknown_parameters import MISSION_PARAMETERS, warn_of_unknown_parameters

__all__ = [
    "FARTHEST_M",
    "LATEST_STAMP_S",
    "MISSION_PARAMETERS",
    "Refusals",
    "init_node",
    "is_offered",
    "numbers_problem",
    "point_problem",
    "pose_problem",
    "quoted",
    "stamp_problem",
    "warn_of_unknown_parameters",
]
