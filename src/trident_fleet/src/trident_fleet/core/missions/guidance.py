# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""From a path to what a controller takes: set-points in the air, wheels' velocities on the ground.

Both look ahead along the path (pure pursuit, Coulter 1992) and slow down in time for what is
there: the braking distance from a speed v at a deceleration a is v^2 / (2 a).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trident_fleet.core.missions.guided import Motion
from trident_fleet.core.missions.scene import Place
from trident_fleet.core.search.area import Array

_LEAST_TURN_RAD = 0.05
_TINY = 1e-9


def point_ahead(line: Sequence[Place], place: Place, distance_m: float) -> Place:
    """The point at a distance along a line from where a vehicle is abreast of its first leg.

    Args:
        line: where the first leg begins, then the corners ahead; p_common [m].
        place: of the vehicle [m].
        distance_m: along the line [m].
    """
    left = distance_m + (_progress(line[0], line[1], place) if len(line) > 1 else 0.0)
    for one, other in itertools.pairwise(line):
        length = math.dist(one, other)
        if left <= length and length > 0.0:
            share = left / length
            return one[0] + share * (other[0] - one[0]), one[1] + share * (other[1] - one[1])
        left -= length
    return line[-1]


def _progress(begin: Place, end: Place, place: Place) -> float:
    """How far along a leg a vehicle is [m]."""
    along, length = (end[0] - begin[0], end[1] - begin[1]), math.dist(begin, end)
    if length == 0.0:
        return 0.0
    done = ((place[0] - begin[0]) * along[0] + (place[1] - begin[1]) * along[1]) / length
    return min(max(done, 0.0), length)


def allowed_speed(
    place: Place, corners: Sequence[Place], top_m_s: float, brake_m_s2: float, cut_m: float
) -> float:
    """How fast a vehicle may be, so that it takes all corners ahead and stops at the end [m/s].

    A corner that turns by t is rounded by an arc that begins `cut_m` before it: its radius is
    cut_m / tan(t / 2), and the speed on it sqrt(brake * radius).
    """
    speed, away = top_m_s, 0.0
    for before, corner, after in zip(
        (place, *corners[:-1]), corners, (*corners[1:], None), strict=True
    ):
        away += math.dist(before, corner)
        if away > top_m_s**2 / (2.0 * brake_m_s2) + cut_m:
            break
        there, begin = 0.0, away
        if after is not None:
            there = _corner_speed(before, corner, after, brake_m_s2, cut_m)
            begin = max(away - cut_m, 0.0)
        speed = min(speed, math.sqrt(there**2 + 2.0 * brake_m_s2 * begin))
    return speed


def _corner_speed(one: Place, corner: Place, other: Place, brake: float, cut_m: float) -> float:
    if math.dist(one, corner) < _TINY or math.dist(corner, other) < _TINY:
        return math.inf
    before = math.atan2(corner[1] - one[1], corner[0] - one[0])
    after = math.atan2(other[1] - corner[1], other[0] - corner[0])
    turn = abs(math.remainder(after - before, math.tau))
    if turn < _LEAST_TURN_RAD:
        return math.inf
    return math.sqrt(brake * cut_m / math.tan(min(turn, math.pi - 1e-3) / 2.0))


@dataclass(frozen=True)
class AirLimits:
    """What a multirotor is asked for.

    Attributes:
        speed_m_s: horizontal [m/s].
        acceleration_m_s2: of the whole motion, and [m/s^2]...
        jerk_m_s3: ... its change [m/s^3].
        climb_m_s: vertical speed, up and down [m/s].
        cut_m: corners are rounded from so far before them on [m].
        free_m: it flies away from its base only from this height over it on [m].
    """

    speed_m_s: float = 8.0
    acceleration_m_s2: float = 4.0
    jerk_m_s3: float = 14.0
    climb_m_s: float = 4.0
    cut_m: float = 7.0
    free_m: float = 8.0


class AirReference:
    """A point without mass that a multirotor's controller follows, of limited jerk."""

    STEP_S = 0.02
    """Between two points [s]."""
    _SETTLE_S = 0.5  # in which a velocity is approached
    _NEAR_S = 0.9  # in which a place is
    _LOOK_S = 0.75  # ahead, of the speed
    _OVER_BASE_M = 1.0

    def __init__(self, position: Array, limits: AirLimits) -> None:
        """At rest on the ground.

        Args:
            position: p_common [m], shape (3,).
            limits: of it.
        """
        self._limits, self._ground_m = limits, float(position[2])
        self.position, self.velocity = np.array(position, dtype=float), np.zeros(3)
        self.acceleration = np.zeros(3)

    def advance(
        self, line: Sequence[Place], height_m: float, lands: bool, count: int
    ) -> tuple[Array, Array, Array]:
        """Let so many hundredths of a second pass.

        Args:
            line: where the leg begins and the corners ahead, or one place; p_common [m].
            height_m: that it flies at [m].
            lands: where the line ends.
            count: of points.

        Returns:
            Position [m], velocity [m/s] and acceleration [m/s^2] of each, shape (count, 3).
        """
        points = np.empty((3, count, 3))
        for index in range(count):
            points[:, index] = self.position, self.velocity, self.acceleration
            x, y = self._along(line)
            self._step(np.array([x, y, self._climb(line[-1], height_m, lands)]))
        return points[0], points[1], points[2]

    @property
    def _place(self) -> Place:
        return float(self.position[0]), float(self.position[1])

    def _along(self, line: Sequence[Place]) -> tuple[float, float]:
        """The horizontal velocity that leads along a line [m/s]."""
        limits, here = self._limits, self._place
        if float(self.position[2]) - self._ground_m < limits.free_m and len(line) > 1:
            return 0.0, 0.0
        speed_now = float(np.hypot(self.velocity[0], self.velocity[1]))
        goal = point_ahead(line, here, max(self._LOOK_S * speed_now, 1.0))
        away, corners = math.dist(here, goal), line[1:] or line
        brake = 0.7 * limits.acceleration_m_s2
        speed = allowed_speed(here, corners, limits.speed_m_s, brake, limits.cut_m)
        if len(corners) == 1:
            speed = min(speed, math.dist(here, corners[0]) / self._NEAR_S)
        share = speed / max(away, _TINY)
        return share * (goal[0] - here[0]), share * (goal[1] - here[1])

    def _climb(self, end: Place, height_m: float, lands: bool) -> float:
        """The vertical velocity [m/s]."""
        most, up_m = self._limits.climb_m_s, float(self.position[2])
        goal_m = height_m
        if lands and math.dist(self._place, end) < self._OVER_BASE_M:
            goal_m = self._ground_m
        return min(max((goal_m - up_m) / self._NEAR_S, -most), most)

    def _step(self, wanted: Array) -> None:
        limits, step_s = self._limits, self.STEP_S
        asked = _cut((wanted - self.velocity) / self._SETTLE_S, limits.acceleration_m_s2)
        change = _cut(asked - self.acceleration, limits.jerk_m_s3 * step_s)
        self.acceleration = self.acceleration + change
        self.position = self.position + step_s * (self.velocity + 0.5 * step_s * self.acceleration)
        self.velocity = self.velocity + step_s * self.acceleration


