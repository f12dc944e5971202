# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Private parameters as a configuration, and velocities as messages."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, TypeVar

import rospy
from geometry_msgs.msg import Twist

from trident_nav.core.errors import NavError
from trident_nav.core.velocity import Velocity

Config = TypeVar("Config")


def read_config(kind: type[Config]) -> Config:
    """A configuration from `~field` parameters; fields without one have their defaults.

    Raises:
        NavError: a parameter of the wrong type.
    """
    values: dict[str, Any] = {}
    for item in fields(kind):  # type: ignore[arg-type]
        value = rospy.get_param("~" + item.name, None)
        if value is not None:
            values[item.name] = _typed(item.name, value, type(item.default))
    return kind(**values)


def _typed(name: str, value: Any, kind: type) -> Any:
    if kind is float and isinstance(value, int) and not isinstance(value, bool):
        return float(value)
    if isinstance(value, kind) and (kind is bool or not isinstance(value, bool)):
        return value
    legal = {float: "a number", int: "a whole number", bool: "true or false"}.get(kind, "text")
    raise NavError(f"~{name}: {value!r}, legal: {legal}")


def twist(velocity: Velocity) -> Twist:
    """As a message."""
    message = Twist()
    message.linear.x, message.angular.z = velocity
    return message
