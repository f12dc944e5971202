# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Boats under their controller: a line in a current, waypoints, a station in waves."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import yaml

import trident_sim
from trident_benchmarks.vessels.check import Check, Curve, Figure, Panel
from trident_benchmarks.vessels.trial import Array

_CONTROLLERS = "package://trident_bringup/config/controllers/{}.yaml"
_URDF = "package://trident_description/urdf/{}.urdf.xacro"
_CROSS_CURRENT = (
    "<current><kind>uniform</kind><speed>0.5</speed><direction>1.5708</direction></current>"
)
_COURSE = np.array([[0.0, 0.0], [60.0, 0.0], [60.0, 40.0], [0.0, 40.0], [0.0, 10.0]])
_ROUGH = """<waves><spectrum>jonswap</spectrum><significant_height>0.3</significant_height>
<peak_period>4</peak_period><components>60</components></waves>
<wind><speed>4</speed><direction>2.2</direction></wind>"""
_WORLD = """<sdf version="1.6"><world name="sea"><gravity>0 0 -9.81</gravity>
<physics type="ode"><max_step_size>0.01</max_step_size></physics>
<plugin name="sea" filename="libtrident_sea.so">{sea}</plugin></world></sdf>"""
_SAMPLE_STEPS = 10


class ControlledBoat:
    """A shipped vessel, as its xacro has it, under libtrident_vessel_controller.so."""

    def __init__(
        self,
        vessel: str,
        sea: str,
        changes: Mapping[str, Mapping[str, Any]] | None = None,
        **args: object,
    ) -> None:
        """Put it at the origin.

        Args:
            vessel: of trident_description/urdf.
            sea: elements of libtrident_sea.so.
            changes: to sections of its controller's file.
            args: of the xacro.
        """
        name = trident_sim.find_resource(_CONTROLLERS.format(vessel))
        control = yaml.safe_load(Path(name).read_text(encoding="utf-8"))
        for section, values in (changes or {}).items():
            control[section] = {**control.get(section, {}), **values}
        xacro = trident_sim.find_resource(_URDF.format(vessel))
        urdf = trident_sim.expand_xacro(xacro, lidar="false", control="plugin", **args)
        self.world = trident_sim.World(_WORLD.format(sea=sea), seed=1)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "controller.yaml"
            file.write_text(yaml.safe_dump(control), encoding="utf-8")
            urdf = urdf.replace(_CONTROLLERS.format(vessel), str(file))
            self.boat = self.world.spawn("boat", urdf=urdf)

    def follow(self, waypoints: Array) -> None:
        """Waypoints [m], shape (n, 2)."""
        places = np.column_stack([waypoints, np.zeros(len(waypoints))])
        self.world.ports["boat/command/path"].write(trident_sim.PathCommand(places))

    def keep(self, x: float, y: float, yaw: float) -> None:
        """A station [m, rad]."""
        self.world.ports["boat/command/pose"].write(trident_sim.PoseSample((x, y, 0.0), yaw))

    def run(self, duration_s: float) -> Array:
        """Step on; time and place at 10 Hz [s, m], shape (n, 3)."""
        rows = []
        for _ in range(round(duration_s / self.world.dt / _SAMPLE_STEPS)):
            self.world.step(_SAMPLE_STEPS)
            rows.append([self.world.time, *self.boat.position[:2]])
        return np.array(rows)


def guidance_check() -> Check:
    """The distance from a line in a current across it, with and without integral."""
    panel = Panel("A line in a current of 0.5 m/s across it", "time [s]", "off the line [m]")
    tracks = {}
    for label, gain in (("with integral", 1.0), ("without", 0.0)):
        changes: dict[str, dict[str, Any]] = {
            "guidance": {"integral_gain": gain, "lookahead": 10.0},
            "speed": {"cruise": 1.5, "reference": "through_water"},
        }
        boat = ControlledBoat("otter", _CROSS_CURRENT, changes)
        boat.follow(np.array([[0.0, 0.0], [1000.0, 0.0]]))
        track = tracks[label] = boat.run(240.0)
        panel.measured.append(Curve(label, track[:, 0], track[:, 2]))
    time = track[:, 0]
    # There the bow is turned by asin(0.5 / 1.5), as far as a point 10 m ahead on the line turns it.
    cross_track = 10.0 * np.tan(np.arcsin(0.5 / 1.5))
    reference = np.full_like(time, cross_track)
    panel.reference.append(Curve("10 m tan(asin(0.5 / 1.5))", time, reference))
    panel.bands.append((time, np.full_like(time, -0.5), np.full_like(time, 0.5)))
    late = time > 180.0
    held = float(np.max(np.abs(tracks["with integral"][late, 2])))
    drifted = float(np.mean(tracks["without"][late, 2]))
    figures = [
        Figure("farthest off the line in the last minute", held, 0.0, 0.5, "m"),
        Figure("off the line without integral", drifted, float(cross_track), 0.2, "m"),
    ]
    return Check("The Otter holds a line at 1.5 m/s through the water", [panel], figures)


def course_check() -> Check:
    """A course of waypoints in a current, and its end."""
    boat = ControlledBoat("otter", _CROSS_CURRENT.replace("0.5<", "0.3<"))
    boat.follow(_COURSE)
    track = boat.run(400.0)
    panel = Panel("Waypoints in a current of 0.3 m/s", "x [m]", "y [m]", equal=True)
    panel.measured.append(Curve("Otter", track[:, 1], track[:, 2]))
    panel.reference.append(Curve("course", _COURSE[:, 0], _COURSE[:, 1]))
    away = np.linalg.norm(track[:, None, 1:] - _COURSE[None, :, :], axis=2)
    figures = [
        Figure(f"passes waypoint {i} within its circle", float(near), 0.0, 5.0, "m")
        for i, near in enumerate(np.min(away, axis=0))
    ]
    late = track[:, 0] > 300.0
    end = float(np.max(away[late, -1]))
    figures.append(Figure("stays at the last one, from 300 s on", end, 0.0, 1.0, "m"))
    return Check("The Otter finishes a course and stays at its end", [panel], figures)


def station_check() -> Check:
    """A WAM-V with thrusters X at its station in waves and wind."""
    boat = ControlledBoat("wamv", _ROUGH, thrusters="X")
    boat.keep(6.0, -4.0, 1.0)
    boat.run(60.0)
    track = boat.run(300.0)
    x, y = track[:, 1] - 6.0, track[:, 2] + 4.0
    off = np.hypot(x, y)
    circle = np.linspace(0.0, 2.0 * np.pi, 100)
    place = Panel("Five minutes at a station", "x [m]", "y [m]", equal=True)
    place.measured.append(Curve("WAM-V X", x, y))
    place.reference.append(Curve("1 m", np.cos(circle), np.sin(circle)))
    panel = Panel("Distance", "time [s]", "[m]")
    panel.measured.append(Curve("WAM-V X", track[:, 0], off))
    panel.bands.append((track[:, 0], np.zeros_like(off), np.ones_like(off)))
    figures = [Figure("95 % of 300 s within", float(np.quantile(off, 0.95)), 0.0, 1.0, "m")]
    title = "The WAM-V with thrusters X keeps station at Hs 0.3 m, Tp 4 s, wind 4 m/s"
    return Check(title, [place, panel], figures)
