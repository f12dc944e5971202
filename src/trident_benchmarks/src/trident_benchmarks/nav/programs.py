# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Benchmark programs of trident_nav."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from trident_benchmarks import programs

_LIMIT_S = 1800.0  # wall time


def rows_of(name: str, words: Sequence[str] = ()) -> list[dict[str, Any]]:
    """The rows that a program prints; see `programs.rows_of`."""
    return programs.rows_of("trident_nav", name, words, _LIMIT_S)
