# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Fossen's Otter, integrated by scipy: what the simulator's Otter is checked against.

It shares nothing with the simulator: Fossen's axes (z down), Euler angles, his recipe of the
matrices from the boat's main figures, Coriolis of the rigid body from its form about CG, and an
integrator of its own.

Source: T. I. Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control, 2021, and his
PythonVehicleSimulator, vehicles/otter.py (payload term of the trim moment left out).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
import numpy.typing as npt
from scipy.integrate import solve_ivp

Array = npt.NDArray[np.float64]

GRAVITY = 9.81
DENSITY = 1025.0
TURN_RAD = np.deg2rad(20.0)


def skew(a: Array) -> Array:
    """Cross product matrix of a vector (3)."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


def to_point(r: Array) -> Array:
    """H(r) of Fossen: a twist about a point to the one at r from it."""
    H = np.eye(6)
    H[:3, 3:] = skew(r).T
    return H


class Otter:
    """Fossen's Otter with 25 kg of payload; FRD, no trim moment.

    Attributes:
        M: mass matrix with added mass about CO (6, 6).
        G: stiffness about CO (6, 6).
    """

    length, beam, pontoon_beam, pontoon_y = 2.0, 1.08, 0.25, 0.395
    waterplane_coefficient, block_coefficient = 0.75, 0.4
    hull_mass, payload = 55.0, 25.0
    mass = hull_mass + payload

    def __init__(self, munk: bool) -> None:
        """Work out the matrices; without `munk` the four Munk terms of C_A are left out."""
        self.munk = munk
        r_hull, r_payload = np.array([0.2, 0.0, -0.2]), np.array([0.05, 0.0, -0.35])
        self.r_g = (self.hull_mass * r_hull + self.payload * r_payload) / self.mass
        radii = np.array([0.4 * self.beam, 0.25 * self.length, 0.25 * self.length])
        self.I_g = (
            self.hull_mass * np.diag(radii**2)
            - self.hull_mass * skew(self.r_g) @ skew(self.r_g)
            - self.payload * skew(r_payload) @ skew(r_payload)
        )
        H = to_point(self.r_g)
        M_cg = np.block([[self.mass * np.eye(3), np.zeros((3, 3))], [np.zeros((3, 3)), self.I_g]])
        I_xx, I_yy, I_zz = np.diag(self.I_g)
        m = self.hull_mass
        self.M_A = np.diag([0.1 * m, 1.5 * m, 1.0 * m, 0.2 * I_xx, 0.8 * I_yy, 1.7 * I_zz])
        self.M = H.T @ M_cg @ H + self.M_A
        self.draft = (
            self.mass / DENSITY / (2 * self.block_coefficient * self.pontoon_beam * self.length)
        )
        stiffness = self._stiffness()
        flotation = to_point(np.array([-0.2, 0.0, 0.0]))
        self.G = flotation.T @ np.diag([0.0, 0.0, *stiffness, 0.0]) @ flotation
        self.D = self._damping(stiffness)
        # Hoerner's curve at breadth / (2 draft), between two of its digitised points.
        self.cross_flow = float(
            np.interp(self.pontoon_beam / (2 * self.draft), [0.5585, 0.6464], [1.0836, 0.9986])
        )

    def _stiffness(self) -> Array:
        """Heave, roll and pitch stiffness about the center of flotation."""
        volume = self.mass / DENSITY
        cw, b, length = self.waterplane_coefficient, self.pontoon_beam, self.length
        plane = 2 * cw * length * b
        I_T = (
            2 / 12 * length * b**3 * 6 * cw**3 / ((1 + cw) * (1 + 2 * cw))
            + plane * self.pontoon_y**2
        )
        I_L = 0.8 * 2 / 12 * b * length**3
        KB = (2.5 * self.draft - 0.5 * volume / (length * b)) / 3
        KG = self.draft - self.r_g[2]
        weight = DENSITY * GRAVITY * volume
        return np.array(
            [
                DENSITY * GRAVITY * plane,
                weight * (KB + I_T / volume - KG),
                weight * (KB + I_L / volume - KG),
            ]
        )

    def _damping(self, stiffness: Array) -> Array:
        """Diagonal of the linear damping (6)."""
        M = np.diag(self.M)
        ratio = np.array([0.3, 0.2, 0.4])
        middle = 2 * ratio * np.sqrt(stiffness / M[2:5]) * M[2:5]
        return np.array([24.4 * GRAVITY / (6 * 0.5144), M[1], *middle, M[5]])

    def thrust(self, n: float) -> float:
        """Thrust [N] of a propeller at n [rad/s]."""
        return (0.02216 if n > 0 else 0.01289) / 2 * n * abs(n)

    def nu_dot(self, eta: Array, nu: Array, n_left: float, n_right: float) -> Array:
        """Accelerations (6) in still water."""
        v, w = nu[:3], nu[3:]
        H = to_point(self.r_g)
        C_cg = np.block(
            [[self.mass * skew(w), np.zeros((3, 3))], [np.zeros((3, 3)), -skew(self.I_g @ w)]]
        )
        C_A = np.zeros((6, 6))
        P = self.M_A[:3, :3] @ v
        C_A[:3, 3:] = C_A[3:, :3] = -skew(P)
        C_A[3:, 3:] = -skew(self.M_A[3:, 3:] @ w)
        if not self.munk:
            C_A[5, 0] = C_A[5, 1] = C_A[0, 5] = C_A[1, 5] = 0.0
        left, right = self.thrust(n_left), self.thrust(n_right)
        tau = np.array([left + right, 0.0, 0.0, 0.0, 0.0, self.pontoon_y * (left - right)])
        tau -= self.D * nu
        tau[5] -= 10.0 * self.D[5] * nu[5] * abs(nu[5])
        tau[1] -= self._across(v[1], w[2], 0)
        tau[5] -= self._across(v[1], w[2], 1)
        tau -= (H.T @ C_cg @ H + C_A) @ nu + self.G @ eta
        return np.linalg.solve(self.M, tau)

    def _across(self, v: float, r: float, moment: int) -> float:
        """Cross-flow drag or its moment, by Gauss' rule on either side of the pivot."""
        half = self.length / 2
        pivot = np.clip(-v / r, -half, half) if abs(r) > 1e-12 else half
        scale = 0.5 * DENSITY * self.draft * self.cross_flow
        total = 0.0
        for lo, hi in ((-half, pivot), (pivot, half)):
            x = (lo + hi) / 2 + (hi - lo) / 2 * _NODES
            total += (
                (hi - lo)
                / 2
                * float(np.sum(_WEIGHTS * x**moment * np.abs(v + x * r) * (v + x * r)))
            )
        return scale * total


