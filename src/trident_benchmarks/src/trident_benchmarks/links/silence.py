# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a medium costs where there are no radios: the same flight with it and without it."""

from __future__ import annotations

import time
from typing import Any

import trident_sim

#: CPU time with the medium over that without it.
SILENCE_LIMIT = 1.01
_UAV = "package://rotors_description/urdf/mav_generic_odometry_sensor.gazebo"
_MAV = "firefly"
_WARM_UP_S = 1.0
_MEDIUM = '<plugin name="air" filename="libtrident_radio_medium.so"><path>two_ray</path></plugin>'
_WORLD = """<sdf version="1.6"><world name="yard"><physics type="ode">
<max_step_size>0.01</max_step_size></physics>
<model name="ground"><static>1</static><link name="link"><collision name="plane">
<geometry><plane><normal>0 0 1</normal></plane></geometry></collision></link></model>
{medium}</world></sdf>"""


def flying_world(vehicles: int, has_medium: bool) -> trident_sim.World:
    """A yard in which multirotors fly between three places under the Lee controller's plugin."""
    world = trident_sim.World(_WORLD.format(medium=_MEDIUM if has_medium else ""), seed=1)
    for index in range(vehicles):
        name = f"uav{index + 1}"
        urdf = trident_sim.expand_xacro(_UAV, mav_name=_MAV, namespace=name)
        files = trident_sim.lee_parameter_files(_MAV)
        world.spawn(
            name,
            urdf=trident_sim.with_lee_controller(urdf, name, files),
            pose=(3.0 * index, 0.0, 0.1),
        )
        x = 3.0 * index
        places = [[x, 0.0, 2.0], [x, 6.0, 3.0], [x, 0.0, 2.0]]
        port = world.ports[f"{name}/command/trajectory"]
        port.write(places, times=[0.0, 5.0, 10.0])
    return world


def _flight(vehicles: int, has_medium: bool, seconds: float) -> tuple[float, list[Any]]:
    """CPU time [s], and where all end."""
    world = flying_world(vehicles, has_medium)
    world.step(round(_WARM_UP_S / world.dt))
    begin = time.process_time()
    world.step(round(seconds / world.dt))
    cpu_s = time.process_time() - begin
    models = [world.models[f"uav{i + 1}"] for i in range(vehicles)]
    return cpu_s, [(*one.position, *one.orientation, *one.linear_velocity) for one in models]


def silence_row(vehicles: int, seconds: float, turns: int) -> dict[str, Any]:
    """The ratio of the least CPU times, of flights by turns; all must end at the same places.

    The least: whatever else the computer does makes a flight dearer, never cheaper.

    Args:
        vehicles: that fly.
        seconds: simulated time of a flight.
        turns: with and without the medium, each the other's neighbour.
    """
    cpu_s: dict[bool, list[float]] = {True: [], False: []}
    ends = set()
    for turn in range(turns):
        for has_medium in (turn % 2 == 0, turn % 2 != 0):
            spent_s, places = _flight(vehicles, has_medium, seconds)
            cpu_s[has_medium].append(spent_s)
            ends.add(repr(places))
    ratio = min(cpu_s[True]) / min(cpu_s[False])
    return {
        "suite": "silence",
        "vehicles": vehicles,
        "ratio": ratio,
        "cpu_s_with": cpu_s[True],
        "cpu_s_without": cpu_s[False],
        "same_end": len(ends) == 1,
        "limit": SILENCE_LIMIT,
        "passed": len(ends) == 1 and ratio <= SILENCE_LIMIT,
    }


def silence_line(row: dict[str, Any]) -> str:
    """A row as one line."""
    same = "the same flight" if row["same_end"] else "ANOTHER flight"
    return (
        f"{row['vehicles']} flying, a medium without radios: {same},"
        f" {row['ratio']:.4f} of the CPU time (<= {row['limit']})"
    )
