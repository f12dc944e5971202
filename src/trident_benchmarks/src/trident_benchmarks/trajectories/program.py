# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The trial program, which prints a line of JSON for each plan."""

from __future__ import annotations

from typing import Any

from trident_benchmarks.programs import rows_of


def trials(what: str, *numbers: int) -> list[dict[str, Any]]:
    """What it prints; see `rows_of`."""
    return rows_of("trident_benchmarks", "trajectory_trial", (what, *map(str, numbers)))
