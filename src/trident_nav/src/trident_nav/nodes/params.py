# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Private parameters as a configuration, and velocities as messages."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

import rospy
from geometry_msgs.msg import Twist
from trident_base.params import Params, read

from trident_nav.core.errors import NavError
from trident_nav.core.velocity import Velocity
from trident_ros import warn_of_unknown_parameters

Config = TypeVar("Config")


def read_config(kind: type[Config], also: Iterable[str] = ()) -> Config:
    """A configuration from `~field` parameters; fields without one have their defaults.

    One warning lists the private parameters that are not known.

    Args:
        kind: a dataclass with a default for each field.
        also: other private parameters that the node reads itself.

    Raises:
        NavError: a parameter of the wrong type.
    """
    params = Params(lambda name: rospy.get_param("~" + name, None), NavError, "~", ", ")
    config = read(kind(), params)
    warn_of_unknown_parameters({*params.asked, *also})
    return config


def twist(velocity: Velocity) -> Twist:
    """As a message."""
    message = Twist()
    message.linear.x, message.angular.z = velocity
    return message
