# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What is true in a mission, whatever robots believe: people, coverage, what it is worth."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from trident_fleet.core.missions.kinds import Kind, MissionConfig
from trident_fleet.core.missions.scene import Place, Scene
from trident_fleet.core.search.area import Array
from trident_fleet.core.search.coverage import Coverage
from trident_fleet.core.search.detection import Eye, View, chance
from trident_fleet.core.search.drift import Flow, random_leeways

_STANDS_M_S = 0.5  # a robot that keeps to somebody who drifts stands

_VALUE_SECTOR, _VALUE_CONFIRMED, _VALUE_SERVED = 1.0, 2.0, 4.0


@dataclass
class PersonState:
    """One who is to be found; times in s, None: not yet.

    Attributes:
        name: of the person.
        domain: in which a rescuer moves: ground or water.
        found_s: detected for the first time.
        confirmed_s: a robot has stood nearby long enough.
        served_s: a rescuer has.
    """

    name: str
    domain: str
    found_s: float | None = None
    confirmed_s: float | None = None
    served_s: float | None = None
    _near_s: dict[tuple[str, str], float] = field(default_factory=dict)

    def stay(self, robot: str, what: str, is_there: bool, seconds: float) -> float:
        """How long a robot has been there without a break [s]."""
        stayed = self._near_s.get((robot, what), 0.0) + seconds if is_there else 0.0
        self._near_s[robot, what] = stayed
        return stayed

    def confirm(self, now_s: float) -> None:
        """A robot has stood nearby long enough; only the first time counts."""
        self.confirmed_s = now_s if self.confirmed_s is None else self.confirmed_s

    def serve(self, now_s: float) -> None:
        """A rescuer has stood with them long enough; only the first time counts."""
        self.served_s = now_s if self.served_s is None else self.served_s


@dataclass(frozen=True)
class Presence:
    """A robot as others see it: kind, place p_common [m], and speed [m/s]."""

    kind: Kind
    place: Place
    speed_m_s: float

    @property
    def stands(self) -> bool:
        """Whether it stands, or keeps to somebody who drifts."""
        return self.speed_m_s <= _STANDS_M_S

    def rescues(self, person: PersonState, away_m: float, within_m: float) -> bool:
        """Whether it may serve a person, and is near enough."""
        is_rescuer = self.kind.serves and self.kind.domain == person.domain
        return is_rescuer and away_m <= within_m


class Truth:
    """People and cells of one mission."""

    def __init__(self, scene: Scene, config: MissionConfig, seed: int) -> None:
        """At time 0.

        Args:
            scene: that is searched.
            config: of the mission.
            seed: of detections and drift.
        """
        self.scene, self.config, self._seed = scene, config, seed
        self.now_s = 0.0
        self.coverage = Coverage(scene.area.lattice)
        self.people = [
            PersonState(one.name, "water" if one.where == "water" else "ground")
            for one in scene.people
        ]
        self.places: Array = np.array([one.place for one in scene.people]).reshape(-1, 2)
        self._floats = np.array([one.domain == "water" for one in self.people], dtype=bool)
        self._flow = Flow(scene.area, config.sea)
        random = np.random.default_rng([seed, 0xD21F7])
        self._leeways = random_leeways(config.sea, len(self.people), random)

    def drift(self, seconds: float) -> None:
        """Those in the water drift until they are served."""
        moving = self._floats & np.array([one.served_s is None for one in self.people], dtype=bool)
        if moving.any():
            self.places[moving] = self._flow.moved(
                self.places[moving], self._leeways[moving], seconds
            )

    def look(
        self, robot: str, eye: Eye, view: View, now_s: float, seconds: float
    ) -> list[tuple[str, Place]]:
        """A robot looks for a time.

        Returns:
            Whom it detects, and where, p_common [m].
        """
        self.coverage.see(eye, view, seconds)
        seen = view.mask(self.scene.area.lattice.shape)
        row, column = self.scene.area.lattice.cell(self.places[:, 0], self.places[:, 1])
        detected = []
        for index in np.flatnonzero(seen[row, column]):
            person = self.people[index]
            missed = math.exp(-float(eye.detect_rate[row[index], column[index]]) * seconds)
            tick = round(now_s / seconds)
            if chance(self._seed, robot, person.name, tick) >= missed:
                person.found_s = now_s if person.found_s is None else person.found_s
                x, y = self.places[index]
                detected.append((person.name, (float(x), float(y))))
        return detected

    def tend(
        self, robots: Mapping[str, Presence], views: Mapping[str, View], seconds: float
    ) -> None:
        """Robots that stand with people confirm and serve them.

        Args:
            robots: that are alive.
            views: what each sees.
            seconds: of this step [s].
        """
        rules = self.config.rules
        for name, robot in robots.items():
            if not len(self.places):
                return
            away = np.hypot(self.places[:, 0] - robot.place[0], self.places[:, 1] - robot.place[1])
            for index in np.flatnonzero(away <= 2.0 * rules.confirm_m):
                sees = self._is_in_view(index, views[name])
                self._tend_one(self.people[index], name, robot, sees, away[index], seconds)

    def _tend_one(
        self,
        person: PersonState,
        name: str,
        robot: Presence,
        sees: bool,
        away_m: float,
        seconds: float,
    ) -> None:
        rules = self.config.rules
        stands_by = robot.stands and person.found_s is not None
        confirms = sees and away_m <= rules.confirm_m
        if person.stay(name, "confirm", stands_by and confirms, seconds) >= rules.confirm_s:
            person.confirm(self.now_s)
        serves = robot.rescues(person, away_m, rules.serve_m)
        if person.stay(name, "serve", stands_by and serves, seconds) >= rules.serve_s:
            person.serve(self.now_s)

    def _is_in_view(self, index: int, view: View) -> bool:
        row, column = self.scene.area.lattice.cell(*self.places[index])
        return bool(((view.row == row) & (view.column == column)).any())

    def sectors_covered(self) -> int:
        """How many sectors are covered well enough to count."""
        across, along = self.config.rules.sectors[1], self.config.rules.sectors[0]
        covered = self.coverage.covered()
        return sum(
            float(part.mean()) >= self.config.rules.sector_share
            for band in np.array_split(covered, across, axis=0)
            for part in np.array_split(band, along, axis=1)
        )

    def value(self) -> float:
        """What has been achieved: sectors, confirmations and services."""
        confirmed = sum(one.confirmed_s is not None for one in self.people)
        served = sum(one.served_s is not None for one in self.people)
        return (
            _VALUE_SECTOR * self.sectors_covered()
            + _VALUE_CONFIRMED * confirmed
            + _VALUE_SERVED * served
        )

    def is_complete(self) -> bool:
        """Whether all are served and enough is covered."""
        served = all(one.served_s is not None for one in self.people)
        return served and self.coverage.share() >= self.config.rules.enough
