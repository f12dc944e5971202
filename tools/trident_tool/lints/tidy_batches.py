# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Sources that clang-tidy can read as one translation unit.

Nine tenths of its time go to headers that every source includes. Sources that the build compiles
together (cmake's unity build) are therefore read together, two such groups of equal flags at a
time. Where two sources of a batch hide something under one name, that batch has findings, and is
read again by halves.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from trident_tool.lints.tidy import CompileCommand


def batches(units: Iterable[CompileCommand], limit: int) -> list[list[CompileCommand]]:
    """Groups of at most ``limit`` units with equal flags, in the order of the build."""
    alike: dict[tuple[str, ...], list[CompileCommand]] = {}
    for unit in units:
        alike.setdefault(unit.flags, []).append(unit)
    return [
        group[start : start + limit]
        for group in alike.values()
        for start in range(0, len(group), limit)
    ]


def batch_source(units: Iterable[CompileCommand]) -> str:
    """A source that includes those of ``units``."""
    return "".join(f'#include "{unit.source}"  // NOLINT\n' for unit in units)