_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(4)  # type: ignore[no-untyped-call]


def kinematics(eta: Array, nu: Array) -> Array:
    """Rate of eta for zyx Euler angles."""
    phi, theta, psi = eta[3:]
    c, s = np.cos, np.sin
    R = np.array(
        [
            [
                c(psi) * c(theta),
                c(psi) * s(theta) * s(phi) - s(psi) * c(phi),
                s(psi) * s(phi) + c(psi) * c(phi) * s(theta),
            ],
            [
                s(psi) * c(theta),
                c(psi) * c(phi) + s(phi) * s(theta) * s(psi),
                s(theta) * s(psi) * c(phi) - c(psi) * s(phi),
            ],
            [-s(theta), c(theta) * s(phi), c(theta) * c(phi)],
        ]
    )
    T = np.array(
        [
            [1.0, s(phi) * np.tan(theta), c(phi) * np.tan(theta)],
            [0.0, c(phi), -s(phi)],
            [0.0, s(phi) / c(theta), c(phi) / c(theta)],
        ]
    )
    return np.concatenate([R @ nu[:3], T @ nu[3:]])


@dataclass
class Track:
    """A manoeuvre: time (n), x, y, heading (n) with port positive, as REP 103 has it."""

    t: Array
    x: Array
    y: Array
    heading: Array


@cache
def reference(munk: bool, left: float, right: float, duration_s: float, zigzag: bool) -> Track:
    """The same manoeuvre by scipy; state eta (6), nu (6), propellers (2)."""
    otter = Otter(munk)
    lag_s = 0.1

    def rate(commands: tuple[float, float]) -> Callable[[float, Array], Array]:
        def f(_: float, s: Array) -> Array:
            eta, nu, n = s[:6], s[6:12], s[12:]
            return np.concatenate(
                [
                    kinematics(eta, nu),
                    otter.nu_dot(eta, nu, n[0], n[1]),
                    (np.array(commands) - n) / lag_s,
                ]
            )

        return f

    t0, state, side = 0.0, np.zeros(14), 1.0
    times, states = [], []
    while t0 < duration_s:
        commands = (left, right) if side > 0 else (right, left)

        def turned(_: float, s: Array, side: float = side) -> float:
            return side * -s[5] - TURN_RAD

        turned.terminal = zigzag  # type: ignore[attr-defined]
        turned.direction = 1.0  # type: ignore[attr-defined]
        part = solve_ivp(
            rate(commands),
            (t0, duration_s),
            state,
            "DOP853",
            rtol=1e-9,
            atol=1e-10,
            max_step=0.1,
            events=turned,
        )
        assert part.success, part.message
        times.append(part.t)
        states.append(part.y)
        t0, state, side = float(part.t[-1]), part.y[:, -1], -side
        if not zigzag:
            break
    y = np.concatenate(states, axis=1)
    return Track(np.concatenate(times), y[0], -y[1], -np.unwrap(y[5]))


def radius(track: Track) -> float:
    """Radius of the circle through the second half of a track (least squares) [m]."""
    half = track.t > track.t[-1] / 2
    x, y = track.x[half], track.y[half]
    a, b, c = np.linalg.lstsq(np.column_stack([x, y, np.ones_like(x)]), x**2 + y**2, rcond=None)[0]
    return float(np.sqrt(c + (a / 2) ** 2 + (b / 2) ** 2))


def overshoots(track: Track) -> Array:
    """How far the heading goes beyond 20 degrees, swing by swing [deg]; the last is not over."""
    heading = np.rad2deg(track.heading)
    crossings = np.flatnonzero(heading[:-1] * heading[1:] < 0)
    swings = np.split(heading, crossings + 1)[:-1]
    return np.array([np.max(np.abs(swing)) - 20.0 for swing in swings])
