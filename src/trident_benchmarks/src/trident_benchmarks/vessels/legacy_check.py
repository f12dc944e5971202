# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""VRX' own equation of motion, `legacy_vrx`, against scipy's integration of it.

The reference is written from VRX' plugin (usv_gazebo_dynamics_plugin.cc): F = -M_A d(nu)/dt - D nu
without Coriolis forces, and buoyancy of 2 x length_n points, each the segment of a circle. What VRX
takes from the last step, d(nu)/dt, is here the derivative itself.
"""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

import trident_sim
from trident_benchmarks.vessels.check import Check, Curve, Figure, Panel
from trident_benchmarks.vessels.motion_checks import body_to_world
from trident_benchmarks.vessels.trial import Array, roll_pitch_yaw

_DURATION_S, _STEP_S, _GRAVITY, _VRX_GRAVITY = 20.0, 0.002, 9.8, 9.815
_MASS, _INERTIA = 180.0, np.array([120.0, 393.0, 446.0])
_ADDED = np.array([5.0, 5.0, 0.1, 0.1, 0.1, 1.0])
_LINEAR = np.array([51.3, 40.0, 500.0, 50.0, 50.0, 400.0])
_QUADRATIC = np.array([72.4, 0.0, 0.0, 0.0, 0.0, 0.0])
_RADIUS, _LENGTH, _WIDTH, _POINTS, _DENSITY = 0.213, 4.9, 2.4, 2, 997.8
_PUSH, _TURN = np.array([80.0, 25.0, 0.0]), np.array([0.0, 0.0, 40.0])  # world axes
_START = np.array([0.0, 0.0, -0.05, 0.06, -0.04, 0.5])
_WAVES = {"period": 5.0, "number": 3, "scale": 1.5, "gain": 0.4, "angle": 0.4, "tau": 2.0}


def elevation(x: float, y: float, t: float) -> float:
    """Of VRX' wave field, model PMS [m] (wavefield sampler, "simply")."""
    peak, scale = 2 * np.pi / _WAVES["period"], _WAVES["scale"]
    widths = [1 - 1 / scale, (scale - 1 / scale) / 2, scale - 1]
    total = 0.0
    for i in range(3):
        omega = peak * scale ** (i - 1)
        density = 0.0081 * 9.8**2 / omega**5 * np.exp(-1.25 * (peak / omega) ** 4)
        amplitude = _WAVES["gain"] * np.sqrt(2 * density * peak * widths[i])
        heading = (i - 1) * _WAVES["angle"]
        along = x * np.cos(heading) + y * np.sin(heading)
        total += amplitude * np.cos(omega**2 / 9.8 * along - omega * t)
    return float(total * (1 - np.exp(-t / _WAVES["tau"])))


def _buoyancy(p: Array, R: Array, t: float) -> tuple[Array, Array]:
    """Force and torque about the link's origin, world axes."""
    force, torque = np.zeros(3), np.zeros(3)
    for side in (-1.0, 1.0):
        for j in range(_POINTS):
            point = [((j + 0.5) / _POINTS - 0.5) * _LENGTH, side * _WIDTH / 2, 0.0]
            arm = R @ np.array(point)
            surface = elevation(p[0] + arm[0], p[1] + arm[1], t)
            h = float(np.clip(surface - p[2] - arm[2], 0.0, _RADIUS))
            chord = (_RADIUS - h) * np.sqrt(max(0.0, 2 * _RADIUS * h - h * h))
            area = _RADIUS**2 * np.arccos((_RADIUS - h) / _RADIUS) - chord
            lift = np.array([0.0, 0.0, area * _LENGTH / _POINTS * _DENSITY * _VRX_GRAVITY])
            force += lift
            torque += np.cross(arm, lift)
    return force, torque


def _rate(t: float, state: Array) -> Array:
    """Of position, roll pitch yaw, body velocities (12)."""
    p, rpy, v, w = state[:3], state[3:6], state[6:9], state[9:]
    R = body_to_world(rpy)
    lift, torque = _buoyancy(p, R, t)
    nu = state[6:]
    damping = (_LINEAR + _QUADRATIC * np.abs(nu)) * nu
    weight = np.array([0.0, 0.0, -_MASS * _GRAVITY])
    force = R.T @ (lift + weight + _PUSH) - damping[:3] - _MASS * np.cross(w, v)
    moment = R.T @ (torque + _TURN) - damping[3:] - np.cross(w, _INERTIA * w)
    (sr, sp), (cr, cp) = np.sin(rpy[:2]), np.cos(rpy[:2])
    turn = sr * w[1] + cr * w[2]
    euler = np.array([w[0] + turn * sp / cp, cr * w[1] - sr * w[2], turn / cp])
    v_dot, w_dot = force / (_MASS + _ADDED[:3]), moment / (_INERTIA + _ADDED[3:])
    return np.concatenate([R @ v, euler, v_dot, w_dot])


