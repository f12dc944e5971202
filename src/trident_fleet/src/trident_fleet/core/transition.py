# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""From one shape to another without coming too close: all at once, in waves, or not at all."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trident_fleet.core.assignment import assign, guaranteed_separation
from trident_fleet.core.errors import FormationError
from trident_fleet.core.quintic import Array
from trident_fleet.core.separation import min_separation, pair_separations, pairs

_SLACK_M = 1e-9
_ORDERS = 32  # that are tried for the waves, all but the first two at random
_SEED = 20140101

Waves = tuple[tuple[int, ...], ...]
"""Vehicles that move in step, wave after wave; the others stand meanwhile."""


@dataclass(frozen=True)
class Transition:
    """A change of places along straight lines.

    Attributes:
        start: p_world of the vehicles [m], shape (N, 3).
        goal: of the same vehicles [m], shape (N, 3).
        place: the place that each vehicle has got, shape (N,).
        waves: who moves when.
        separation_m: smallest distance of any two on their paths [m].
        guaranteed_m: what theory promises for a single wave [m].
    """

    start: Array
    goal: Array
    place: tuple[int, ...]
    waves: Waves
    separation_m: float
    guaranteed_m: float

    def points(self) -> Array:
        """Corners of the paths, shape (waves + 1, N, 3) [m, world]."""
        return _corners(self.start, self.goal, self.waves)


def plan_transition(start: Array, places: Array, required_m: float) -> Transition:
    """Assign places and find out who may move when.

    Args:
        start: p_world of the vehicles [m], shape (N, 3).
        places: p_world of the places to take [m], shape (N, 3).
        required_m: smallest distance of any two vehicles [m].

    Returns:
        One wave if the separation can be held so, else the fewest that were found.

    Raises:
        FormationError: start or goal are closer than that themselves, or no order of departures
            helps.
    """
    check_apart(start, required_m, "before: vehicles")
    check_apart(places, required_m, "after: places")
    place = assign(start, places)
    goal = places[place]
    waves = schedule_waves(start, goal, required_m)
    return Transition(
        start=start,
        goal=goal,
        place=tuple(int(number) for number in place),
        waves=waves,
        separation_m=min_separation(_corners(start, goal, waves)),
        guaranteed_m=guaranteed_separation(start, goal),
    )


def schedule_waves(start: Array, goal: Array, required_m: float) -> Waves:
    """Who moves when on given straight paths: all at once, or the fewest waves found.

    Args:
        start: p_world of the vehicles [m], shape (N, 3).
        goal: of the same vehicles [m], shape (N, 3); the same as `start` for one that stays.
        required_m: smallest distance of any two [m].

    Raises:
        FormationError: no order of departures helps.
    """
    if min_separation(np.stack([start, goal])) >= required_m - _SLACK_M:
        return (tuple(range(len(start))),)
    waves = _fewest_waves(start, goal, required_m)
    if waves is None:
        raise FormationError(_refusal(start, goal, required_m))
    return waves


def closest_pair(points: Array) -> tuple[int, int, float]:
    """The two vehicles, from 0, that come closest on a polyline (M, N, 3), and how close [m]."""
    distances = pair_separations(points)
    nearest = int(np.argmin(distances))
    i, j = pairs(points.shape[1])
    return int(i[nearest]), int(j[nearest]), float(distances[nearest])


def check_apart(points: Array, required_m: float, what: str) -> None:
    """Raise FormationError, which begins with `what`, if any two of (N, 3) points are too close."""
    if min_separation(points[None]) < required_m - _SLACK_M:
        i, j, distance = closest_pair(points[None])
        raise FormationError(
            f"{what} {i + 1} and {j + 1} are {distance:.3f} m apart; legal: min_separation_m"
            f" {required_m:g} or more"
        )


def _refusal(start: Array, goal: Array, required_m: float) -> str:
    i, j, distance = closest_pair(np.stack([start, goal]))
    return (
        f"vehicles {i + 1} and {j + 1} would come within {distance:.3f} m, and no order of"
        f" departures was found that keeps min_separation_m {required_m:g}; legal: less than that,"
        f" or a spacing of {math.sqrt(2.0) * required_m:.3f} m or more before and after"
    )


def _corners(start: Array, goal: Array, waves: Waves) -> Array:
    points = [start]
    for wave in waves:
        after = points[-1].copy()
        after[list(wave)] = goal[list(wave)]
        points.append(after)
    return np.stack(points)


def _fewest_waves(start: Array, goal: Array, required_m: float) -> Waves | None:
    count = len(start)
    rng = np.random.default_rng(_SEED)
    # Who has far to go first, then the opposite, then any order.
    far_first = [int(v) for v in np.argsort(-((goal - start) ** 2).sum(axis=1), kind="stable")]
    orders = [far_first, far_first[::-1]]
    orders += [[int(v) for v in rng.permutation(count)] for _ in range(_ORDERS - len(orders))]
    found = [waves for order in orders if (waves := _waves(start, goal, required_m, order))]
    return min(found, key=len, default=None)


def _waves(start: Array, goal: Array, required_m: float, order: list[int]) -> Waves:
    """Waves that take along whom they can, in the given order; none if somebody is left over."""
    place, left, waves = start.copy(), list(order), []
    while left:
        wave, place = _next_wave(place, goal, required_m, left)
        if not wave:
            return ()
        waves.append(tuple(sorted(wave)))
        left = [vehicle for vehicle in left if vehicle not in wave]
    return tuple(waves)


def _next_wave(
    place: Array, goal: Array, required_m: float, left: list[int]
) -> tuple[list[int], Array]:
    """All those of `left` that can go together, and where everybody is then."""
    target = place.copy()
    wave: list[int] = []
    grown = True
    while grown:
        grown = False
        for vehicle in [v for v in left if v not in wave]:
            target[vehicle] = goal[vehicle]
            if _separation_of(vehicle, place, target) >= required_m - _SLACK_M:
                wave.append(vehicle)
                grown = True
            else:
                target[vehicle] = place[vehicle]
    return wave, target


def _separation_of(vehicle: int, place: Array, target: Array) -> float:
    """Smallest distance of one vehicle to the others while all go from `place` to `target` [m]."""
    u = np.delete(place - place[vehicle], vehicle, axis=0)
    along = np.delete(target - target[vehicle], vehicle, axis=0) - u
    length2 = (along**2).sum(axis=-1)
    fraction = -(u * along).sum(axis=-1) / np.where(length2 > 0.0, length2, 1.0)
    nearest = u + np.clip(fraction, 0.0, 1.0)[:, None] * along
    return float(np.sqrt((nearest**2).sum(axis=-1)).min(initial=np.inf))
