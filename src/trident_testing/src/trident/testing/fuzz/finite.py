# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers in messages that are not finite."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
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
        yield from _found_in_message(value, path)
    elif isinstance(value, (list, tuple)):
        yield from _found_in_list(value, path)


def _found_in_message(message: genpy.Message, path: str) -> Iterator[str]:
    for name, kind in zip(message.__slots__, message._slot_types, strict=True):
        if kind.startswith(("uint", "int", "string", "bool", "time", "duration")):
            continue
        if (message._type, name) not in _MEANT:
            yield from _found(getattr(message, name), f"{path}.{name}" if path else name)


def _found_in_list(values: Sequence[Any], path: str) -> Iterator[str]:
    if values and isinstance(values[0], float) and all(map(math.isfinite, values)):
        return
    for index, item in enumerate(values):
        yield from _found(item, f"{path}[{index}]")
