# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Boats in motion: speed, turning, zig-zag, current, energy, random commands."""

from __future__ import annotations

import numpy as np

from trident_benchmarks.vessels.check import Check, Curve, Figure, Panel
from trident_benchmarks.vessels.otter_reference import Track, overshoots, radius, reference
from trident_benchmarks.vessels.trial import (
    SHIPPED,
    Array,
    Motion,
    Trial,
    Vessel,
    mass_matrices,
    shipped_vessel,
)

_TURN_RAD = np.deg2rad(20.0)


def _full_ahead(vessel: Vessel) -> dict[str, float]:
    return {each["name"]: float(each.get("max_command", 1.0)) for each in vessel["thrusters"]}


def _speed_at(vessel: Vessel, thrust: float) -> float:
    """Where linear and quadratic drag along x carry the thrust [m/s]."""
    c = vessel["linear_damping"][0]
    q = vessel.get("quadratic_damping", [0.0])[0]
    return float((-c + np.sqrt(c * c + 4 * q * thrust)) / (2 * q) if q > 0 else thrust / c)


def _terminal_speeds(vessel: Vessel) -> tuple[list[float], list[float]]:
    """Thrusts [N] from rest on, and the speed that the vessel reaches with each [m/s]."""
    thrusts, speeds = [0.0], [0.0]
    for part in (0.3, 0.6, 0.9):
        trial = Trial(vessel)
        trial.command({key: part * value for key, value in _full_ahead(vessel).items()})
        trial.world.step(6000)
        thrusts.append(trial.thrust([each["name"] for each in vessel["thrusters"]]))
        speeds.append(float(np.linalg.norm(trial.boat.linear_velocity)))
    return thrusts, speeds


def speed_check() -> Check:
    """Terminal speed of every vessel over its thrust."""
    panel = Panel("Terminal speed", "thrust [N]", "speed ahead [m/s]")
    figures = []
    for name in SHIPPED:
        vessel = shipped_vessel(name)
        thrusts, speeds = _terminal_speeds(vessel)
        x = np.linspace(0.0, thrusts[-1], 100)
        curve = np.array([_speed_at(vessel, value) for value in x])
        panel.measured.append(Curve(name, np.array(thrusts), np.array(speeds), dots=True))
        panel.reference.append(Curve("" if panel.reference else "drag = thrust", x, curve))
        panel.bands.append((x, 0.99 * curve, 1.01 * curve))
        wanted = _speed_at(vessel, thrusts[-1])
        figures.append(
            Figure(f"{name} at {thrusts[-1]:.0f} N", speeds[-1], wanted, 0.01 * wanted, "m/s")
        )
    return Check("Speed where drag equals thrust, within 1 %", [panel], figures)


def _otter_track(munk: bool, left: float, right: float, duration_s: float, zigzag: bool) -> Track:
    """The simulator's Otter; on a zig-zag the propellers change over at 20 degrees."""
    trial = Trial(shipped_vessel("otter") | {"munk": munk})
    rows, side = [trial.state()], 1.0
    trial.command({"left": left, "right": right})
    for _ in range(round(duration_s / trial.world.dt)):
        if zigzag and side * rows[-1][6] >= _TURN_RAD:
            side = -side
            now = (left, right) if side > 0 else (right, left)
            trial.command({"left": now[0], "right": now[1]})
        trial.world.step()
        rows.append(trial.state())
    motion = Motion(np.array(rows))
    return Track(motion.t, motion.position[:, 0], motion.position[:, 1], motion.rpy[:, 2])


