# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""UAVs, UGVs and USVs in one world: how much faster than real time, in this process, without ROS.

UAVs fly between set-points under the Lee controller's plugin, UGVs drive circles on the road, USVs
run out to sea with constant thrust. Python reads no value: a topic that is subscribed is computed.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from trident_eval.core.errors import EvalError

from trident_benchmarks.sim.rows import number_text

_UAV = "package://rotors_description/urdf/mav_generic_odometry_sensor.gazebo"
_DESCRIPTION = "package://trident_description/urdf"
_WARM_UP_S = 1.0
_HASH_S = 2.0

#: Topics of one platform, below its namespace.
LIDARS_3D = {"uav": ("velodyne_points",), "ugv": (), "usv": ("velodyne_points",)}
CAMERAS = {
    "uav": ("camera/rgb/image_raw", "camera/depth/image_raw"),
    "ugv": ("stereo/left/image_raw", "stereo/right/image_raw"),
    "usv": (),
}
OTHERS = {
    "uav": ("fix", "gnss_status", "imu"),
    "ugv": ("scan", "odom"),
    "usv": ("fix", "gnss_status", "imu/data"),
}


@dataclass(frozen=True)
class Case:
    """One fleet to measure.

    Attributes:
        name: of the row.
        world: name of a file in worlds/.
        platforms: how many of each kind: uav, ugv, usv.
        groups: of topics that are read.
        least_rtf: what is asked for.
        sim_s: simulated time of a run [s].
    """

    name: str
    world: str
    platforms: tuple[int, int, int]
    groups: tuple[dict[str, tuple[str, ...]], ...]
    least_rtf: float
    sim_s: float = 20.0

    @property
    def names(self) -> list[tuple[str, str]]:
        """Kind and name of each platform."""
        kinds = zip(("uav", "ugv", "usv"), self.platforms, strict=True)
        return [(kind, f"{kind}{index + 1}") for kind, n in kinds for index in range(n)]


CASES = (
    Case("cross_domain", "coast", (1, 1, 1), (OTHERS, LIDARS_3D, CAMERAS), 2.0),
    Case("wamvs", "ocean", (0, 0, 2), (OTHERS,), 20.0, sim_s=60.0),
    Case("wamvs_lidar", "ocean", (0, 0, 2), (OTHERS, LIDARS_3D), 20.0, sim_s=60.0),
    Case("fleet", "coast", (6, 6, 6), (OTHERS,), 5.0),
    Case("fleet_lidar", "coast", (6, 6, 6), (OTHERS, LIDARS_3D), 2.0),
)


def chosen(names: Sequence[str]) -> list[Case]:
    """The cases of these names; all without names.

    Raises:
        EvalError: an unknown name.
    """
    known = {case.name: case for case in CASES}
    for name in names:
        if name not in known:
            raise EvalError(f"mode {name!r} is unknown; legal: {', '.join(known)}")
    return [case for case in CASES if not names or case.name in names]


def failed(case: Case, error: str) -> dict[str, Any]:
    """The row of a case that could not be measured."""
    return {"mode": case.name, "n": sum(case.platforms), "error": error}


def is_sound(row: dict[str, Any]) -> bool:
    """Whether it was measured, and ended in one state whatever the threads were.

    Speed is not judged: it is the machine's, and of what else it does.
    """
    return "error" not in row and row["repeatable"] and row["same_for_all_threads"]


def measure(case: Case, runs: int, quick: bool, threads: int = 2) -> dict[str, Any]:
    """One row: the median of its runs, and whether all ended in one state.

    In addition to the runs two short ones with one thread and with `threads` are compared to the
    bit.

    Raises:
        EvalError: the world cannot be made, or a sensor says nothing.
    """
    sim_s = case.sim_s / 4.0 if quick else case.sim_s
    results = [_run(case, sim_s, threads) for _ in range(runs)]
    short = {_run(case, _HASH_S, count)["state_hash"] for count in (1, threads)}
    return {
        "mode": case.name,
        "n": sum(case.platforms),
        "platforms": dict(zip(("uavs", "ugvs", "usvs"), case.platforms, strict=True)),
        "world": case.world,
        "rtf": statistics.median(result["rtf"] for result in results),
        "rtf_all": [result["rtf"] for result in results],
        "least_rtf": case.least_rtf,
        "cpu_s_per_sim_s": statistics.median(result["cpu_s_per_sim_s"] for result in results),
        "sim_s": sim_s,
        "threads": threads,
        "runs": runs,
        "state_hash": results[0]["state_hash"],
        "repeatable": len({result["state_hash"] for result in results}) == 1,
        "same_for_all_threads": len(short) == 1,
    }


def _subscribed(world: Any, case: Case) -> list[Any]:
    """Ports of all sensors that are listened to."""
    ports = [
        world.ports[f"{name}/{topic}"]
        for kind, name in case.names
        for group in case.groups
        for topic in group[kind]
    ]
    for port in ports:
        port.subscribe()
    return ports


