# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Figures of the bridges' benchmark as text, each with its limit next to it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

#: Keys of figures in the order in which they are printed, and their texts.
FIGURES = {
    "median_ms": "median {:.3f} ms",
    "over_echo_ms": "{:+.3f} ms over the echo",
    "p99_ms": "99 % {:.3f} ms",
    "messages_s": "{:.0f} messages/s",
    "sentences_s": "{:.0f} sentences/s",
    "pdus_s": "{:.0f} PDUs/s",
    "mbit_s": "{:.1f} Mbit/s",
    "lost": "{} lost",
    "lost_share": "{:.6f} of them",
    "kernel_drops": "{} of them dropped by the kernel",
    "overwritten": "{} overwritten by newer ones",
    "cpu_ms_per_1000": "{:.3g} CPU ms for 1000",
    "bulk_cpu_ms_per_1000": "{:.3g} in bulk",
    "cpu_s_per_s": "{:.3f} CPU s per simulated s",
    "rss_mb": "{:.1f} MB",
}


class Limit(NamedTuple):
    """What is asked of a figure.

    Attributes:
        key: of the figure, of FIGURES.
        bound: that it must keep.
        is_floor: whether it must not be less than the bound; otherwise not more.
    """

    key: str
    bound: float
    is_floor: bool = False

    def holds(self, figures: Mapping[str, Any]) -> bool:
        """Whether the figure is there and keeps its bound."""
        value = figures.get(self.key)
        if value is None:
            return False
        return bool(value >= self.bound if self.is_floor else value <= self.bound)

    def text(self) -> str:
        """As it stands next to the figure."""
        return f"{'>=' if self.is_floor else '<='} {self.bound:,.15g}"


def at_most(key: str, bound: float) -> Limit:
    """A figure must not be more."""
    return Limit(key, bound)


def at_least(key: str, bound: float) -> Limit:
    """A figure must not be less."""
    return Limit(key, bound, is_floor=True)


def as_json(limits: Sequence[Limit]) -> dict[str, dict[str, float]]:
    """Limits by their figures: {"median_ms": {"max": 0.25}}."""
    return {one.key: {"min" if one.is_floor else "max": one.bound} for one in limits}


def figures_text(figures: Mapping[str, Any], limits: Sequence[Limit]) -> str:
    """All figures that are there, each with its limit; a missed one is marked."""
    by_key = {one.key: one for one in limits}
    parts = []
    for key, form in FIGURES.items():
        value, limit = figures.get(key), by_key.get(key)
        if value is None:
            continue
        text = form.format(value)
        if limit is not None:
            text += f" ({limit.text()}{'' if limit.holds(figures) else ', MISSED'})"
        parts.append(text)
    return "; ".join(parts)