def _cut(vector: Array, most: float) -> Array:
    """The vector, no longer than that."""
    return vector * min(1.0, most / max(float(np.linalg.norm(vector)), _TINY))


@dataclass(frozen=True)
class GroundLimits:
    """What a robot with two driven wheels is asked for.

    Attributes:
        speed_m_s: ahead [m/s].
        acceleration_m_s2: of braking [m/s^2].
        faster_m_s: than it is it is asked to be at most [m/s]: wheels that both speed up as fast as
            they can do not turn the robot.
        turn_rad_s: rate of turn [rad/s].
        look_m: ahead along its path at least [m], and...
        look_s: ... by so much time, at its speed: its rate of turn follows slowly [s].
        on_spot_rad: what is farther off its nose than this it turns to before it drives.
        stand_m: it stands within this of where it is to be [m].
    """

    speed_m_s: float = 2.0
    acceleration_m_s2: float = 0.6
    faster_m_s: float = 0.12
    turn_rad_s: float = 1.0
    look_m: float = 1.0
    look_s: float = 1.4
    on_spot_rad: float = 0.9
    stand_m: float = 0.3


_CUT_M = 0.6  # before a corner the turn begins
_TURN_GAIN = 1.2  # [1/s]


def wheels_velocity(
    motion: Motion, line: Sequence[Place], limits: GroundLimits
) -> tuple[float, float]:
    """Speed ahead [m/s] and rate of turn [rad/s] along a line.

    Args:
        motion: of the robot.
        line: where the leg begins and the corners ahead, or one place; p_common [m].
        limits: of the robot.
    """
    corners = line[1:] or line
    if len(corners) == 1 and math.dist(motion.place, corners[0]) <= limits.stand_m:
        return 0.0, 0.0
    look_m = max(limits.look_m, limits.look_s * motion.speed_m_s)
    goal = point_ahead(line, motion.place, look_m)
    right, ahead = goal[0] - motion.place[0], goal[1] - motion.place[1]
    bearing = math.remainder(math.atan2(ahead, right) - motion.yaw_rad, math.tau)
    if abs(bearing) > limits.on_spot_rad:
        return 0.0, _bounded(_TURN_GAIN * bearing, limits.turn_rad_s)
    speed = allowed_speed(motion.place, corners, limits.speed_m_s, limits.acceleration_m_s2, _CUT_M)
    speed = min(speed * math.cos(bearing), motion.speed_m_s + limits.faster_m_s)
    speed = max(speed, 0.1)
    away = max(math.hypot(right, ahead), limits.look_m, limits.look_s * speed)
    return speed, _bounded(2.0 * speed * math.sin(bearing) / away, limits.turn_rad_s)


class Unstick:
    """Drives a robot back, and the next time ahead, when it neither comes on nor turns."""

    _PERIODS_STUCK, _PERIODS_AWAY = 20, 25
    _AWAY_M_S = 0.5
    _LEAST_M_S, _LEAST_RAD = 0.03, 0.01

    def __init__(self) -> None:
        """It moves."""
        self._stuck = self._left = 0
        self._away_m_s, self._yaw_rad = self._AWAY_M_S, 0.0

    def velocity(self, wanted: tuple[float, float], motion: Motion) -> tuple[float, float]:
        """What to drive with in the next period, a tenth of a second.

        Args:
            wanted: speed ahead [m/s] and rate of turn [rad/s].
            motion: of the robot.
        """
        turned = abs(math.remainder(motion.yaw_rad - self._yaw_rad, math.tau))
        self._yaw_rad = motion.yaw_rad
        if self._left:
            self._left -= 1
            return self._away_m_s, 0.0
        is_still = motion.speed_m_s < self._LEAST_M_S and turned < self._LEAST_RAD
        self._stuck = self._stuck + 1 if is_still and wanted != (0.0, 0.0) else 0
        if self._stuck >= self._PERIODS_STUCK:
            self._stuck, self._left = 0, self._PERIODS_AWAY
            self._away_m_s = -self._away_m_s
        return wanted


def _bounded(value: float, most: float) -> float:
    return max(-most, min(most, value))