def _simulated() -> tuple[Array, Array]:
    """Times (n) and position, roll pitch yaw (n, 6) of the simulator's boat."""
    world = trident_sim.World(_WORLD.format(**_WAVES, step=_STEP_S, gravity=-_GRAVITY))
    names = ("xDotU yDotV zDotW kDotP mDotQ nDotR", "xU yV zW kP mQ nR", "xUU yVV zWW kPP mQQ nRR")
    figures = zip(" ".join(names).split(), [*_ADDED, *_LINEAR, *_QUADRATIC], strict=True)
    elements = "".join(f"<{name}>{value}</{name}>" for name, value in figures)
    sdf = _BOAT.format(mass=_MASS, inertia=_INERTIA, elements=elements, radius=_RADIUS)
    boat = world.spawn("wamv", sdf=sdf, pose=[float(value) for value in _START])
    boat.link("base_link").apply_wrench(_PUSH, _TURN)
    times, rows = [], []
    for _ in range(round(_DURATION_S / _STEP_S / 10) + 1):
        times.append(world.time)
        rows.append([*boat.position, *roll_pitch_yaw(boat.orientation)])
        world.step(10)
    return np.array(times), np.array(rows)


def legacy_check() -> Check:
    """The WAM-V pushed ahead and turned in VRX' waves."""
    t, motion = _simulated()
    start = np.concatenate([_START, np.zeros(6)])
    reference = solve_ivp(_rate, (0.0, t[-1]), start, rtol=1e-7, atol=1e-8, t_eval=t, max_step=0.05)
    panels, figures = [], []
    for axis, name, unit, scale, legal in (
        (0, "x", "m", 1.0, 0.05),
        (2, "z", "m", 1.0, 0.005),
        (3, "roll", "deg", 57.29578, 0.5),
        (4, "pitch", "deg", 57.29578, 0.5),
        (5, "yaw", "deg", 57.29578, 1.0),
    ):
        wanted, measured = scale * reference.y[axis], scale * np.unwrap(motion[:, axis])
        if axis != 0:
            panel = Panel(name, "t [s]", f"{name} [{unit}]")
            panel.measured, panel.reference = (
                [Curve("legacy_vrx", t, measured)],
                [Curve("scipy, VRX' equation", t, wanted)],
            )
            panel.bands = [(t, wanted - legal, wanted + legal)]
            panels.append(panel)
        off = float(np.max(np.abs(measured - wanted)))
        figures.append(Figure(f"largest difference of {name}", off, 0.0, legal, unit))
    return Check("legacy_vrx: the WAM-V pushed and turned in VRX' waves", panels, figures)


_WORLD = """<sdf version="1.6"><world name="vrx"><gravity>0 0 {gravity}</gravity>
<physics type="ode"><max_step_size>{step}</max_step_size></physics>
<plugin name="ocean_waves" filename="libWavefieldModelPlugin.so"><wave><model>PMS</model>
<period>{period}</period><number>{number}</number><scale>{scale}</scale><gain>{gain}</gain>
<direction>1 0</direction><angle>{angle}</angle><tau>{tau}</tau></wave></plugin>
</world></sdf>"""

_BOAT = """<sdf version="1.6"><model name="wamv"><link name="base_link"><inertial>
<mass>{mass}</mass><inertia><ixx>{inertia[0]}</ixx><iyy>{inertia[1]}</iyy><izz>{inertia[2]}</izz>
</inertia></inertial></link>
<plugin name="dynamics" filename="libusv_gazebo_dynamics_plugin.so"><legacy_vrx>true</legacy_vrx>
<bodyName>base_link</bodyName><waterLevel>0</waterLevel><waterDensity>997.8</waterDensity>
<hullRadius>{radius}</hullRadius><boatWidth>2.4</boatWidth><boatLength>4.9</boatLength>
<length_n>2</length_n>{elements}</plugin></model></sdf>"""
