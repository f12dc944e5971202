# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Messages as bytes: compressed JSON, for networks that carry bytes."""

from __future__ import annotations

import json
import zlib
from collections.abc import Callable
from dataclasses import asdict, fields
from typing import Any

from trident_fleet.core.tasks.fields import TaskError
from trident_fleet.core.tasks.intake import check_fields
from trident_fleet.core.tasks.messages import (
    State,
    TaskAnnounce,
    TaskAward,
    TaskBid,
    TaskConfirm,
    TaskMessage,
    TaskProgress,
    TaskState,
    TaskTable,
)

_KINDS: dict[str, Any] = {
    kind.__name__: kind
    for kind in (TaskAnnounce, TaskBid, TaskAward, TaskConfirm, TaskProgress, TaskTable)
}
_MOST_ROBOTS = 255  # of a task
_LONGEST = 1 << 20  # of what comes out of a message, against one that was made to fill the memory


def encode(message: TaskMessage) -> bytes:
    """A message as bytes."""
    text = json.dumps({"type": type(message).__name__} | asdict(message), separators=(",", ":"))
    return zlib.compress(text.encode())


def decode(data: bytes) -> TaskMessage:
    """A message from bytes.

    Raises:
        TaskError: names field, value and what is legal.
    """
    try:
        found = json.loads(zlib.decompressobj().decompress(data, _LONGEST))
    except (zlib.error, ValueError, RecursionError) as error:
        raise TaskError(f"message: {error}, legal: compressed JSON") from None
    name = found.get("type") if isinstance(found, dict) else None
    if not isinstance(name, str) or name not in _KINDS:
        raise TaskError(f"message: type is {name!r}, legal: {', '.join(_KINDS)}")
    message: TaskMessage = _built(_KINDS[name], found)
    return message


def _built(kind: Any, found: Any) -> Any:
    if not isinstance(found, dict):
        raise TaskError(f"{kind.__name__}: is {found!r}, legal: an object")
    values = {}
    for item in fields(kind):
        value = found.get(item.name)
        try:
            values[item.name] = _READERS[str(item.type)](value)
        except (ValueError, TypeError):
            text = f"{kind.__name__}: {item.name} is {value!r}, legal: {item.type}"
            raise TaskError(text) from None
    made = kind(**values)
    if kind is TaskAnnounce:
        check_fields(made, _MOST_ROBOTS)
    return made


def _exactly(*kinds: type) -> Callable[[Any], Any]:
    def read(value: Any) -> Any:
        if type(value) not in kinds:
            raise TypeError
        return value

    return read


def _tuple_of(read: Callable[[Any], Any]) -> Callable[[Any], tuple[Any, ...]]:
    def read_all(value: Any) -> tuple[Any, ...]:
        if not isinstance(value, list):
            raise TypeError
        return tuple(read(one) for one in value)

    return read_all


def _number(value: Any) -> float:
    return float(_exactly(int, float)(value))


def _point(value: Any) -> tuple[float, ...]:
    read = _tuple_of(_number)(value)
    if len(read) != 3:
        raise ValueError
    return read


_READERS: dict[str, Callable[[Any], Any]] = {
    "str": _exactly(str),
    "int": _exactly(int),
    "bool": _exactly(bool),
    "float": _number,
    "Point": _point,
    "State": lambda value: State(_exactly(int)(value)),
    "tuple[str, ...]": _tuple_of(_exactly(str)),
    "TaskAnnounce": lambda value: _built(TaskAnnounce, value),
    "tuple[TaskState, ...]": _tuple_of(lambda value: _built(TaskState, value)),
}
