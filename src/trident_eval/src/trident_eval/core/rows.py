# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""One line of a verdict for people, and how its values are written."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Row:
    """One line of a verdict.

    Attributes:
        label: what it is.
        value: with its unit.
        limit: what it is held against; "" where nothing is, or the value says it.
        is_satisfied: whether the value is as it must be; None where any value is.
    """

    label: str
    value: str
    limit: str = ""
    is_satisfied: bool | None = None


def value_text(value: Any, unit: str) -> str:
    """A number with its unit; three decimals unless it is a whole number."""
    text = f"{value:.3f}" if isinstance(value, float) else str(value)
    return f"{text} {unit}".strip()
