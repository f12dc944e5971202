# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Set-points that stay inside a fence, away from other robots and within limits, whatever is asked.

A point mass with a constant acceleration during each period. Its state is safe if the polyline
along which it would brake from there keeps the margin to the fence and to others. From a safe state
braking leads along that polyline through safe states to rest, so that there is always a next one;
any other acceleration is only taken if the arc of the period and the state at its end are safe. So
no sequence of goals leads out.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from trident_fleet.core.quintic import Array, Motion
from trident_fleet.core.station.config import PilotConfig
from trident_fleet.core.station.fence import Fence

# Of the acceleration, in flights that go as they are planned: what is left is for braking.
_USUAL = 0.7
_SOFT_S = 0.4  # time constant with which the wanted velocity is taken on
_ROUNDING_M = 1e-6
_OLDEST_S = 2.0  # Where others are later than that after they were heard, nobody knows.
_HEAD_ON, _STEP_M = 0.1, 4.0


@dataclass(frozen=True)
class Other:
    """A robot to keep away from.

    Attributes:
        position: p_world [m], shape (3,).
        age_s: since it was there [s].
    """

    position: Array
    age_s: float


class Pilot:
    """Moves a set-point.

    Attributes:
        position: p_world at the end of the last period [m], shape (3,).
        velocity: v_world there [m/s], shape (3,).
    """

    def __init__(self, fence: Fence, config: PilotConfig, position: Array) -> None:
        """Stand at a place, which keeps the margin to the fence's faces."""
        self._fence, self._config = fence, config
        self.position = np.array(position, dtype=np.float64)
        self.velocity = np.zeros(3)
        self._known_at, self._known_m = self.position, -np.inf  # clearance, where it was computed

    def step(self, goal: Array, dt: float, others: list[Other]) -> Array:
        """Continue for a period towards a goal.

        Args:
            goal: where to rest [m, world], shape (3,); may lie anywhere.
            dt: of the period [s].
            others: to keep away from.

        Returns:
            Constant acceleration of this period [m/s^2], shape (3,); see `sampled`.
        """
        spheres = self._spheres(others)
        wanted = self._towards(goal - self.position, dt)
        acceleration = wanted if self._is_safe(wanted, dt, spheres) else None
        if acceleration is None and spheres:
            around = self._towards(self._around(goal, spheres), dt)
            acceleration = around if self._is_safe(around, dt, spheres) else None
        if acceleration is None:
            acceleration = self._braking(self.velocity, dt)
        before = self.position, self.velocity
        self.position = before[0] + before[1] * dt + 0.5 * acceleration * dt * dt
        self.velocity = before[1] + acceleration * dt
        return acceleration

    def _towards(self, away: Array, dt: float) -> Array:
        """To a place that is so far away as fast as it can still stop there."""
        config, distance = self._config, float(np.linalg.norm(away))
        usual = _USUAL * config.a_max
        speed = min(config.v_max, float(np.sqrt(2.0 * 0.7 * usual * distance)), distance / _SOFT_S)
        direction = away / max(distance, _ROUNDING_M)
        change = (speed * direction - self.velocity) / max(_SOFT_S, dt)
        size = float(np.linalg.norm(change))
        return np.asarray(change * min(1.0, usual / max(size, _ROUNDING_M)))

    def _around(self, goal: Array, spheres: list[tuple[Array, float]]) -> Array:
        """Along the nearest sphere, by what of the direction to the goal is tangent to it."""
        gaps = [float(np.linalg.norm(self.position - center)) - r for center, r in spheres]
        outward = self.position - spheres[int(np.argmin(gaps))][0]
        outward = outward / max(float(np.linalg.norm(outward)), _ROUNDING_M)
        away = goal - self.position
        tangent = away - (away @ outward) * outward
        if float(np.linalg.norm(tangent)) < _HEAD_ON * float(np.linalg.norm(away)):
            tangent = np.cross(outward, [0.0, 0.0, 1.0])
        tangent = tangent / max(float(np.linalg.norm(tangent)), _ROUNDING_M)
        return np.asarray(min(float(np.linalg.norm(away)), _STEP_M) * (tangent + 0.2 * outward))

    def _braking(self, velocity: Array, dt: float) -> Array:
        speed = float(np.linalg.norm(velocity))
        return np.asarray(-velocity * min(1.0 / dt, self._config.a_max / max(speed, _ROUNDING_M)))

    def _stop(self, position: Array, velocity: Array, dt: float) -> Array:
        """Where braking from a state ends; the last period brakes a little less."""
        speed, a = float(np.linalg.norm(velocity)), self._config.a_max
        length = speed * speed / (2.0 * a) + a * dt * dt / 8.0
        return np.asarray(position + velocity * (length / max(speed, _ROUNDING_M)))

    def _is_safe(self, acceleration: Array, dt: float, spheres: list[tuple[Array, float]]) -> bool:
        """Whether the arc of a period, and braking after it, keep the margins and the speed.

        The arc is a parabola: a Bezier curve of second order, which lies in the triangle of its
        control points (Farin 2002, chapter 4).
        """
        control = self.position + 0.5 * dt * self.velocity
        velocity = self.velocity + acceleration * dt
        end = self.position + dt * self.velocity + 0.5 * dt * dt * acceleration
        speed = float(np.linalg.norm(velocity))
        if speed > max(self._config.v_max, float(np.linalg.norm(self.velocity))) + _ROUNDING_M:
            return False
        path = np.stack([self.position, control, end, self._stop(end, velocity, dt)])
        return self._keeps_margin(path) and self._keeps_away(path, spheres)

    def _keeps_margin(self, path: Array) -> bool:
        """Clearance changes by no more than the path length, so that it is seldom worked out."""
        reach = float(np.linalg.norm(path - self.position, axis=1).max())
        wanted = self._config.margin_m - _ROUNDING_M
        if self._clearance_here() - reach >= wanted:
            return True
        triangle = np.concatenate([path[:3], path[:1]])
        return min(map(self._fence.path_clearance, (triangle, path[2:]))) >= wanted

    def _clearance_here(self) -> float:
        """A lower bound."""
        moved = float(np.linalg.norm(self.position - self._known_at))
        if moved > 0.25 * self._known_m:
            self._known_at = self.position
            self._known_m = float(self._fence.clearance(self.position[None])[0])
            moved = 0.0
        return self._known_m - moved

    def _spheres(self, others: list[Other]) -> list[tuple[Array, float]]:
        """Where others may be until it has stopped, with the separation."""
        config = self._config
        if not others or config.separation_m == 0.0:
            return []
        stop_s = float(np.linalg.norm(self.velocity)) / config.a_max + _SOFT_S
        spheres = []
        for other in others:
            moved_m = config.others_v_max * (min(other.age_s, _OLDEST_S) + stop_s)
            spheres.append((other.position, config.separation_m + moved_m))
        return spheres

    def _keeps_away(self, path: Array, spheres: list[tuple[Array, float]]) -> bool:
        """Nowhere within a sphere, or, where it is in one, no deeper than now."""
        for center, radius in spheres:
            here = float(np.linalg.norm(self.position - center))
            if here - float(np.linalg.norm(path - self.position, axis=1).max()) >= radius:
                continue
            nearest = min(_nearest(center, a, b) for a, b in itertools.pairwise(path))
            if nearest < min(radius, here) - _ROUNDING_M:
                return False
        return True


def _nearest(point: Array, a: Array, b: Array) -> float:
    """Distance of a point to the segment from a to b [m]."""
    along = b - a
    share = float(np.clip((point - a) @ along / max(float(along @ along), 1e-18), 0.0, 1.0))
    return float(np.linalg.norm(point - a - share * along))


def sampled(position: Array, velocity: Array, acceleration: Array, time: Array) -> Motion:
    """The set-points of a period from its first state, at times since then [s], shape (M,)."""
    t = time[:, None]
    return Motion(
        position=(position + velocity * t + 0.5 * acceleration * t * t)[:, None],
        velocity=(velocity + acceleration * t)[:, None],
        acceleration=(acceleration + np.zeros_like(t))[:, None],
    )
