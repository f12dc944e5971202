# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`trident_search_v0`: a UAV, a ground robot and a boat search a coast for people.

The model is that of `trident_fleet.core.missions` and `core.search`: kinematic vehicles, people who
drift, detection by footprint and occlusion. What robots decide there by trees and auctions is what
is learned here.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box
from pettingzoo import AECEnv
from trident_fleet.core.missions.kinds import Kind
from trident_fleet.core.missions.setup import MODES
from trident_fleet.core.missions.truth import PersonState, Presence, Truth
from trident_fleet.core.missions.vehicle import KinematicVehicle
from trident_fleet.core.search.area import Mask
from trident_fleet.core.search.detection import Eye, View

from trident_sim._core import Error
from trident_sim.envs.coasts import coast_scene, mission_config, with_people
from trident_sim.envs.options import one_of
from trident_sim.envs.team import Floats, TeamEnv, as_aec

STEP_S = 0.5
_SECTORS = (5, 8)  # along y and x, of which coverage is observed
_PATCH, _PATCH_CELLS = 4, 3  # samples to each side of a robot, and cells between them
_NEAR_M = 100.0  # to which the place of a person is observed
_DOMAINS = ("air", "ground", "water")
_COVERAGE, _FOUND, _CONFIRMED, _SERVED = 100.0, 1.0, 2.0, 4.0  # worth, as in missions


class SearchEnv(TeamEnv):
    """Each robot chooses its velocity, as parts of its top speed along x and y.

    It does not leave what it gets to. The team is rewarded: 100 for all of the area that is
    covered, 1, 2 and 4 for each person who is found, confirmed and served. Each gets the team's
    reward. An episode ends when all is done.

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
        self._eyes = [
            {
                kind.name: Eye(scene.area, kind.sensor, self._config.wave_height_m)
                for kind in self._kinds
            }
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
        offsets = _PATCH_CELLS * np.arange(-_PATCH, _PATCH + 1)
        self._patch = offsets[:, None], offsets[None, :]
        self._hash = b""

    def _begin(self, random: np.random.Generator) -> Floats:
        chosen = int(random.integers(len(self._scenes)))
        scene = with_people(self._scenes[chosen], self._people, random)
        self.truth = Truth(scene, self._config, int(random.integers(2**31)))
        self._sight = self._eyes[chosen]
        self._reach: list[Mask] = [scene.area.reach(kind.domain) for kind in self._kinds]
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
            eye, (x, y) = self._sight[self._kinds[index].name], self._vehicles[index].place
            views[name] = eye.view(x, y)
            truth.look(name, eye, views[name], truth.now_s, STEP_S)
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
        lattice = self.truth.scene.area.lattice
        if lattice.has(x, y) and self._reach[index][lattice.cell(x, y)]:
            vehicle.follow([(x, y)])
        else:
            vehicle.halt()
        vehicle.step(STEP_S)

    def _value(self) -> float:
        """What has been achieved; `_covered`, `_sectors` and `_share` are as of now then."""
        self._covered = self.truth.coverage.covered()
        rows, columns = (
            np.linspace(0, side, parts, endpoint=False).astype(np.intp)
            for side, parts in zip(self._covered.shape, _SECTORS, strict=True)
        )
        sums = np.add.reduceat(self._covered, columns, axis=1, dtype=np.float32)
        sums = np.add.reduceat(sums, rows, axis=0)
        self._share = float(sums.sum()) / self._covered.size
        self._sectors = sums.ravel() * (sums.size / self._covered.size)
        return _COVERAGE * self._share + sum(map(_worth, self.truth.people))

    def _observe(self) -> Floats:
        lattice = self.truth.scene.area.lattice
        corner, size = np.array(lattice.origin), np.array(lattice.size)
        places = np.array([vehicle.place for vehicle in self._vehicles])
        scaled = 2.0 * (places - corner) / size - 1.0
        left = 1.0 - self._count / self.limit
        rows = [self._one(index, places[index], scaled, left) for index in range(len(places))]
        return np.array(rows, dtype=np.float32).clip(-1.0, 1.0)

    def _one(
        self,
        index: int,
        place: npt.NDArray[np.float64],
        scaled: npt.NDArray[np.float64],
        left: float,
    ) -> npt.NDArray[np.float64]:
        kind = self._kinds[index]
        others = np.delete(scaled, index, axis=0) - scaled[index]
        medium = [float(kind.domain == domain) for domain in _DOMAINS]
        row, column = self.truth.scene.area.lattice.cell(place[0], place[1])
        rows, columns = row + self._patch[0], column + self._patch[1]
        shape = self._covered.shape
        inside = (rows >= 0) & (rows < shape[0]) & (columns >= 0) & (columns < shape[1])
        rows, columns = rows.clip(0, shape[0] - 1), columns.clip(0, shape[1] - 1)
        open_ = inside & ~self._covered[rows, columns] & self._reach[index][rows, columns]
        return np.concatenate(
            [
                scaled[index],
                medium,
                [left],
                self._person(kind, place),
                others.ravel() / 2.0,
                self._sectors,
                1.0 - open_.ravel(),
            ]
        )

    def _person(self, kind: Kind, place: npt.NDArray[np.float64]) -> list[float]:
        """Offset of the nearest person who was found and waits for such a robot; is there one."""
        waits = [_waits(one, kind) for one in self.truth.people]
        if not any(waits):
            return [0.0, 0.0, 0.0]
        offsets = self.truth.places[waits] - place
        nearest = offsets[np.hypot(offsets[:, 0], offsets[:, 1]).argmin()]
        return [*(nearest / _NEAR_M).clip(-1.0, 1.0).tolist(), 1.0]

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
