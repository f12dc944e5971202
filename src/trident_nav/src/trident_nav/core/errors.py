# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What is wrong with a configuration."""

from __future__ import annotations

from trident_base import params


class NavError(ValueError):
    """Bad input; the text names the field, its value and what is legal."""


def require(name: str, value: float, lowest: float, highest: float, unit: str) -> None:
    """Raise NavError unless lowest <= value <= highest."""
    params.require(name, value, lowest, highest, unit, NavError)
