# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What the stand-ins for PX4 and ArduPilot share: loops for attitude, height and place.

All vectors are north, east, down, or forward, right, down. The vehicle is the quadrotor iris of
trident_description/sdf: its mass, rotors and inertia are known here as an autopilot's gains are.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

GRAVITY = 9.8066
MASS = 1.535
INERTIA = (0.029125, 0.029125, 0.055225)
FORCE_CONSTANT = 5.84e-6  # thrust by squared speed [N s^2]
MOMENT_CONSTANT = 0.06  # drag torque by thrust [m]
# Forward, right [m], and the sign of the torque about down, of each motor.
MOTORS = ((0.13, 0.22, 1.0), (-0.13, -0.2, 1.0), (0.13, -0.22, -1.0), (-0.13, 0.2, -1.0))
ARM_S, HOLD_UNTIL_S, HEIGHT = 2.0, 10.0, 3.0
CLIMB, DESCENT = 1.0, 0.7  # [m/s]


def clamp(value: float, limit: float) -> float:
    """Cut to [-limit, limit]."""
    return max(-limit, min(limit, value))


def cross(a: Vector, b: Vector) -> Vector:
    """The vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def rotate(q: Quaternion, v: Vector) -> Vector:
    """From the body's axes to north, east, down; q is w, x, y, z."""
    w, x, y, z = q
    t = cross((x, y, z), v)
    u = cross((x, y, z), t)
    return (
        v[0] + 2.0 * (w * t[0] + u[0]),
        v[1] + 2.0 * (w * t[1] + u[1]),
        v[2] + 2.0 * (w * t[2] + u[2]),
    )


def conjugate(q: Quaternion) -> Quaternion:
    """The inverse rotation."""
    return (q[0], -q[1], -q[2], -q[3])


def turn(q: Quaternion, w: Vector, dt: float) -> Quaternion:
    """Turn q by the rate w, in the body's axes, for dt [s]."""
    a, b, c, d = q
    x, y, z = (0.5 * dt * rate for rate in w)
    p = (
        a - b * x - c * y - d * z,
        b + a * x + c * z - d * y,
        c + a * y + d * x - b * z,
        d + a * z + b * y - c * x,
    )
    length = math.sqrt(sum(number * number for number in p))
    return (p[0] / length, p[1] / length, p[2] / length, p[3] / length)


@dataclass
class State:
    """What the loops need to know."""

    attitude: Quaternion = (1.0, 0.0, 0.0, 0.0)
    rate: Vector = (0.0, 0.0, 0.0)  # [rad/s]
    position: Vector = (0.0, 0.0, 0.0)  # [m]
    velocity: Vector = (0.0, 0.0, 0.0)  # [m/s]


@dataclass
class Flight:
    """Takes off to 3 m, holds, lands. `step` gives rotor speeds [rad/s], or None: disarmed."""

    hold_until_s: float = HOLD_UNTIL_S
    home: Vector | None = None
    has_landed: bool = False
    rate_integral: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    low_since: float = math.inf

    def step(self, t: float, state: State, dt: float) -> list[float] | None:
        """Work out the speeds for the state at t [s], dt [s] after the one before."""
        if t < ARM_S or self.has_landed:
            return None
        if self.home is None:
            self.home = state.position
        height = self.home[2] - state.position[2]
        self._look_for_landing(t, height, state)
        force = self._force(self._height_wanted(t), state)
        return self._speeds(force, state, dt)

    def _height_wanted(self, t: float) -> float:
        if t < self.hold_until_s:
            return min(HEIGHT, CLIMB * (t - ARM_S))
        return max(-1.0, HEIGHT - DESCENT * (t - self.hold_until_s))

    def _look_for_landing(self, t: float, height: float, state: State) -> None:
        is_low = t > self.hold_until_s and height < 0.3 and abs(state.velocity[2]) < 0.15
        self.low_since = min(self.low_since, t) if is_low else math.inf
        self.has_landed = t - self.low_since > 0.7

    def _force(self, height: float, state: State) -> Vector:
        """Of the rotors, north, east, down [N]."""
        assert self.home is not None
        want = (self.home[0], self.home[1], self.home[2] - height)
        accelerations = []
        for axis, (p, v) in enumerate(((0.8, 1.6), (0.8, 1.6), (1.5, 3.5))):
            speed = clamp(p * (want[axis] - state.position[axis]), 1.2)
            accelerations.append(clamp(v * (speed - state.velocity[axis]), 3.0))
        return (
            MASS * accelerations[0],
            MASS * accelerations[1],
            MASS * (accelerations[2] - GRAVITY),
        )

    def _speeds(self, force: Vector, state: State, dt: float) -> list[float]:
        down = conjugate(state.attitude)
        wanted = rotate(down, force)  # forward, right, down
        size = math.sqrt(sum(number * number for number in force))
        # The rotors push up, against the body's down: turn that axis onto the force.
        tilt = cross((0.0, 0.0, -1.0), (wanted[0] / size, wanted[1] / size, wanted[2] / size))
        north = rotate(down, (1.0, 0.0, 0.0))
        rates = (6.0 * tilt[0], 6.0 * tilt[1], 2.0 * math.atan2(north[1], north[0]))
        torque = []
        for axis, (gain, integral) in enumerate(((18.0, 10.0), (18.0, 10.0), (6.0, 2.0))):
            error = clamp(rates[axis], 3.0) - state.rate[axis]
            self.rate_integral[axis] = clamp(self.rate_integral[axis] + error * dt, 0.3)
            torque.append(INERTIA[axis] * (gain * error + integral * self.rate_integral[axis]))
        return _allocate(max(0.2 * MASS * GRAVITY, -wanted[2]), torque)


def _allocate(thrust: float, torque: list[float]) -> list[float]:
    """Motor speeds for a thrust [N] and a torque [N m]."""
    speeds = []
    for forward, right, sign in MOTORS:
        force = thrust / 4.0
        force -= torque[0] * right / (4.0 * 0.21 * 0.21)
        force += torque[1] * forward / (4.0 * 0.13 * 0.13)
        force += torque[2] * sign / (4.0 * MOMENT_CONSTANT)
        speeds.append(math.sqrt(max(0.05, force) / FORCE_CONSTANT))
    return speeds
