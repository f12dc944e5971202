# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A boat alone in a world of the simulator, under libtrident_vessel.so as every boat is."""

from __future__ import annotations

import json
import math
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import yaml

import trident_sim

Array = npt.NDArray[np.float64]
Vessel = dict[str, Any]
"""What a file of config/vessels holds."""

GRAVITY = 9.81
SHIPPED = ("otter", "wamv", "heron", "small_catamaran")
_FLIP = np.array([1.0, -1.0, -1.0])  # from Fossen's body axes (z down) to those of REP 103


def shipped_vessel(name: str) -> Vessel:
    """The parameters of a vessel of config/vessels."""
    file = trident_sim.find_resource(f"package://trident_bringup/config/vessels/{name}.yaml")
    vessel: Vessel = yaml.safe_load(Path(file).read_text(encoding="utf-8"))
    return vessel


@dataclass(frozen=True)
class Barge:
    """A box in water of 1000 kg/m^3 [m]."""

    length: float = 10.0
    breadth: float = 1.5
    draft: float = 0.5
    density: float = 1000.0

    @property
    def mass(self) -> float:
        """At its draft [kg]."""
        return self.density * self.length * self.breadth * self.draft

    def vessel(self, z_cg: float = 0.0, sections: int = 20) -> Vessel:
        """Added mass and inertia equal to its own, as Jensen's closed forms have it.

        Args:
            z_cg: of the center of gravity above the waterline [m].
            sections: that the hull is cut into.
        """
        long = self.mass * self.length**2 / 12.0
        across = self.mass * self.breadth**2 / 8.0
        step = self.length / sections
        return {
            "name": "barge",
            "water_density": self.density,
            "mass": self.mass,
            "center_of_gravity": [0.0, 0.0, z_cg],
            "inertia": [across, long, long],
            "added_mass": [0.0, self.mass, self.mass, 0.2 * across, long, long],
            "linear_damping": [0.0] * 6,
            "hull": {
                "offsets": [0.0],
                "sections": [
                    {
                        "x": -0.5 * self.length + (i + 0.5) * step,
                        "length": step,
                        "breadth": self.breadth,
                        "draft": self.draft,
                    }
                    for i in range(sections)
                ],
            },
        }


def mass_matrices(vessel: Vessel) -> tuple[Array, Array]:
    """M_RB (6, 6) and M_A (6, 6) about CO, x forward, y left, z up."""
    m, r, inertia = vessel["mass"], center_of_gravity(vessel), inertia_tensor(vessel)
    S = np.array([[0.0, -r[2], r[1]], [r[2], 0.0, -r[0]], [-r[1], r[0], 0.0]])
    M_RB = np.block([[m * np.eye(3), -m * S], [m * S, inertia - m * S @ S]])
    return M_RB, np.diag(vessel.get("added_mass", [0.0] * 6))


def center_of_gravity(vessel: Vessel) -> Array:
    """From CO, x forward, y left, z up [m], shape (3,)."""
    r = np.array(vessel.get("center_of_gravity", [0.0, 0.0, 0.0]), dtype=float)
    return r * _FLIP if vessel.get("axes") == "frd" else r


def inertia_tensor(vessel: Vessel) -> Array:
    """About the center of gravity, x forward, y left, z up [kg m^2], shape (3, 3)."""
    inertia: Array = np.diag(np.array(vessel["inertia"], dtype=float))
    xy, xz, yz = vessel.get("products_of_inertia", [0.0, 0.0, 0.0])
    inertia += np.array([[0.0, xy, xz], [xy, 0.0, yz], [xz, yz, 0.0]])
    if vessel.get("axes") == "frd":
        inertia = inertia * np.outer(_FLIP, _FLIP)
    return inertia


