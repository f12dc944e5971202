# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Following waypoints by pure pursuit.

R. C. Coulter, "Implementation of the Pure Pursuit Path Tracking Algorithm", CMU-RI-TR-92-01, 1992:
the arc from the robot through a point on the path at the lookahead distance L has the curvature
2 y / L^2, y being the point's place to the left of the robot.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trident_nav.core.errors import NavError, require
from trident_nav.core.velocity import STOP, Velocity

_Floats = npt.NDArray[np.float64]

_ON_SPOT_RAD = math.radians(50.0)  # a target farther off than this is first turned to
_TURN_GAIN = 2.0  # [1/s]


@dataclass(frozen=True)
class FollowerConfig:
    """How to follow.

    Attributes:
        speed: on straights [m/s].
        turn_rate: at most [rad/s].
        lookahead: distance along the path to the point that is steered for [m].
        tolerance: distance at which the last waypoint counts as reached [m].
        acceleration: at most, also of the braking before the last waypoint [m/s^2].
        loop: whether the first waypoint follows the last one.
    """

    speed: float = 0.3
    turn_rate: float = 1.0
    lookahead: float = 0.35
    tolerance: float = 0.05
    acceleration: float = 0.5
    loop: bool = False

    def validate(self) -> None:
        """Raises NavError."""
        require("speed", self.speed, 0.01, 10.0, "m/s")
        require("turn_rate", self.turn_rate, 0.05, 10.0, "rad/s")
        require("lookahead", self.lookahead, 0.05, 20.0, "m")
        require("tolerance", self.tolerance, 0.005, 5.0, "m")
        require("acceleration", self.acceleration, 0.01, 20.0, "m/s^2")


class WaypointFollower:
    """Drives along straight lines from waypoint to waypoint.

    Attributes:
        is_done: whether the last one has been reached.
    """

    def __init__(self, waypoints: Sequence[Sequence[float]], config: FollowerConfig) -> None:
        """Begin where the robot is: the first line leads to the first waypoint.

        Args:
            waypoints: x, y in the frame of the poses [m], shape (n, 2).
            config: how to follow.

        Raises:
            NavError: an illegal configuration or waypoint.
        """
        config.validate()
        self._config = config
        self._path = _checked(waypoints, config.loop)
        self._start()

    def _start(self) -> None:
        self._corner = 0  # next one; the line that is followed ends there
        self._begin: _Floats | None = None
        self._last: tuple[float, float] | None = None  # time and speed
        self.is_done = False

    @property
    def next_waypoint(self) -> int:
        """Index of the waypoint that the robot drives to."""
        return self._corner % len(self._path)

    def command(self, time_s: float, pose: tuple[float, float, float]) -> Velocity:
        """The velocity to drive with from a pose on.

        Args:
            time_s: of the pose [s]; an earlier one than last time starts again.
            pose: x, y [m] and heading [rad] in the frame of the waypoints.
        """
        if self._last is not None and time_s < self._last[0]:
            self._start()
        place = np.array(pose[:2])
        if self._begin is None:
            self._begin = place
        self._pass_corners(place)
        if self.is_done:
            self._last = (time_s, 0.0)
            return STOP
        target = self._target(place)
        ahead = _turned(target - place, -pose[2])
        bearing = math.atan2(ahead[1], ahead[0])
        if abs(bearing) > _ON_SPOT_RAD:
            self._last = (time_s, 0.0)
            return Velocity(0.0, self._bounded(_TURN_GAIN * bearing))
        speed = self._speed(time_s, place, bearing)
        square = float(ahead @ ahead)
        curvature = 2.0 * float(ahead[1]) / square if square > 0.0 else 0.0
        turn = self._bounded(speed * curvature)
        return Velocity(speed, turn)

    def _pass_corners(self, place: _Floats) -> None:
        """Corners that are near, or abreast of the robot, lie behind it."""
        for _ in range(len(self._path)):
            begin, end = self._line()
            is_last = not self._config.loop and self._corner == len(self._path) - 1
            left = float(np.linalg.norm(end - place))
            if is_last:
                self.is_done = self.is_done or left <= self._config.tolerance
                return
            along = end - begin
            length = float(np.linalg.norm(along))
            is_past = length > 0.0 and float((place - end) @ along) >= 0.0
            if left > self._config.lookahead / 2 and not is_past:
                return
            self._begin = end
            self._corner += 1

    def _line(self) -> tuple[_Floats, _Floats]:
        assert self._begin is not None
        return self._begin, self._path[self._corner % len(self._path)]

    def _target(self, place: _Floats) -> _Floats:
        """The point on the line that is one lookahead ahead of the robot's projection onto it."""
        begin, end = self._line()
        along = end - begin
        length = float(np.linalg.norm(along))
        if length == 0.0:
            return end
        unit = along / length
        progress = float((place - begin) @ unit) + self._config.lookahead
        target: _Floats = begin + unit * min(max(progress, 0.0), length)
        return target

    def _speed(self, time_s: float, place: _Floats, bearing: float) -> float:
        """Slower where the path bends and before its end; no faster than acceleration lets it."""
        config = self._config
        speed = config.speed * math.cos(bearing)
        is_last = not config.loop and self._corner == len(self._path) - 1
        left = float(np.linalg.norm(self._path[self._corner % len(self._path)] - place))
        corner_speed = 0.0 if is_last else 0.3 * config.speed
        speed = min(speed, math.sqrt(corner_speed**2 + 2.0 * config.acceleration * left))
        before, was = self._last if self._last is not None else (time_s, 0.0)
        speed = min(speed, was + config.acceleration * max(time_s - before, 0.01))
        self._last = (time_s, speed)
        return speed

    def _bounded(self, rate: float) -> float:
        return max(-self._config.turn_rate, min(self._config.turn_rate, rate))


def _array(waypoints: Sequence[Sequence[float]]) -> _Floats:
    try:
        return np.array(waypoints, dtype=float)
    except (TypeError, ValueError) as error:
        raise NavError(f"waypoints: {waypoints!r}; legal: a list of [x, y]") from error


def _check_finite(path: _Floats) -> None:
    for index, point in enumerate(path):
        if not np.isfinite(point).all():
            raise NavError(f"waypoints[{index}]: {point.tolist()}; legal: finite numbers")


def _checked(waypoints: Sequence[Sequence[float]], loop: bool) -> _Floats:
    path = _array(waypoints)
    if path.ndim != 2 or path.shape[1] != 2 or len(path) == 0:
        raise NavError(f"waypoints: shape {path.shape}; legal: (n, 2), n 1 or more")
    _check_finite(path)
    if loop and len(path) < 2:
        raise NavError("waypoints: 1 of them; legal: 2 or more where they form a loop")
    return path


def _turned(vector: _Floats, angle: float) -> _Floats:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])
