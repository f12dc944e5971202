# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Links by formulas, and flights of a base station among them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from trident_fleet.core.base_station import BaseStation, Phase
from trident_fleet.core.quintic import Array
from trident_fleet.core.station.visits import Heard, Place

DT = 0.1
TIMES = np.arange(10) * 0.01
_EACH = 5

Link = Callable[[Array, Array], float]
"""SNR [dB] by the places of both ends."""


def free_space(level_db: float = 61.0) -> Link:
    """The law of distance alone."""
    return lambda a, b: level_db - 20.0 * float(np.log10(np.linalg.norm(a - b)))


@dataclass
class Flight:
    """A station in an air of formulas, which is where its set-points are.

    Attributes:
        station: that decides.
        others: where the robots are [m], by a function of time [s].
        link: the law of all links.
        battery: state of charge by time.
        hears: whether it hears anything, by time.
        know: whether the robots say where they are.
        points: set-points so far, (time, p_world).
        phases: (time, phase) of each change.
        position: of the last set-point [m].
        said: where the robots have said they are.
    """

    station: BaseStation
    others: dict[str, Callable[[float], Array]]
    link: Link = field(default_factory=free_space)
    battery: Callable[[float], float | None] = lambda _: None
    hears: Callable[[float], bool] = lambda _: True
    know: bool = True
    time_s: float = 0.0
    points: list[Array] = field(default_factory=list)
    phases: list[tuple[float, Phase]] = field(default_factory=list)
    position: Array = field(default_factory=lambda: np.zeros(3))
    said: dict[str, Place] = field(default_factory=dict)

    def run(self, seconds: float) -> None:
        """Fly on."""
        for _ in range(round(seconds / DT)):
            if round(self.time_s / DT) % _EACH == 0:
                self.station.decide(self._heard())
            if not self.phases or self.phases[-1][1] is not self.station.phase:
                self.phases.append((self.time_s, self.station.phase))
            motion = self.station.period(TIMES, DT)
            self.points.extend(motion.position[:, 0])
            self.position = motion.position[-1, 0]
            self.time_s += DT

    def _heard(self) -> Heard:
        now_s = self.time_s
        if self.hears(now_s) and self.know:
            self.said = {name: Place(at(now_s), now_s) for name, at in self.others.items()}
        snr = dict.fromkeys(self.others, -np.inf)
        if self.hears(now_s):
            snr = {name: self.link(self.position, at(now_s)) for name, at in self.others.items()}
        return Heard(now_s, self.position, snr, dict(self.said), self.battery(now_s))

    def worst_db(self, position: Array) -> float:
        """Of all links from a place now [dB]."""
        return min(self.link(position, at(self.time_s)) for at in self.others.values())

    @property
    def names(self) -> list[str]:
        """Of the phases so far."""
        return [phase.value for _, phase in self.phases]
