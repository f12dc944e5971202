# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Ranges of what a generator is given."""

from __future__ import annotations

from trident_base import params
from trident_sim import Error


def require(name: str, value: float, lowest: float, highest: float, unit: str = "m") -> None:
    """Raise Error unless lowest <= value <= highest."""
    params.require(name, value, lowest, highest, unit, Error)


def require_count(name: str, value: int, highest: int) -> None:
    """Raise Error unless 0 <= value <= highest."""
    require(name, value, 0, highest, "")


def require_seed(seed: int) -> None:
    """Raise Error unless numpy takes it."""
    require_count("seed", seed, 2**32 - 1)
