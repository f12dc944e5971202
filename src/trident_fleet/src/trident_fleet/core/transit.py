# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Collision-free paths from any spawn positions to the first row of a formation."""

from __future__ import annotations

import itertools

import numpy as np

from trident_fleet.core.config import FlightLimits, PlanConfig
from trident_fleet.core.errors import FormationError
from trident_fleet.core.quintic import Array, QuinticPath, rest_to_rest
from trident_fleet.core.separation import min_separation, pair_separations, pairs

# Peaks of the minimum-jerk profile over unit distance and unit time.
_PEAK_SPEED = 1.875
_PEAK_ACCELERATION = 10.0 / np.sqrt(3.0)
_PEAK_JERK = 60.0
_SLACK_M = 1e-6
_SHORTEST_LEG_S = 1.0


def transit_points(spawn: Array, goal: Array, config: PlanConfig) -> Array:
    """Points of the paths that all vehicles fly in step, from rest to rest.

    First all climb together; then they go straight, if every pair stays far enough apart; else the
    pairs that would collide fly on different layers: climb to the layer, cross, and change height
        over
    the goal. Layers are ordered by the height of the goals, so nobody passes through anybody.

    Args:
        spawn: positions on the ground [m, world], shape (N, 3).
        goal: positions of the first row [m, world], shape (N, 3).
        config: climb height and wanted separation.

    Returns:
        Points [m, world], shape (M, N, 3), from `spawn` to `goal`.

    Raises:
        FormationError: two vehicles spawn or end at the same place.
    """
    required = _required_separation(spawn, goal, config)
    climbed = spawn + np.array([0.0, 0.0, config.climb_m])
    straight = np.stack([spawn, climbed, goal])
    if min_separation(straight) >= required - _SLACK_M:
        return straight
    layered = _layered(spawn, goal, required, config)
    reached = min_separation(layered)
    if reached < required - _SLACK_M:
        i, j = (int(index[np.argmin(pair_separations(layered))]) for index in pairs(len(spawn)))
        raise FormationError(
            f"spawn positions of vehicles {i + 1} and {j + 1}: they would come within"
            f" {reached:.2f} m while flying to the first row; legal: {required:.2f} m or more"
        )
    return layered


def transit_path(points: Array, limits: FlightLimits) -> QuinticPath:
    """Minimum-jerk legs between the points, rest to rest, as fast as the limits allow."""
    path = None
    for start, end in itertools.pairwise(points):
        leg = rest_to_rest(start, end, leg_duration(start, end, limits))
        path = leg if path is None else path.then(leg)
    if path is None:
        raise AssertionError("a path has two points or more")
    return path


def leg_duration(start: Array, end: Array, limits: FlightLimits) -> float:
    """Time of a minimum-jerk leg [s], both of shape (N, 3) [m], as short as the limits allow."""
    distance = float(np.sqrt(((end - start) ** 2).sum(axis=-1)).max())
    return max(
        _PEAK_SPEED * distance / limits.v_max,
        (_PEAK_ACCELERATION * distance / limits.a_max) ** (1 / 2),
        (_PEAK_JERK * distance / limits.j_max) ** (1 / 3),
        _SHORTEST_LEG_S,
    )


def _required_separation(spawn: Array, goal: Array, config: PlanConfig) -> float:
    closest = []
    for place, points in (("spawn positions", spawn), ("first row", goal)):
        distances = pair_separations(points[None])
        if len(distances) and distances.min() <= 0.0:
            i, j = (int(index[np.argmin(distances)]) for index in pairs(len(points)))
            raise FormationError(
                f"{place}: vehicles {i + 1} and {j + 1} are both at {_text(points[i])};"
                " legal: different positions"
            )
        closest.append(min_separation(points[None]))
    return min(config.min_separation_m, *closest)


def _layered(spawn: Array, goal: Array, required: float, config: PlanConfig) -> Array:
    level = _levels(spawn, goal, required)
    base = float(spawn[:, 2].max()) + config.climb_m
    height = base + level * max(required, config.min_separation_m)
    above_spawn, above_goal = spawn.copy(), goal.copy()
    above_spawn[:, 2] = above_goal[:, 2] = height
    return np.stack([spawn, above_spawn, above_goal, goal])


def _levels(spawn: Array, goal: Array, required: float) -> Array:
    """Layer number of each vehicle: above every lower-bound vehicle with a conflicting track."""
    count = len(spawn)
    tracks = np.stack([spawn, goal])
    tracks[..., 2] = 0.0
    conflicts = np.zeros((count, count), dtype=bool)
    i, j = pairs(count)
    conflicts[i, j] = conflicts[j, i] = pair_separations(tracks) < required - _SLACK_M
    level = np.zeros(count)
    order = sorted(range(count), key=lambda vehicle: (goal[vehicle, 2], vehicle))
    for position, vehicle in enumerate(order):
        below = [level[other] for other in order[:position] if conflicts[vehicle, other]]
        level[vehicle] = max(below, default=-1.0) + 1.0
    return level


def _text(point: Array) -> str:
    return "(" + ", ".join(f"{value:g}" for value in point) + ") m"
