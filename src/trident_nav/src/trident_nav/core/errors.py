# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What is wrong with a configuration."""

from __future__ import annotations

import math


class NavError(ValueError):
    """Bad input; the text names the field, its value and what is legal."""


def require(name: str, value: float, lowest: float, highest: float, unit: str) -> None:
    """Raise NavError unless lowest <= value <= highest."""
    if not (math.isfinite(value) and lowest <= value <= highest):
        raise NavError(f"{name}: {value:g} {unit}, legal: {lowest:g} to {highest:g} {unit}")
