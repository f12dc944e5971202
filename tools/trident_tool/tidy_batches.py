# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Sources that clang-tidy can read as one translation unit.

Nine tenths of its time go to headers that every source includes. Sources of equal flags are
therefore read together, once a batch, if no two of them hide something under the same name.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from trident_tool.tidy import CompileCommand

_NOT_CODE = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<raw>\w*)\(.*?\)(?P=raw)"'
    r"|\"(?:\\.|[^\"\\\n])*\"|(?<!\w)'(?:\\.|[^'\\\n])+'",
    re.DOTALL,
)
_UNNAMED = re.compile(r"\bnamespace\s*\{")
_TOKEN = re.compile(
    r"[{}();]|\b(?:class|struct|union|enum)\s+(?P<type>[A-Za-z_]\w*)"
    r"|\b(?P<name>[A-Za-z_]\w*)\s*(?P<next>[({=;\[]|:(?!:))?"
)
_MAIN = re.compile(r"^int main\(", re.MULTILINE)
_MACRO = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)", re.MULTILINE)


def hidden_names(text: str) -> set[str]:
    """What a source keeps to itself: names of its unnamed namespaces, its macros, main.

    The search is textual and takes too many rather than too few.
    """
    names = {*_MACRO.findall(text), *_MAIN.findall(text)}
    code = _NOT_CODE.sub(" ", text)
    for start in _UNNAMED.finditer(code):
        names |= _declared_names(code, start.end())
    return names


def _declared_names(code: str, start: int) -> set[str]:
    """Names declared between ``start`` and the brace that closes what was opened before it."""
    names: set[str] = set()
    depth = 0
    in_initializer = False
    for token in _TOKEN.finditer(code, start):
        mark = token["next"] or token.group()
        if token["type"] and depth == 0:
            names.add(token["type"])
            in_initializer = True  # base classes follow, or nothing
        elif token["name"] and token["next"] and depth == 0 and not in_initializer:
            names.add(token["name"])
            in_initializer = mark in "=:"
        if mark in ("{", "("):
            in_initializer = in_initializer and mark == "("
            depth += 1
        elif mark in ("}", ")"):
            depth -= 1
            if depth < 0:
                break
        elif mark == ";" and depth == 0:
            in_initializer = False
    return names


@dataclass
class _Batch:
    units: list[CompileCommand] = field(default_factory=list)
    names: set[str] = field(default_factory=set)


def _read(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace")


def batches(
    units: Iterable[CompileCommand], limit: int, read: Callable[[Path], str] = _read
) -> list[list[CompileCommand]]:
    """Groups of about ``limit`` units at most: alike in size, equal flags, no hidden name twice."""
    alike: dict[tuple[str, ...], list[CompileCommand]] = {}
    for unit in units:
        alike.setdefault(unit.flags, []).append(unit)
    return [batch for group in alike.values() for batch in _spread(group, limit, read)]


def _spread(
    units: list[CompileCommand], limit: int, read: Callable[[Path], str]
) -> list[list[CompileCommand]]:
    names = [hidden_names(read(unit.source)) for unit in units]
    most_shared = max(Counter(name for found in names for name in found).values(), default=1)
    count = max(most_shared, -(-len(units) // limit))
    spread = [_Batch() for _ in range(count)]
    for unit, found in sorted(zip(units, names, strict=True), key=lambda pair: -len(pair[1])):
        free = [batch for batch in spread if batch.names.isdisjoint(found)]
        if not free:
            free = [_Batch()]
            spread += free
        batch = min(free, key=lambda batch: len(batch.units))
        batch.units.append(unit)
        batch.names |= found
    return [batch.units for batch in spread if batch.units]


def batch_source(units: Iterable[CompileCommand]) -> str:
    """A source that includes those of ``units``."""
    return "".join(f'#include "{unit.source}"  // NOLINT\n' for unit in units)