def circle_check() -> Check:
    """Turning circle of the Otter, with and without the Munk terms."""
    panels, figures = [], []
    for munk in (False, True):
        expected = reference(munk, 60.0, 90.0, 80.0, zigzag=False)
        track = _otter_track(munk, 60.0, 90.0, 80.0, False)
        title = "with Munk terms" if munk else "munk: false"
        panel = Panel(title, "x [m]", "y [m]", equal=True)
        panel.measured = [Curve("simulator", track.x, track.y)]
        panel.reference = [Curve("scipy, Fossen's model", expected.x, expected.y)]
        panels.append(panel)
        R, turn = radius(expected), float(expected.heading[-1])
        figures.append(Figure(f"radius, {title}", radius(track), R, 0.02 * R, "m"))
        figures.append(
            Figure(f"turned, {title}", float(track.heading[-1]), turn, 0.02 * turn, "rad")
        )
    title = "Otter, propellers at 60 and 90 rad/s: radius within 2 % of scipy's integration"
    return Check(title, panels, figures)


def zigzag_check() -> Check:
    """20/20 zig-zag of the Otter, with and without the Munk terms."""
    panels, figures = [], []
    for munk in (False, True):
        expected = reference(munk, 70.0, 95.0, 40.0, zigzag=True)
        track = _otter_track(munk, 70.0, 95.0, 40.0, True)
        title = "with Munk terms" if munk else "munk: false"
        panel = Panel(title, "t [s]", "heading [deg]")
        panel.measured = [Curve("simulator", track.t, np.rad2deg(track.heading))]
        heading = np.rad2deg(expected.heading)
        panel.reference = [Curve("scipy, Fossen's model", expected.t, heading)]
        panels.append(panel)
        for i, (is_, wanted) in enumerate(
            zip(overshoots(track), overshoots(expected), strict=False)
        ):
            what = f"overshoot {i + 1}, {title}"
            figures.append(Figure(what, float(is_), float(wanted), 1.0, "deg"))
    title = "Otter, 20/20 zig-zag with 70 and 95 rad/s: overshoots within 1 degree of scipy's"
    return Check(title, panels, figures)


def current_check() -> Check:
    """A commanded path in a uniform current is the still-water path, carried along."""
    flow = np.array([0.8 * np.cos(0.7), 0.8 * np.sin(0.7)])
    sea = "<current><kind>uniform</kind><speed>0.8</speed><direction>0.7</direction></current>"
    still, carried = _commanded_path("", np.zeros(2)), _commanded_path(sea, flow)
    wanted = still.position[:, :2] + np.outer(still.t, flow)
    off = 1e3 * np.linalg.norm(carried.position[:, :2] - wanted, axis=1)
    path = Panel("Path of 120 s", "x [m]", "y [m]", equal=True)
    path.measured = [
        Curve("in the current", carried.position[:, 0], carried.position[:, 1]),
        Curve("in still water", still.position[:, 0], still.position[:, 1]),
    ]
    path.reference = [Curve("still water + current x time", wanted[:, 0], wanted[:, 1])]
    difference = Panel("Difference", "t [s]", "[mm]")
    difference.measured = [Curve("simulator", carried.t, off)]
    difference.bands = [(carried.t, np.zeros_like(off), np.ones_like(off))]
    figures = [Figure("largest difference", float(np.max(off)), 0.0, 1.0, "mm")]
    title = "Otter in a uniform current of 0.8 m/s: the same path within 1 mm"
    return Check(title, [path, difference], figures)


def _commanded_path(sea: str, drift: Array) -> Motion:
    trial = Trial(shipped_vessel("otter"), sea=sea)
    trial.boat.set_velocity([*drift, 0.0])
    rows = [trial.state()]
    for i in range(240):
        turn = 25.0 * np.sin(0.09 * i)
        trial.command({"left": 60.0 - turn, "right": 60.0 + turn})
        trial.world.step(50)
        rows.append(trial.state())
    return Motion(np.array(rows))