def _run(case: Case, sim_s: float, threads: int) -> dict[str, Any]:
    world = make_world(case, threads)
    ports = _subscribed(world, case)
    world.step(round(_WARM_UP_S / world.dt))
    before = [port.count for port in ports]
    steps = round(sim_s / world.dt)
    cpu, wall = time.process_time(), time.perf_counter()
    world.step(steps)
    cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
    silent = [port.name for port, was in zip(ports, before, strict=True) if port.count == was]
    if silent:
        raise EvalError(f"{case.name}: nothing on {silent[0]} in {sim_s:g} s")
    return {
        "rtf": sim_s / wall,
        "cpu_s_per_sim_s": cpu / sim_s,
        "state_hash": world.state_hash(),
    }


def make_world(case: Case, threads: int) -> Any:
    """The world with its platforms, each underway.

    Raises:
        EvalError: a description or the world is missing or bad.
    """
    import trident_sim

    try:
        path = f"package://trident_bringup/worlds/{case.world}.world"
        world = trident_sim.World(path, seed=1, sensor_threads=threads)
        for kind, name in case.names:
            index = int(name[3:]) - 1
            _SPAWN[kind](trident_sim, world, name, index)
        return world
    except (trident_sim.Error, KeyError) as error:
        raise EvalError(f"{case.name}: {error}") from error


def _spawn_uav(sim: Any, world: Any, name: str, index: int) -> None:
    urdf = sim.expand_xacro(_UAV, mav_name="tutorial_iris", namespace=name)
    urdf = sim.with_lee_controller(urdf, name, sim.lee_parameter_files("tutorial_iris"))
    x, y = 10.0 + 4.0 * index, 57.0
    world.spawn(name, urdf=urdf, pose=(x, y, 1.6))
    places = [[x, y, 8.0], [x, y - 20.0, 10.0], [x, y - 40.0, 10.0], [x, y, 8.0]]
    times = [0.0, 5.0, 12.0, 25.0]
    world.ports[f"{name}/command/trajectory"].write(places, times=times)


def _spawn_ugv(sim: Any, world: Any, name: str, index: int) -> None:
    urdf = sim.expand_xacro(f"{_DESCRIPTION}/dolly.urdf.xacro")
    world.spawn(name, urdf=urdf, pose=(-30.0 - 8.0 * index, 49.0, 1.5))
    command = sim.TwistCommand((0.8, 0.0, 0.0), (0.0, 0.0, 0.4))
    world.ports[f"{name}/cmd_vel"].write(command)


def _spawn_usv(sim: Any, world: Any, name: str, index: int) -> None:
    urdf = sim.expand_xacro(f"{_DESCRIPTION}/wamv.urdf.xacro")
    world.spawn(name, urdf=urdf, pose=(10.0 + 8.0 * index, 5.0, 0.0, 0.0, 0.0, -1.5707963))
    for side, thrust in (("left", 0.5), ("right", 0.45)):
        world.ports[f"{name}/thrusters/{side}_thrust_cmd"].write(sim.ScalarSample(thrust))


_SPAWN = {"uav": _spawn_uav, "ugv": _spawn_ugv, "usv": _spawn_usv}


def line(row: dict[str, Any]) -> str:
    """A row in a few words."""
    if "error" in row:
        return f"{row['mode']}: failed: {row['error']}"
    text = f"{row['mode']}: rtf {number_text(row['rtf'])} (asked for {row['least_rtf']:g})"
    return text + ("" if is_sound(row) else ", states DIFFER between runs or thread counts")


def markdown_table(rows: Sequence[dict[str, Any]]) -> str:
    """The rows as a Markdown table."""
    columns = ("fleet", "platforms", "real-time factor", "asked for", "CPU s per simulated s")
    lines = [
        "| " + " | ".join((*columns, "same state")) + " |",
        "| --- | --- | ---: | ---: | ---: | --- |",
    ]
    for row in rows:
        if "error" in row:
            lines.append(f"| {row['mode']} | failed: {row['error']} | | | | |")
            continue
        some = ", ".join(f"{count} {kind}" for kind, count in row["platforms"].items() if count)
        same = is_sound(row)
        figures = (row["rtf"], row["least_rtf"], row["cpu_s_per_sim_s"])
        cells = [row["mode"], f"{some} in {row['world']}", *map(number_text, figures)]
        lines.append("| " + " | ".join([*cells, "yes" if same else "NO"]) + " |")
    return "\n".join(lines)


def headline(rows: Sequence[dict[str, Any]]) -> dict[str, float]:
    """The real-time factors by name, of the rows that are there."""
    return {f"{row['mode']}_rtf": row["rtf"] for row in rows if "error" not in row}
