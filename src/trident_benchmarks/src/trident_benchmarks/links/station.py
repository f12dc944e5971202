# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""How near a base station of the air comes to the best place of its fence."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from trident_fleet.core.base_station import BaseStation, Phase
from trident_fleet.core.quintic import Array, Motion
from trident_fleet.core.station.config import PilotConfig, SearchConfig, StationConfig
from trident_fleet.core.station.visits import Heard, Place

import trident_sim
from trident_benchmarks.links.station_scene import (
    FENCE,
    HOME,
    LINKS,
    MARGIN_M,
    UAV,
    StationScene,
    best_of_grid,
    grid_of,
    snr_of,
    station_scene,
    world_with_uav,
)

SHORT_LIMIT_DB = 1.0
_PERIOD_S, _POINTS = 0.1, 10
_EACH = 2  # periods from a decision to the next: links have a status of 5 Hz
_JUDGED_S = 10.0
_CONFIG = StationConfig(pilot=PilotConfig(v_max=8.0, a_max=3.0, margin_m=MARGIN_M))


@dataclass(frozen=True)
class Held:
    """What a flight ended with.

    Attributes:
        worst_db: worst link, mean over the last 10 s of the hover [dB].
        position: of the hover, p_world [m].
        time_s: when the place was reached [s].
        clearance_m: least distance of the vehicle to the fence's faces since it was in it [m].
    """

    worst_db: float
    position: list[float]
    time_s: float
    clearance_m: float


def fly(scene: StationScene, config: StationConfig = _CONFIG) -> Held:
    """One flight: search until a place is held, then hover there."""
    world = world_with_uav(scene)
    station = BaseStation(FENCE, config, np.array(HOME), list(LINKS))
    times = np.arange(_POINTS) * (_PERIOD_S / _POINTS)
    others = dict(zip(LINKS, map(np.array, scene.places), strict=True))
    judge = _Judge()
    for period in range(round((config.search.survey_s + config.search.refine_s + 120.0) / 0.1)):
        now_s = period * _PERIOD_S
        if period % _EACH == 0:
            position, snr = np.array(world.models[UAV].position), snr_of(world)
            places = {name: Place(place, now_s) for name, place in others.items()}
            station.decide(Heard(now_s, position, snr, places, None))
            judge.look(station, position, min(snr.values()), now_s)
            if judge.has_seen_enough(now_s):
                break
        _command(world, station.period(times, _PERIOD_S), now_s)
        world.step_until(now_s + _PERIOD_S)
    return judge.held(position, world.time)


class _Judge:
    """Follows a flight, decision by decision."""

    def __init__(self) -> None:
        self._clearance_m = np.inf
        self._worst_db: list[float] = []
        self._reached_s: float | None = None

    def look(self, station: BaseStation, position: Array, worst_db: float, now_s: float) -> None:
        """Take in where the UAV is after a decision, and the worst of its links there."""
        if station.phase not in (Phase.GROUND, Phase.TAKE_OFF):
            self._clearance_m = min(self._clearance_m, float(FENCE.clearance(position[None])[0]))
        is_there = float(np.linalg.norm(position - station.goal)) < 0.3
        if station.phase is Phase.HOLD and (is_there or self._reached_s is not None):
            self._reached_s = now_s if self._reached_s is None else self._reached_s
            self._worst_db.append(worst_db)

    def has_seen_enough(self, now_s: float) -> bool:
        """Whether the hover has lasted for as long as it is judged."""
        return self._reached_s is not None and now_s - self._reached_s >= _JUDGED_S + 2.0

    def held(self, position: Array, end_s: float) -> Held:
        """What the flight ended with; `end_s` counts if no place was reached."""
        judged = self._worst_db[-round(_JUDGED_S / (_EACH * _PERIOD_S)) :]
        held_db = float(np.mean(judged)) if judged else -np.inf
        reached_s = end_s if self._reached_s is None else self._reached_s
        return Held(held_db, position.tolist(), reached_s, self._clearance_m)


def _command(world: trident_sim.World, motion: Motion, now_s: float) -> None:
    sample = trident_sim.TrajectorySample(
        np.ascontiguousarray(motion.position[:, 0]),
        np.arange(_POINTS) * (_PERIOD_S / _POINTS),
        np.ascontiguousarray(motion.velocity[:, 0]),
        np.ascontiguousarray(motion.acceleration[:, 0]),
        stamp=now_s,
    )
    world.ports[f"{UAV}/command/trajectory"].write(sample)


def station_row(seed: int, search: SearchConfig | None = None) -> dict[str, Any]:
    """A scene: what was held next to the best place of the grid."""
    scene, grid = station_scene(seed), grid_of(FENCE)
    begin = time.process_time()
    config = _CONFIG if search is None else StationConfig(pilot=_CONFIG.pilot, search=search)
    held = fly(scene, config)
    cpu_s = time.process_time() - begin
    best_db, best, direct_db = best_of_grid(scene, grid)
    short_db = best_db - held.worst_db
    return {
        "suite": "station",
        "seed": seed,
        "places": len(grid),
        "direct_db": direct_db,
        "best_db": best_db,
        "best_place": best.tolist(),
        "held_db": held.worst_db,
        "held_place": held.position,
        "short_db": short_db,
        "found_s": held.time_s,
        "cpu_s": cpu_s,
        "clearance_m": held.clearance_m,
        "limit": SHORT_LIMIT_DB,
        "passed": bool(short_db <= SHORT_LIMIT_DB and held.clearance_m > 0.0),
    }


def station_line(row: dict[str, Any]) -> str:
    """A row as one line."""
    verdict = "" if row["passed"] else " (limit missed)"
    return (
        f"coast {row['seed']}: held {row['held_db']:.2f} dB after {row['found_s']:.0f} s, best of"
        f" {row['places']} places {row['best_db']:.2f}, short by {row['short_db']:+.2f} dB;"
        f" directly {row['direct_db']:.1f} dB; {row['cpu_s']:.1f} CPU s{verdict}"
    )
