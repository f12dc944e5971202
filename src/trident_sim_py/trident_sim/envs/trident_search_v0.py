# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`trident_search_v0`: a UAV, a ground robot and a boat search a coast for people.

The model is that of `trident_fleet.core.missions` and `core.search`: kinematic vehicles, people who
drift, detection by footprint and occlusion. What robots decide there by trees and auctions is what
is learned here.
"""

from __future__ import annotations

import functools
import hashlib
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box
from pettingzoo import AECEnv
from trident_fleet.core.missions.kinds import Kind, MissionConfig
from trident_fleet.core.missions.setup import MODES
from trident_fleet.core.missions.truth import PersonState, Presence, Truth
from trident_fleet.core.missions.vehicle import KinematicVehicle
from trident_fleet.core.search.area import Mask, SearchArea
from trident_fleet.core.search.detection import Eye, View

from trident_sim._core import Error
from trident_sim.envs.coasts import coast_scene, mission_config, with_people
from trident_sim.envs.options import one_of
from trident_sim.envs.team import Floats, TeamEnv, as_aec

STEP_S = 0.5
_SECTORS = (5, 8)  # along y and x, of which coverage is observed
_PATCH, _PATCH_CELLS = 4, 3  # samples to each side of a robot, and cells between them
_BORDER = _PATCH * _PATCH_CELLS
_NEAR_M = 100.0  # to which the place of a person is observed
_VIEWS = 4096  # of each kind that are kept: up to 45 MB of a boat's
_DOMAINS = ("air", "ground", "water")
_COVERAGE, _FOUND, _CONFIRMED, _SERVED = 100.0, 1.0, 2.0, 4.0  # worth, as in missions


class Sight:
    """What a kind of robot sees of a coast, from the middle of the cell that it is in.

    Attributes:
        eye: of the kind.
    """

    def __init__(self, area: SearchArea, kind: Kind, config: MissionConfig) -> None:
        """Of an area that does not change; the views of the last cells are kept."""
        self.eye, self._lattice = Eye(area, kind.sensor, config.wave_height_m), area.lattice
        self._view = functools.lru_cache(maxsize=_VIEWS)(self._look)

    def view(self, place: tuple[float, float]) -> View:
        """From a place of the area, p_common [m]."""
        lattice = self._lattice
        row = int((place[1] - lattice.origin[1]) / lattice.cell_m)
        return self._view(row, int((place[0] - lattice.origin[0]) / lattice.cell_m))

    def _look(self, row: int, column: int) -> View:
        x, y = self._lattice.middle(row, column)
        return self.eye.view(float(x), float(y))


class SearchEnv(TeamEnv):
    """Each robot chooses its velocity, as parts of its top speed along x and y.

    It does not leave what it gets to, and sees from the middle of its cell. The team is rewarded:
    100 for all of the area that is covered, 1, 2 and 4 for each person who is found, confirmed and
    served. Each gets the team's reward. An episode ends when all is done.

    An observation: the place; which medium; the time that is left; where the others are; where the
    nearest person is who was found, and has not been served (there is one: 1); shares of the
    sectors that are covered; 9 x 9 samples around the robot of what is covered, or cannot be
    reached. All in [-1, 1].

    Attributes:
        truth: people and coverage of the episode.
    """

    def __init__(
        self,
        *,
        mode: str = "joint",
        coasts: Sequence[int] = (1,),
        people: int = 12,
        limit: int = 1800,
    ) -> None:
        """Make the coasts.

        Args:
            mode: of the team, e.g. `joint` or `three_uavs`.
            coasts: seeds of coasts, of which each episode takes one.
            people: how many, 1 to 200.
            limit: steps of half a second in an episode.

        Raises:
            trident_sim.Error: an option has an illegal value.
        """
        kinds = MODES[one_of(mode, tuple(MODES), "mode")]
        names = [f"{kind}_{kinds[:index].count(kind)}" for index, kind in enumerate(kinds)]
        if not 1 <= people <= 200 or not coasts:
            raise Error(f"people is {people}, coasts {coasts}; legal: 1 to 200, and some coasts")
        self._config, self._people = mission_config(), people
        self._scenes = [coast_scene(seed) for seed in coasts]
        self._kinds: list[Kind] = [self._config.kinds[kind] for kind in kinds]
        self._sights = [
            {kind.name: Sight(scene.area, kind, self._config) for kind in self._kinds}
            for scene in self._scenes
        ]
        self.metadata = {
            "name": "trident_search_v0",
            "render_modes": [],
            "is_parallelizable": True,
        }
        side = 2 * _PATCH + 1
        size = 9 + 2 * (len(names) - 1) + math.prod(_SECTORS) + side * side
        super().__init__(
            names,
            Box(-1.0, 1.0, (size,), np.float32),
            Box(-1.0, 1.0, (2,), np.float32),
            limit,
        )
        self._rows = np.zeros((len(names), size), np.float32)
        for row, kind in zip(self._rows, self._kinds, strict=True):
            row[2:5] = [kind.domain == domain for domain in _DOMAINS]
        count = len(names)
        self._others = np.array([[j for j in range(count) if j != i] for i in range(count)], int)
        self._hash = b""

    def _begin(self, random: np.random.Generator) -> Floats:
        chosen = int(random.integers(len(self._scenes)))
        scene = with_people(self._scenes[chosen], self._people, random)
        self.truth = Truth(scene, self._config, int(random.integers(2**31)))
        self._sight = self._sights[chosen]
        self._reach: list[Mask] = [scene.area.reach(kind.domain) for kind in self._kinds]
        down, along = (
            np.repeat(np.eye(parts, dtype=np.float32), -(-side // parts), axis=1)[:, :side]
            for side, parts in zip(scene.area.lattice.shape, _SECTORS, strict=True)
        )
        self._bands = down, along.T.copy()
        self._cells_each = np.outer(down.sum(axis=1), along.sum(axis=1))
        self._size = scene.area.lattice.size, scene.area.lattice.origin
        self._reachable = [np.pad(reach, _BORDER) for reach in self._reach]
        self._uncovered = np.zeros_like(self._reachable[0])
        bases = [scene.bases[kind.domain] for kind in self._kinds]
        self._vehicles = [
            KinematicVehicle(base, kind.speed_m_s)
            for base, kind in zip(bases, self._kinds, strict=True)
        ]
        self._worth = self._value()
        self._hash = hashlib.sha256(np.array(self.truth.places).tobytes()).digest()
        return self._observe()

    def _act(self, actions: Floats) -> tuple[Floats, npt.NDArray[np.float64], bool]:
        truth = self.truth
        truth.now_s = (self._count + 1) * STEP_S
        views: dict[str, View] = {}
        for index, name in enumerate(self.agents):
            self._move(index, actions[index])
            sight = self._sight[self._kinds[index].name]
            views[name] = sight.view(self._vehicles[index].place)
            truth.look(name, sight.eye, views[name], truth.now_s, STEP_S)
        truth.drift(STEP_S)
        robots = {
            name: Presence(kind, vehicle.place, vehicle.speed_m_s)
            for name, kind, vehicle in zip(self.agents, self._kinds, self._vehicles, strict=True)
        }
        truth.tend(robots, views, STEP_S)
        worth, before = self._value(), self._worth
        self._worth = worth
        self._chain()
        ended = self._share >= self._config.rules.enough and all(
            one.served_s is not None for one in truth.people
        )
        return self._observe(), np.full(len(self.agents), worth - before), ended

    def _move(self, index: int, action: Floats) -> None:
        """As far as a robot gets in a step; what it cannot reach, it stands before."""
        vehicle, kind = self._vehicles[index], self._kinds[index]
        along, across = (float(value) for value in action)
        scale = kind.speed_m_s * STEP_S / max(1.0, math.hypot(along, across))
        x, y = vehicle.place[0] + scale * along, vehicle.place[1] + scale * across
        (width, height), (left, low) = self._size
        inside = 0.0 <= x - left < width and 0.0 <= y - low < height
        if inside and self._reach[index][self._cell((x, y))]:
            vehicle.follow([(x, y)])
        else:
            vehicle.halt()
        vehicle.step(STEP_S)

    def _value(self) -> float:
        """What has been achieved; `_covered`, `_sectors` and `_share` are as of now then."""
        self._covered = self.truth.coverage.covered()
        sums = self._bands[0] @ self._covered.astype(np.float32) @ self._bands[1]
        self._share = float(sums.sum()) / self._covered.size
        self._sectors = (sums / self._cells_each).ravel()
        np.logical_not(self._covered, out=self._uncovered[_BORDER:-_BORDER, _BORDER:-_BORDER])
        return _COVERAGE * self._share + sum(map(_worth, self.truth.people))

    def _observe(self) -> Floats:
        lattice = self.truth.scene.area.lattice
        places = np.array([vehicle.place for vehicle in self._vehicles])
        scaled = 2.0 * (places - lattice.origin) / lattice.size - 1.0
        left = 1.0 - self._count / self.limit
        rows, count = self._rows, len(places)
        rows[:, :2], rows[:, 5] = scaled, left
        end = 9 + 2 * (count - 1)
        offsets = scaled[self._others] - scaled[:, None]
        rows[:, 9:end] = 0.5 * offsets.reshape(count, -1)
        rows[:, end : end + self._sectors.size] = self._sectors
        for index, place in enumerate(places):
            rows[index, 6:9] = self._person(self._kinds[index], place)
            closed = self._closed(index, self._vehicles[index].place)
            rows[index, end + self._sectors.size :] = closed
        return np.minimum(np.maximum(rows, -1.0), 1.0)

    def _closed(self, index: int, place: tuple[float, float]) -> npt.NDArray[np.bool_]:
        """Samples around a robot: what is covered, or cannot be reached."""
        row, column = self._cell(place)
        side = slice(None, 2 * _BORDER + 1, _PATCH_CELLS)
        rows, columns = slice(row, row + 2 * _BORDER + 1), slice(column, column + 2 * _BORDER + 1)
        uncovered = self._uncovered[rows, columns][side, side]
        open_ = uncovered & self._reachable[index][rows, columns][side, side]
        return ~open_.ravel()

    def _cell(self, place: tuple[float, float]) -> tuple[int, int]:
        lattice = self.truth.scene.area.lattice
        column = int((place[0] - lattice.origin[0]) / lattice.cell_m)
        row = int((place[1] - lattice.origin[1]) / lattice.cell_m)
        return min(row, lattice.rows - 1), min(column, lattice.columns - 1)

    def _person(self, kind: Kind, place: npt.NDArray[np.float64]) -> list[float]:
        """Offset of the nearest person who was found and waits for such a robot; is there one."""
        waits = [index for index, one in enumerate(self.truth.people) if _waits(one, kind)]
        if not waits:
            return [0.0, 0.0, 0.0]
        offsets = self.truth.places[waits] - place
        nearest = offsets[np.hypot(offsets[:, 0], offsets[:, 1]).argmin()]
        return [*(nearest / _NEAR_M).tolist(), 1.0]

    def _chain(self) -> None:
        """A hash of all that happened: coverage is a function of where robots were."""
        numbers = [self.truth.now_s, self._share]
        for vehicle in self._vehicles:
            numbers += vehicle.place
        state = np.array(numbers).tobytes() + self.truth.places.tobytes()
        done = bytes(int(_worth(one)) for one in self.truth.people)
        self._hash = hashlib.sha256(self._hash + state + done).digest()

    def _state_hash(self) -> str:
        return self._hash.hex()


def _worth(one: PersonState) -> float:
    found, confirmed, served = (
        one.found_s is not None,
        one.confirmed_s is not None,
        one.served_s is not None,
    )
    return _FOUND * found + _CONFIRMED * confirmed + _SERVED * served


def _waits(one: PersonState, kind: Kind) -> bool:
    if one.found_s is None or one.served_s is not None:
        return False
    return one.confirmed_s is None or (kind.serves and kind.domain == one.domain)


def parallel_env(**options: Any) -> SearchEnv:
    """All act at once; see `SearchEnv` for the options."""
    return SearchEnv(**options)


def env(**options: Any) -> AECEnv:
    """One acts after the other; see `SearchEnv` for the options."""
    return as_aec(SearchEnv(**options))
