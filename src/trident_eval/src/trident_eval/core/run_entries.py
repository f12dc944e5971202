# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Lists of `run.json` whose entries are objects."""

from __future__ import annotations

import math
from dataclasses import fields
from typing import TYPE_CHECKING, Any, TypeVar

from trident_eval.core.errors import EvalError

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

Entry = TypeVar("Entry", bound="DataclassInstance")


def read_entries(kind: type[Entry], run: dict[str, Any], key: str, where: str) -> list[Entry]:
    """Entries of a list of run.json.

    Args:
        kind: dataclass of an entry, of texts, bools, whole numbers and numbers.
        run: run.json; may be empty.
        key: of the list.
        where: path of run.json, for messages.

    Raises:
        EvalError: an entry is not what the simulator writes.
    """
    found = run.get(key, [])
    if not isinstance(found, list):
        raise EvalError(f"{where}: {key}: {found!r}; legal: a list of objects")
    return [_entry(kind, f"{where}: {key}[{index}]", entry) for index, entry in enumerate(found)]


def _entry(kind: type[Entry], where: str, entry: Any) -> Entry:
    if not isinstance(entry, dict):
        raise EvalError(f"{where}: {entry!r}; legal: an object")
    values = {}
    for field in fields(kind):
        if field.name not in entry:
            raise EvalError(f"{where}.{field.name}: missing; legal: {_LEGAL[str(field.type)]}")
        value = entry[field.name]
        if not _is_of(str(field.type), value):
            raise EvalError(f"{where}.{field.name}: {value!r}; legal: {_LEGAL[str(field.type)]}")
        values[field.name] = value
    return kind(**values)


_LEGAL = {
    "str": "a text that is not empty",
    "bool": "true or false",
    "int": "a whole number, at least 0",
    "float": "a number, at least 0",
}


def _is_of(kind: str, value: Any) -> bool:
    if isinstance(value, bool):
        return kind == "bool"
    if isinstance(value, str):
        return kind == "str" and value != ""
    if isinstance(value, int):
        return kind in ("int", "float") and value >= 0
    return kind == "float" and isinstance(value, float) and 0.0 <= value < math.inf
