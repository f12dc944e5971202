# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What one robot knows of a search: what was seen, where people may be, who was found."""

from __future__ import annotations

import numpy as np

from trident_fleet.core.missions.kinds import MissionConfig
from trident_fleet.core.missions.reports import Fix, Report
from trident_fleet.core.missions.scene import Place
from trident_fleet.core.search.area import Array, SearchArea
from trident_fleet.core.search.belief import Belief
from trident_fleet.core.search.coverage import Coverage
from trident_fleet.core.search.detection import Eye, View
from trident_fleet.core.search.drift import Flow
from trident_fleet.core.search.sightings import Look, Sightings

LOOK_S = 0.5
"""Time between two looks of a robot [s]."""

_BELIEF_S = 10.0  # between two updates of the belief
_PARTICLES = 1 << 13


class SharedEyes:
    """The eyes of all kinds in an area, and what they saw last: the same for all robots."""

    def __init__(self, area: SearchArea, config: MissionConfig) -> None:
        """Of the kinds of a mission."""
        self.area = area
        self.eyes = {
            name: Eye(area, kind.sensor, config.wave_height_m)
            for name, kind in config.kinds.items()
        }
        self._views: dict[tuple[str, Look], View] = {}

    def view(self, kind: str, look: Look) -> View:
        """What a kind of robot saw in a look."""
        key = (kind, look)
        if key not in self._views:
            if len(self._views) > 20_000:
                self._views.clear()
            self._views[key] = self.eyes[kind].view(look.x, look.y)
        return self._views[key]


class Knowledge:
    """Joins a robot's own looks and detections with what others report."""

    def __init__(
        self, eyes: SharedEyes, config: MissionConfig, kinds: dict[str, str], robot: str
    ) -> None:
        """Of a robot at time 0.

        Args:
            eyes: of the area.
            config: of the mission.
            kinds: of all robots of the team by name.
            robot: whose knowledge it is.
        """
        area = eyes.area
        self.eyes, self._kinds, self._robot = eyes, kinds, robot
        self._prior = config.prior
        self.coverage, self.sightings = Coverage(area.lattice), Sightings(area.lattice)
        self.belief = Belief(area, config.prior.grid(area), config.sea, _PARTICLES)
        self.people: dict[str, Fix] = {}
        self.heard_s: dict[str, float] = {}
        self.reports: dict[str, Report] = {}
        self._missed: Array = np.zeros(area.lattice.shape)
        self._flow, self._mean_leeway = Flow(area, config.sea), _mean_leeway(config)

    def look(self, look: Look) -> tuple[Look, View]:
        """The robot looks; returns the look as all know it, and what is in view."""
        kept = self.sightings.add(self._robot, look)
        return kept, self._use(self._robot, kept)

    def _take(self, robot: str, look: Look) -> None:
        self._use(robot, look)

    def _use(self, robot: str, look: Look) -> View:
        kind = self._kinds[robot]
        view, eye = self.eyes.view(kind, look), self.eyes.eyes[kind]
        self.coverage.see(eye, view, LOOK_S)
        rate = eye.detect_rate[view.row, view.column]
        self._missed[view.row, view.column] += rate * LOOK_S
        return view

    def update(self, now_s: float) -> None:
        """Let the belief follow what was seen, from time to time."""
        if now_s - self.belief.now_s < _BELIEF_S:
            return
        self.belief.drift(now_s)
        self.belief.multiply(np.exp(-self._missed))
        self._missed[:] = 0.0

    def detected(self, fix: Fix) -> None:
        """Somebody has been found, or seen again."""
        known = self.people.get(fix.name)
        self.people[fix.name] = fix if known is None else known.joined(fix)

    def hear(self, report: Report) -> None:
        """Take in what another robot reports."""
        last = self.reports.get(report.robot)
        if last is None or report.stamp_s > last.stamp_s:
            self.reports[report.robot] = report
        for part in report.parts:
            if part.robot != self._robot:
                self.sightings.merge(part, self._take)
        for fix in report.people:
            self.detected(fix)

    def report(self, now_s: float, place: Place, task: str, battery: float) -> Report:
        """What this robot reports: looks that some of those who were heard lately do not know."""
        lately = [one for one in self.reports.values() if now_s - one.stamp_s < 5.0]
        known: dict[str, int] = {}
        counts = self.sightings.counts()
        for robot in counts:
            heard = [dict(one.counts).get(robot, 0) for one in lately if one.robot != robot]
            known[robot] = min(heard, default=counts[robot])
        parts = tuple(self.sightings.difference(known))
        people = tuple(self.people.values())
        return Report(
            now_s, self._robot, place, task, battery, tuple(counts.items()), parts, people
        )

    def place_of(self, fix: Fix, now_s: float) -> Place:
        """Where a person should be by now."""
        if fix.domain != "water" or fix.served:
            return fix.place
        place = np.array([fix.place])
        moved = self._flow.moved(place, self._mean_leeway[None], now_s - fix.time_s)
        return float(moved[0, 0]), float(moved[0, 1])

    def unfound(self) -> dict[str, float]:
        """How many people are still expected in the `open`, below a `cover`, and in the `water`."""
        area, prior = self.eyes.area, self._prior
        left = {"open": prior.open_land, "cover": prior.covered, "water": prior.water}
        for fix in self.people.values():
            covered = bool(area.covered[area.lattice.cell(*fix.place)])
            where = "cover" if covered else "open"
            left["water" if fix.domain == "water" else where] -= 1.0
        return {where: max(count, 0.0) for where, count in left.items()}

    def expected(self) -> Array:
        """How many people who have not been found are in each cell, shape (rows, columns)."""
        area, grid = self.eyes.area, self.belief.grid()
        expected = np.zeros_like(grid)
        cells = {"open": area.land & ~area.covered, "cover": area.covered, "water": ~area.land}
        for where, count in self.unfound().items():
            total = float(grid[cells[where]].sum())
            if total > 0.0:
                expected[cells[where]] += count / total * grid[cells[where]]
        return expected


def _mean_leeway(config: MissionConfig) -> Array:
    leeways = config.sea.leeways(np.zeros((2, 2)), np.array([True, False]))
    return np.asarray(leeways.mean(axis=0))