class Trial:
    """A world with one boat, whose link's origin is CO.

    Attributes:
        world: of the simulator.
        boat: the model in it.
    """

    def __init__(
        self,
        vessel: Vessel,
        *,
        step_s: float = 0.01,
        sea: str = "",
        gravity: float = GRAVITY,
        pose: tuple[float, float, float, float, float, float] = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    ) -> None:
        """Make the world.

        Args:
            vessel: its parameters.
            step_s: length of a step [s].
            sea: elements of libtrident_sea.so; empty: still water.
            gravity: downwards [m/s^2].
            pose: of CO as it is let go: x y z roll pitch yaw [m, rad].
        """
        self.world = trident_sim.World(_WORLD.format(step=step_s, gravity=-gravity, sea=sea))
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "vessel.yaml"
            file.write_text(json.dumps(vessel, default=float), encoding="utf-8")
            self.boat = self.world.spawn("boat", sdf=_sdf(vessel, file), pose=pose)

    def command(self, values: dict[str, float]) -> None:
        """Thruster commands by name, from the next step on."""
        for name, value in values.items():
            port = self.world.ports[f"boat/thrusters/{name}_thrust_cmd"]
            port.write(trident_sim.ScalarSample(value))

    def thrust(self, names: list[str]) -> float:
        """Of those thrusters together, in the step before [N]."""
        ports = [self.world.ports[f"boat/thrusters/{name}_thrust"] for name in names]
        for port in ports:
            port.subscribe()
        self.world.step()
        return float(sum(port.value.value for port in ports))

    def run(self, duration_s: float, every: int = 1) -> Motion:
        """Step on and keep the state before each `every`-th step, and the last one."""
        count = round(duration_s / self.world.dt / every)
        rows = [self.state()]
        for _ in range(count):
            self.world.step(every)
            rows.append(self.state())
        return Motion(np.array(rows))

    def state(self) -> list[float]:
        """Time, position, roll pitch yaw, velocities of CO in the world [s, m, rad]."""
        boat = self.boat
        q = boat.orientation
        return [
            self.world.time,
            *boat.position,
            *roll_pitch_yaw(q),
            *boat.linear_velocity,
            *boat.angular_velocity,
        ]


class Motion:
    """States over time, one a row of `Trial.state`."""

    def __init__(self, rows: Array) -> None:
        """Of shape (n, 13)."""
        self.t = rows[:, 0]
        self.position = rows[:, 1:4]
        self.rpy = np.unwrap(rows[:, 4:7], axis=0)
        self.velocity = rows[:, 7:10]
        self.angular_velocity = rows[:, 10:13]


def roll_pitch_yaw(q: Array) -> tuple[float, float, float]:
    """Of a unit quaternion x y z w [rad]."""
    x, y, z, w = (float(value) for value in q)
    return (
        math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
        math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x)))),
        math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
    )


def _sdf(vessel: Vessel, file: Path) -> str:
    r, tensor = center_of_gravity(vessel), inertia_tensor(vessel)
    inertia = {
        name: tensor["xyz".index(name[1]), "xyz".index(name[2])]
        for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    }
    elements = "".join(f"<{name}>{float(value)!r}</{name}>" for name, value in inertia.items())
    center = " ".join(repr(float(value)) for value in r)
    return _MODEL.format(center=center, mass=vessel["mass"], inertia=elements, file=file)


_MODEL = """<sdf version="1.6"><model name="boat">
<link name="base_link"><inertial><pose>{center} 0 0 0</pose><mass>{mass!r}</mass>
<inertia>{inertia}</inertia></inertial></link>
<plugin name="vessel" filename="libtrident_vessel.so"><vessel>{file}</vessel>
<bodyName>base_link</bodyName><robotNamespace>boat</robotNamespace></plugin>
</model></sdf>"""

_WORLD = """<sdf version="1.6"><world name="basin">
<gravity>0 0 {gravity!r}</gravity>
<physics type="ode"><max_step_size>{step!r}</max_step_size></physics>
<plugin name="sea" filename="libtrident_sea.so">{sea}</plugin>
</world></sdf>"""
