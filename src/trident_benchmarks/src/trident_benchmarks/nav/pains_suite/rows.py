# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A row of the suite pains, and its table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any


def pain(
    scene: str,
    rival: str,
    what: str,
    measured: float,
    limit: float,
    unit: str,
    *,
    is_least: bool = False,
    note: str = "",
) -> dict[str, Any]:
    """A measurement and its limit.

    Args:
        scene: the group of issues, "P1".
        rival: an issue of it.
        what: what was measured.
        measured: the value.
        limit: the most, or with is_least the least, that is good.
        unit: of both.
        is_least: see limit.
        note: what the number does not say.
    """
    return {
        "suite": "pains",
        "scene": scene,
        "rival": rival,
        "what": what,
        "measured": measured,
        "limit": limit,
        "unit": unit,
        "is_least": is_least,
        "passed": measured >= limit if is_least else measured <= limit,
        "note": note,
    }


def table(rows: Sequence[dict[str, Any]]) -> str:
    """Rows as Markdown, in the order of their scenes."""
    lines = ["| | rival | what | measured | limit | |", "|---|---|---|---|---|---|"]
    for row in sorted(rows, key=lambda row: int(row["scene"][1:])):
        unit = "" if row["unit"] == "1" else f" {row['unit']}"
        sign = ">=" if row["is_least"] else "<="
        lines.append(
            f"| {row['scene']} | {row['rival']} | {row['what']} | {row['measured']:.4g}{unit} |"
            f" {sign} {row['limit']:.4g}{unit} | {'yes' if row['passed'] else 'NO'} |"
        )
    return "\n".join(lines)
