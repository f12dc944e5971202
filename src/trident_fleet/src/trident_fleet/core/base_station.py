# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A UAV as a base station of the air: flies where the worst of some radio links is best.

It knows the SNR of its own links and where the other robots say they are, nothing of the world. It
surveys its fence, flying to where the worst link is expected to gain most, refines about the best
places it has been at, and holds the best of all. It follows robots that move by what it believes of
the links. Its set-points stay in the fence whatever it decides (`station.pilot`).
"""

from __future__ import annotations

import enum

import numpy as np

from trident_fleet.core.quintic import Array, Motion
from trident_fleet.core.station.config import StationConfig
from trident_fleet.core.station.fence import Fence
from trident_fleet.core.station.flyer import Flyer
from trident_fleet.core.station.pilot import Other
from trident_fleet.core.station.placement import places_about, survey_places
from trident_fleet.core.station.search import Search
from trident_fleet.core.station.visits import Heard, Place, Visit, Visits

_TRAIL_M, _LOOP_M = 2.0, 4.0
_TOPS, _TOPS_APART_M = 4, 4.0
_ROUNDS = 2  # of a refinement, which share its time: the second is about the best after the first
_FOLLOW_PLACES, _FOLLOW_REMEMBERED, _FOLLOW_EVERY_S = 600, 80, 1.0
_FOLLOW_LOSS_DB_M = 0.03  # A place that is not better by that for each meter is not flown to.
_CHECKED_S = 5.0


class Phase(enum.Enum):
    """What it is doing."""

    GROUND = "on the ground"
    TAKE_OFF = "take-off"
    SURVEY = "survey"
    REFINE = "refine"
    HOLD = "hold"
    FOLLOW = "follow"
    BACK = "back along its path"
    RETURN = "return"
    LAND = "land"
    LANDED = "landed"


#: A place counts as reached this near [m].
_REACHED_M = {Phase.SURVEY: 2.0, Phase.REFINE: 0.3}


class BaseStation:
    """Decisions and set-points; a pure function of what was heard.

    Attributes:
        phase: what it is doing.
        reason: why it does that, in words.
        visits: what it has heard so far.
        goal: where it flies to, or holds [m, world], shape (3,).
        found_db: worst link at the best place of the last search [dB]; None: not known yet.
    """

    def __init__(self, fence: Fence, config: StationConfig, home: Array, links: list[str]) -> None:
        """Stand on the ground.

        Args:
            fence: that it stays in, but for the column above its home.
            config: its numbers.
            home: where it stands [m, world], shape (3,).
            links: names of the robots to connect, one or more.

        Raises:
            FormationError: an illegal number, a home that is not below the fence, or a fence that
                is too narrow for the margin.
        """
        fence.validate()
        config.validate()
        self._fence, self._config, self._links = fence, config, links
        self._flyer = Flyer(fence, config.pilot, home, config.ground_s)
        self.phase, self.reason = Phase.GROUND, "start"
        self.visits = Visits(links, config.links.unheard_db)
        self.goal = self._flyer.entry
        self.found_db: float | None = None
        self._search: Search | None = None
        self._stage_s = 0.0  # when the phase began
        self._round = 0  # of a refinement
        self._trail: list[Array] = [self._flyer.entry]
        self._others: list[Other] = []
        self._random = np.random.default_rng(0xBA5E)

    @property
    def position(self) -> Array:
        """Of the set-point in the fence [m, world]."""
        return self._flyer.position

    @property
    def is_over(self) -> bool:
        """Whether it has landed for good."""
        return self._flyer.has_landed

    def period(self, time: Array, dt: float) -> Motion:
        """The set-points of the next period; periods follow each other.

        Args:
            time: of the points since the begin of the period [s], shape (M,).
            dt: length of the period [s].
        """
        motion = self._flyer.period(time, dt, self._others)
        if self._flyer.has_landed:
            self.phase = Phase.LANDED
        elif self.phase is Phase.GROUND and not self._flyer.is_waiting:
            self.phase = Phase.TAKE_OFF
        self._others = [Other(other.position, other.age_s + dt) for other in self._others]
        return motion

    def decide(self, heard: Heard) -> None:
        """Take what is known now, and decide where to go."""
        self._others = _others_of(heard)
        self.visits.add(heard)
        if not self._flyer.is_flying:
            return
        if self._must_return(heard):
            if self._flyer.land_if_home():
                self.phase = Phase.LAND
        elif self.phase is Phase.BACK:
            self._go_back(heard)
        elif self.visits.silent_s(heard.time_s) >= self._config.lost_link_s:
            self._begin(Phase.BACK, f"no link for {self._config.lost_link_s:g} s", heard.time_s)
            self._go_back(heard)
        else:
            self._extend_trail()
            self._look(heard)

    def _begin(self, phase: Phase, reason: str, time_s: float) -> None:
        self.phase, self.reason, self._stage_s = phase, reason, time_s

    def _fly_to(self, place: Array) -> None:
        self.goal = place
        self._flyer.fly_to(place)

    # Home

    def _must_return(self, heard: Heard) -> bool:
        if self.phase is Phase.RETURN:
            return True
        if heard.battery is None or heard.battery > self._config.return_battery:
            return False
        self._return(f"battery at {100.0 * heard.battery:.0f} %", heard.time_s)
        return True

    def _return(self, reason: str, time_s: float) -> None:
        self._begin(Phase.RETURN, reason, time_s)
        self._fly_to(self._flyer.entry)

    def _extend_trail(self) -> None:
        """The path here, without its loops."""
        if self._flyer.away_m(self._trail[-1]) <= _TRAIL_M:
            return
        away = [self._flyer.away_m(place) for place in self._trail]
        first = next((i for i, away_m in enumerate(away) if away_m < _LOOP_M), len(away))
        self._trail = [*self._trail[: first + 1], self._flyer.position]

    def _go_back(self, heard: Heard) -> None:
        """Along the trail, until a link is heard, or to its begin."""
        if self.visits.silent_s(heard.time_s) == 0.0:
            self._search = None
            self._look(heard)
            return
        while len(self._trail) > 1 and self._flyer.away_m(self._trail[-1]) < _TRAIL_M:
            self._trail.pop()
        self._fly_to(self._trail[-1])
        if len(self._trail) == 1 and self._flyer.away_m(self._flyer.entry) < _TRAIL_M:
            self._return("no link all along its path", heard.time_s)

    # Links

    def _look(self, heard: Heard) -> None:
        """Search, hold or follow."""
        known = heard.known(self._links)
        if not known:
            self._begin(Phase.SURVEY, "no robot has said where it is", heard.time_s)
            self._fly_to(self._middle())
        elif self._is_moving(heard):
            self._follow(heard, known)
        elif self._search is None or self.phase is Phase.FOLLOW:
            self._survey(heard, known, "the robots stand")
        elif self.phase is Phase.HOLD:
            self._watch(heard, known)
        else:
            self._continue(heard, known)

    def _is_moving(self, heard: Heard) -> bool:
        search = self._config.search
        moved_m = self.visits.moved_m(heard, heard.time_s - search.still_s)
        return moved_m > 0.5 * search.moved_m

    def _middle(self) -> Array:
        """Of the fence if it may be there, else above its home, as high as may be."""
        top = self._fence.highest_m - self._config.pilot.margin_m
        middle = np.array([*self._fence.corners.mean(axis=0), top])
        return middle if self._flyer.may_be_at(middle) else np.array([*self._flyer.entry[:2], top])

    def _survey_places(self, known: dict[str, Place], count: int) -> Array:
        others = [place.position for place in known.values()]
        margin = self._config.pilot.margin_m
        return survey_places(self._fence, margin, others, count, self._random)

    def _follow(self, heard: Heard, known: dict[str, Place]) -> None:
        if self.phase is Phase.FOLLOW and heard.time_s - self._stage_s < _FOLLOW_EVERY_S:
            return
        self._begin(Phase.FOLLOW, "a robot moves", heard.time_s)
        places = self._survey_places(known, _FOLLOW_PLACES)
        self._search = Search(places, known, self.visits, self._config, _FOLLOW_REMEMBERED)
        self._fly_to(self._search.best_expected(heard.position, _FOLLOW_LOSS_DB_M))

    def _survey(self, heard: Heard, known: dict[str, Place], reason: str) -> None:
        self._begin(Phase.SURVEY, reason, heard.time_s)
        places = self._survey_places(known, self._config.search.places)
        self._search = Search(places, known, self.visits, self._config)
        self._next_place(heard, known)

    def _refine(self, heard: Heard, known: dict[str, Place], number: int) -> None:
        self._round = number
        centers = [self._legal(visit) for visit in self._best(known, _TOPS)]
        self._begin(Phase.REFINE, f"about {len(centers)} places", heard.time_s)
        if not centers:
            self._hold(heard, known)
            return
        margin = self._config.pilot.margin_m
        places = places_about(centers, self._fence, margin, self._random)
        self._search = Search(places, known, self.visits, self._config)
        self._next_place(heard, known)

    def _continue(self, heard: Heard, known: dict[str, Place]) -> None:
        """The next step of a survey or a refinement."""
        is_survey = self.phase is Phase.SURVEY
        if not self._has_searched(heard, known):
            return
        if is_survey:
            self._refine(heard, known, 1)
        elif self._round < _ROUNDS:
            self._refine(heard, known, self._round + 1)
        else:
            self._hold(heard, known)

    def _has_searched(self, heard: Heard, known: dict[str, Place]) -> bool:
        """Continue the search; whether its time is up, or it has no more to gain."""
        assert self._search is not None
        self._search.add(self.visits)
        search = self._config.search
        limit_s = search.survey_s if self.phase is Phase.SURVEY else search.refine_s / _ROUNDS
        if heard.time_s - self._stage_s >= limit_s:
            return True
        is_there = self._flyer.away_m(self.goal) < _REACHED_M[self.phase]
        if is_there or self._search.has_gone_wrong:
            return self._next_place(heard, known) < search.gain_db
        return False

    def _next_place(self, heard: Heard, known: dict[str, Place]) -> float:
        """Continue the search; the gain that is expected of it [dB]."""
        assert self._search is not None
        best = self._best(known, 1)
        best_db = best[0].worst_db if best else self._config.links.unheard_db
        place, gain_db = self._search.choose(heard.position, best_db)
        self._fly_to(place)
        return gain_db

    def _best(self, known: dict[str, Place], count: int) -> list[Visit]:
        near_m = 0.5 * self._config.search.moved_m
        return self.visits.best(known, near_m, count, _TOPS_APART_M)

    def _legal(self, visit: Visit) -> Array:
        """Its place, or the nearest in the fence: a vehicle is not quite at its set-points."""
        place = self._fence.nearest_inside(visit.position, self._config.pilot.margin_m)
        return self._flyer.position if place is None else place

    def _hold(self, heard: Heard, known: dict[str, Place]) -> None:
        best = self._best(known, 1)
        self._begin(Phase.HOLD, "the best place that was found", heard.time_s)
        self.found_db = best[0].worst_db if best else None
        self._fly_to(self._legal(best[0]) if best else self._flyer.position)

    def _watch(self, heard: Heard, known: dict[str, Place]) -> None:
        """Whether the place is still as good as it was."""
        assert self._search is not None
        if self._flyer.away_m(self.goal) > _REACHED_M[Phase.REFINE]:
            self._stage_s = heard.time_s  # It is not there yet.
        if not self._search.is_about(known):
            self._survey(heard, known, "a robot has moved")
        elif self.found_db is not None and heard.time_s - self._stage_s > _CHECKED_S + 1.0:
            mean_db = self.visits.mean_db(heard.time_s - _CHECKED_S)
            if mean_db is not None and mean_db < self.found_db - self._config.search.drop_db:
                # What was measured before is no longer so.
                self.visits.forget_before(heard.time_s - _CHECKED_S)
                self._survey(heard, known, f"{mean_db:.1f} dB instead of {self.found_db:.1f} dB")


def _others_of(heard: Heard) -> list[Other]:
    """The other robots as the pilot knows them: where, and for how long that has been known."""
    return [
        Other(place.position, max(heard.time_s - place.time_s, 0.0))
        for place in heard.others.values()
    ]
