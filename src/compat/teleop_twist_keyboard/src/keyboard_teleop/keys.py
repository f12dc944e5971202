# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What the keys of teleop_twist_keyboard mean. Knows no ROS and no terminal."""

from __future__ import annotations

import math
from dataclasses import dataclass

HELP = """\
Moving around:            Sideways (with shift):    Up and down:
   u    i    o               U    I    O               t : up
   j    k    l               J    K    L               b : down
   m    ,    .               M    <    >

q/z : both speeds up/down by 10%
w/x : linear speed up/down by 10%
e/c : angular speed up/down by 10%
any other key : stop
CTRL-C : quit
"""

#: Directions (x, y, z, yaw) of the keys that move.
MOVES: dict[str, tuple[int, int, int, int]] = {
    "i": (1, 0, 0, 0),
    "o": (1, 0, 0, -1),
    "j": (0, 0, 0, 1),
    "l": (0, 0, 0, -1),
    "u": (1, 0, 0, 1),
    ",": (-1, 0, 0, 0),
    ".": (-1, 0, 0, 1),
    "m": (-1, 0, 0, -1),
    "I": (1, 0, 0, 0),
    "O": (1, -1, 0, 0),
    "J": (0, 1, 0, 0),
    "L": (0, -1, 0, 0),
    "U": (1, 1, 0, 0),
    "<": (-1, 0, 0, 0),
    ">": (-1, -1, 0, 0),
    "M": (-1, 1, 0, 0),
    "t": (0, 0, 1, 0),
    "b": (0, 0, -1, 0),
}

#: Factors of (linear, angular) speed of the keys that scale.
SCALES: dict[str, tuple[float, float]] = {
    "q": (1.1, 1.1),
    "z": (0.9, 0.9),
    "w": (1.1, 1.0),
    "x": (0.9, 1.0),
    "e": (1.0, 1.1),
    "c": (1.0, 0.9),
}

QUIT = "\x03"  # Ctrl-C, which a raw terminal passes on


@dataclass(frozen=True)
class Velocity:
    """A wanted velocity in the robot's frame [m/s, rad/s]."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    yaw: float = 0.0


def _check(name: str, value: float, limit: float) -> None:
    if not (math.isfinite(value) and value > 0):
        raise ValueError(f"~{name} is {value:g}, legal: a finite number > 0")
    if not (math.isfinite(limit) and limit > 0):
        raise ValueError(f"~{name}_limit is {limit:g}, legal: a finite number > 0")


class Driver:
    """Turns keys into velocities."""

    def __init__(
        self,
        speed: float = 0.5,
        turn: float = 1.0,
        speed_limit: float = 1000.0,
        turn_limit: float = 1000.0,
    ) -> None:
        """Stand still.

        Args:
            speed: linear, at first [m/s].
            turn: angular, at first [rad/s].
            speed_limit: of the linear speed [m/s].
            turn_limit: of the angular speed [rad/s].

        Raises:
            ValueError: a speed is not finite and > 0, or a limit is not, either.
        """
        _check("speed", speed, speed_limit)
        _check("turn", turn, turn_limit)
        self._limits = (speed_limit, turn_limit)
        self.speed, self.turn = min(speed, speed_limit), min(turn, turn_limit)
        self._direction = (0, 0, 0, 0)

    @property
    def velocity(self) -> Velocity:
        """What the last keys ask for."""
        x, y, z, yaw = self._direction
        return Velocity(self.speed * x, self.speed * y, self.speed * z, self.turn * yaw)

    @property
    def moves(self) -> bool:
        """Whether the robot is commanded to move."""
        return any(self._direction)

    def describe(self) -> str:
        """The two speeds, as teleop_twist_keyboard prints them."""
        return f"currently:\tspeed {self.speed:.3g}\tturn {self.turn:.3g}"

    def press(self, key: str) -> bool:
        """Take a key, or "" for none in time, which stops as an unknown key does.

        Returns:
            Whether the speeds were changed.
        """
        if key in SCALES:
            linear, angular = SCALES[key]
            self.speed = min(self.speed * linear, self._limits[0])
            self.turn = min(self.turn * angular, self._limits[1])
            return True
        self._direction = MOVES.get(key, (0, 0, 0, 0))
        return False