def energy_check() -> Check:
    """Energy of boat and added mass, tumbling without thrust, hull or weight."""
    panel = Panel("Energy", "t [s]", "energy / energy at the start", log=True)
    figures = []
    for number, name in enumerate(SHIPPED):
        vessel = {key: value for key, value in shipped_vessel(name).items() if key != "hull"}
        M = np.add(*mass_matrices(vessel))
        random = np.random.default_rng(number)
        worst = 0.0
        for start in range(5):
            trial = Trial(vessel, gravity=0.0)
            trial.boat.set_velocity(random.normal(size=3) * 2, random.normal(size=3) * 2)
            t, energy = _energies(trial, M)
            worst = max(worst, float(np.max(np.diff(energy) / energy[:-1])))
            if start == 0:
                panel.measured.append(Curve(name, t, energy / energy[0]))
        figures.append(Figure(f"{name}: largest relative growth", max(worst, 0.0), 0.0, 1e-9))
    return Check(
        "Energy never grows without thrust or waves (five random starts)", [panel], figures
    )


def _energies(trial: Trial, M: Array) -> tuple[Array, Array]:
    """Time [s] and kinetic energy with added mass in water at rest [J], step by step."""
    motion = trial.run(5.0)
    energy = []
    for i in range(len(motion.t)):
        R = body_to_world(motion.rpy[i])
        nu = np.concatenate([R.T @ motion.velocity[i], R.T @ motion.angular_velocity[i]])
        energy.append(0.5 * nu @ M @ nu)
    return motion.t, np.array(energy)


def body_to_world(rpy: Array) -> Array:
    """Body to world of roll, pitch, yaw (3)."""
    (sr, sp, sy), (cr, cp, cy) = np.sin(rpy), np.cos(rpy)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def random_check(steps: int = 1_000_000) -> Check:
    """Random thruster commands, a new one each half second, for every vessel."""
    titles = (("speed", "[m/s]"), ("height of CO", "[m]"), ("tilt", "[rad]"))
    panels = [Panel(title, "10³ steps", f"largest {title} {unit}") for title, unit in titles]
    figures = []
    for number, name in enumerate(SHIPPED):
        vessel = shipped_vessel(name)
        worst, ahead = _random_run(vessel, number, steps)
        bins = worst.reshape(-1, len(worst) // 100, 3).max(axis=1)
        for panel, column in zip(panels, bins.T, strict=True):
            x = np.arange(1, len(bins) + 1) * steps / len(bins) / 1e3
            panel.measured.append(Curve(name, x, column))
        top = _speed_at(vessel, ahead)
        fastest, highest, steepest = worst.max(axis=0)
        # Limits, as deviations from rest; the wake of a turn makes a boat a little faster.
        figures.append(
            Figure(f"{name}: speed, legal 1.2 of top speed", fastest, 0, 1.2 * top, "m/s")
        )
        figures.append(Figure(f"{name}: height", highest, 0.0, 0.3, "m"))
        figures.append(Figure(f"{name}: tilt", steepest, 0.0, 0.6, "rad"))
    title = f"{steps:,} steps of 10 ms with random commands stay bounded".replace(",", " ")
    return Check(title, panels, figures)


def _random_run(vessel: Vessel, seed: int, steps: int) -> tuple[Array, float]:
    """Speed, |z| and tilt after each half second (n, 3); thrust at full ahead [N]."""
    trial, random = Trial(vessel), np.random.default_rng(seed)
    ahead = _full_ahead(vessel)
    trial.command(ahead)
    trial.world.step(200)
    thrust = trial.thrust(list(ahead))
    limits = {
        each["name"]: (float(each.get("min_command", -1.0)), ahead[each["name"]])
        for each in vessel["thrusters"]
    }
    rows = []
    for _ in range(steps // 50):
        trial.command({name: random.uniform(*limit) for name, limit in limits.items()})
        trial.world.step(50)
        x, y = trial.boat.orientation[:2]
        speed = float(np.linalg.norm(trial.boat.linear_velocity))
        tilt = float(np.arccos(np.clip(1 - 2 * (x * x + y * y), -1, 1)))
        rows.append((speed, abs(float(trial.boat.position[2])), tilt))
    return np.array(rows), thrust
