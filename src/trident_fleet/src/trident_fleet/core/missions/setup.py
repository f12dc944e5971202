# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Which team searches how, and how it ended."""

from __future__ import annotations

import math
from dataclasses import dataclass

from trident_fleet.core.search.area import SearchError

MODES: dict[str, tuple[str, ...]] = {
    "joint": ("uav", "ugv", "usv"),
    "uav": ("uav",),
    "ugv": ("ugv",),
    "usv": ("usv",),
    "three_uavs": ("uav",) * 3,
    "three_ugvs": ("ugv",) * 3,
    "three_usvs": ("usv",) * 3,
}
"""Kinds of the robots by mode."""

RECORD = "search_and_rescue.json"
"""Name of a mission's record in the folder of a run."""

FIXED = "fixed"
"""Instead of a method: pieces are shared out before the mission, by time."""


def death_of(name: str, text: str) -> tuple[str, float]:
    """Which robot dies when [s], of ROBOT@SECONDS.

    Args:
        name: of the option that has it.
        text: its value.

    Raises:
        SearchError: it has another form.
    """
    robot, _, seconds = text.partition("@")
    try:
        death_s = float(seconds)
    except ValueError:
        death_s = math.nan
    if not robot or not 0.0 <= death_s < math.inf:
        raise SearchError(f"{name} {text}; legal: ROBOT@SECONDS, finite, from 0")
    return robot, death_s


LINKS = ("network", "perfect")


def names_of(mode: str) -> list[str]:
    """Of the robots: the kind and a number."""
    kinds = MODES[mode]
    return [f"{kind}{kinds[: index + 1].count(kind)}" for index, kind in enumerate(kinds)]


@dataclass(frozen=True)
class Setup:
    """What is flown.

    Attributes:
        mode: of the team, by name.
        method: of allocation, by name, or `fixed`.
        links: network or perfect.
        seed: of all that is random but the scene.
        deaths: when robots die, by name [s].
        silences: robots whose link is out: name, from, to [s].
    """

    mode: str = "joint"
    method: str = "improved"
    links: str = "network"
    seed: int = 1
    deaths: tuple[tuple[str, float], ...] = ()
    silences: tuple[tuple[str, float, float], ...] = ()

    def __post_init__(self) -> None:
        """Refuse unknown names.

        Raises:
            SearchError: names field, value and what is legal.
        """
        if self.mode not in MODES:
            raise SearchError(f"mission: mode is {self.mode!r}, legal: {', '.join(MODES)}")
        if self.links not in LINKS:
            raise SearchError(f"mission: links is {self.links!r}, legal: {', '.join(LINKS)}")
        names = names_of(self.mode)
        for name in [name for name, *_ in (*self.deaths, *self.silences)]:
            if name not in names:
                raise SearchError(f"mission: robot is {name!r}, legal: {', '.join(names)}")


@dataclass(frozen=True)
class Outcome:
    """How a mission ended; times in s, lengths in m, shares 0 ... 1.

    Attributes:
        end_s: all was done, or time was up.
        complete: all was done.
        coverage: share of the cells that have been seen well enough.
        people: how many there are.
        found: how many of them were found.
        confirmed: a robot has stood near how many.
        served: how many.
        sectors: that are covered.
        value: of all that.
        find_s: when each was found.
        path_m: of each robot.
        contacts: instants at which two of a medium touched, away from the base.
        messages: that were sent.
        curve: coverage every ten seconds.
        lost: what was not achieved, and who was lost, by name.
    """

    end_s: float
    complete: bool
    coverage: float
    people: int
    found: int
    confirmed: int
    served: int
    sectors: int
    value: float
    find_s: tuple[float, ...]
    path_m: dict[str, float]
    contacts: int
    messages: int
    curve: tuple[float, ...]
    lost: tuple[str, ...]

    @property
    def efficiency(self) -> float:
        """Value per minute [1/min]."""
        return 60.0 * self.value / self.end_s
