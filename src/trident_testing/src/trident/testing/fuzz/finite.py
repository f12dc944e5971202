# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers in messages that are not finite."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import genpy

#: Where infinity or NaN says that there was nothing to measure (REP 117, REP 118), that a parameter
#: has no limit, or that its value follows from others.
_MEANT = {
    ("sensor_msgs/LaserScan", "ranges"),
    ("sensor_msgs/LaserScan", "intensities"),
    ("sensor_msgs/Range", "range"),
    ("geometry_msgs/Point32", "x"),
    ("geometry_msgs/Point32", "y"),
    ("geometry_msgs/Point32", "z"),
    ("dynamic_reconfigure/DoubleParameter", "value"),
}


def non_finite(message: Any) -> str:
    """The first field of a message that is NaN or infinite and must not be, as text; or empty."""
    return next(_found(message, ""), "")


def _found(value: Any, path: str) -> Iterator[str]:
    if isinstance(value, float):
        if not math.isfinite(value):
            yield f"{path} is {value}"
    elif isinstance(value, genpy.Message):
        for name, kind in zip(value.__slots__, value._slot_types, strict=True):
            if kind.startswith(("uint", "int", "string", "bool", "time", "duration")):
                continue
            if (value._type, name) not in _MEANT:
                yield from _found(getattr(value, name), f"{path}.{name}" if path else name)
    elif isinstance(value, (list, tuple)):
        if value and isinstance(value[0], float) and all(map(math.isfinite, value)):
            return
        for index, item in enumerate(value):
            yield from _found(item, f"{path}[{index}]")
