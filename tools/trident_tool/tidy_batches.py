# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Sources that clang-tidy can read as one translation unit.

Nine tenths of its time go to headers that every source includes. Sources of equal flags are
therefore read together, once a batch, if no two of them hide something under the same name.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from trident_tool.hidden_names import hidden_names

if TYPE_CHECKING:
    from trident_tool.tidy import CompileCommand


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
