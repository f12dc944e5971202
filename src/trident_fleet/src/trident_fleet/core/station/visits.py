# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a base station has heard, and where it was then."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from trident_fleet.core.quintic import Array
from trident_fleet.core.station.link_field import Measurement

_KEPT = 4000
_SAME_M = 0.4


@dataclass(frozen=True)
class Place:
    """Where a robot was.

    Attributes:
        position: p_world [m], shape (3,).
        time_s: when [s].
    """

    position: Array
    time_s: float


@dataclass(frozen=True)
class Heard:
    """What is known as a decision is made.

    Attributes:
        time_s: of the decision [s].
        position: of the UAV, measured, p_world [m], shape (3,).
        snr_db: of its links by the other robot's name, those of the newest status; -inf: not heard.
        others: the newest known place of each robot.
        battery: state of charge, 0 to 1; None: not known.
    """

    time_s: float
    position: Array
    snr_db: dict[str, float] = field(default_factory=dict)
    others: dict[str, Place] = field(default_factory=dict)
    battery: float | None = None

    def known(self, names: list[str]) -> dict[str, Place]:
        """Where robots are, of those that have said it."""
        return {name: self.others[name] for name in names if name in self.others}


@dataclass(frozen=True)
class Visit:
    """The links at a place.

    Attributes:
        heard: what was known there.
        worst_db: of the links asked for, all of which were in the status.
    """

    heard: Heard
    worst_db: float

    @property
    def position(self) -> Array:
        """Of the UAV [m, world]."""
        return self.heard.position

    def away_m(self, others: list[Visit]) -> float:
        """Distance from the nearest of other visits [m]; infinite without any."""
        return min((math.dist(self.position, other.position) for other in others), default=math.inf)


def _is_same(one: Measurement, other: Measurement) -> bool:
    moved_m = math.dist(one.position, other.position), math.dist(one.other, other.other)
    return max(moved_m) < _SAME_M


class Visits:
    """Everything that was heard so far."""

    def __init__(self, links: list[str], unheard_db: float) -> None:
        """Know nothing.

        Args:
            links: names of the robots whose links are asked for.
            unheard_db: what a link counts at least [dB].
        """
        self._links, self._unheard_db = links, unheard_db
        self._all: deque[Heard] = deque(maxlen=_KEPT)
        self._heard_s: float | None = None

    def add(self, heard: Heard) -> None:
        """Take what was heard at one more instant."""
        self._all.append(heard)
        is_heard = any(heard.snr_db.get(name, -np.inf) > self._unheard_db for name in self._links)
        if is_heard or self._heard_s is None:
            self._heard_s = heard.time_s

    def forget_before(self, time_s: float) -> None:
        """What was heard earlier counts no more."""
        while self._all and self._all[0].time_s < time_s:
            self._all.popleft()

    def mean_db(self, since_s: float) -> float | None:
        """Mean of the worst link since an instant [dB]; None: there was no status."""
        found = [self.worst_db(heard) for heard in self._all if heard.time_s >= since_s]
        known = [worst_db for worst_db in found if worst_db is not None]
        return float(np.mean(known)) if known else None

    def silent_s(self, time_s: float) -> float:
        """For how long none of the links was heard [s]; counts from the first instant."""
        return 0.0 if self._heard_s is None else time_s - self._heard_s

    def worst_db(self, heard: Heard) -> float | None:
        """Of the links asked for [dB]; None: the status had not all of them."""
        if any(name not in heard.snr_db for name in self._links):
            return None
        return min(max(heard.snr_db[name], self._unheard_db) for name in self._links)

    def measurements(self, name: str, count: int) -> list[Measurement]:
        """The newest of a link, oldest first; of those at one place the last one."""
        found: list[Measurement] = []
        for heard in reversed(self._all):
            measurement = self._measurement(name, heard)
            if measurement is not None and not (found and _is_same(measurement, found[-1])):
                found.append(measurement)
            if len(found) == count:
                break
        return found[::-1]

    def newest(self, name: str) -> Measurement | None:
        """That of the newest instant; None: it had none."""
        return self._measurement(name, self._all[-1]) if self._all else None

    def _measurement(self, name: str, heard: Heard) -> Measurement | None:
        other, snr_db = heard.others.get(name), heard.snr_db.get(name)
        if other is None or snr_db is None:
            return None
        snr_db = max(snr_db, self._unheard_db)
        return Measurement(heard.time_s, heard.position, other.position, snr_db)

    def best(
        self, others: dict[str, Place], near_m: float, count: int, apart_m: float
    ) -> list[Visit]:
        """The best places, best first.

        Args:
            others: where the robots are now; visits count when they were near there.
            near_m: how near [m].
            count: of the places, at most.
            apart_m: from each other [m].
        """
        chosen: list[Visit] = []
        for visit in self._ranked(others, near_m):
            if len(chosen) == count:
                break
            if visit.away_m(chosen) >= apart_m:
                chosen.append(visit)
        return chosen

    def _ranked(self, others: dict[str, Place], near_m: float) -> Iterator[Visit]:
        """The visits when all robots were near where they are now, best first."""
        visits = self._visits()
        if visits:
            is_alike = self._alike(visits, others, near_m)
            worst = np.where(is_alike, [visit.worst_db for visit in visits], -np.inf)
            order = np.argsort(-worst, kind="stable")
            yield from (visits[index] for index in order if is_alike[index])

    def _visits(self) -> list[Visit]:
        """Where the status had all links asked for."""
        found = [(heard, self.worst_db(heard)) for heard in self._all]
        return [Visit(heard, worst_db) for heard, worst_db in found if worst_db is not None]

    def _alike(
        self, visits: list[Visit], others: dict[str, Place], near_m: float
    ) -> npt.NDArray[np.bool_]:
        """Whether all robots were near where they are now, by visit."""
        nowhere = np.full(3, np.inf)
        result = np.ones(len(visits), dtype=bool)
        heard = [visit.heard for visit in visits]
        for name in self._links:
            if name in others:
                then = [h.others[name].position if name in h.others else nowhere for h in heard]
                away = np.array(then) - others[name].position
                result &= np.linalg.norm(away, axis=1) <= near_m
        return result

    def moved_m(self, now: Heard, since_s: float) -> float:
        """How far any robot of the links has moved at least since an instant [m]."""
        before = next((heard for heard in self._all if heard.time_s >= since_s), now)
        return max(
            (
                float(np.linalg.norm(now.others[name].position - before.others[name].position))
                for name in self._links
                if name in now.others and name in before.others
            ),
            default=0.0,
        )
