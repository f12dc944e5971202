# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Twenty vehicles with their default telemetry in one mavlink_vehicle_node, in real time."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml
from trident_base.ports import free_port
from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import program

from trident_benchmarks.bridges.limits import at_most
from trident_benchmarks.bridges.rows import Bench, OtherRow
from trident_benchmarks.bridges.telemetry_listener import TelemetryListener
from trident_benchmarks.procfs import memory_of, process_cpu_s

#: Multirotors, ground robots, vessels.
FLEET = (8, 6, 6)
_KINDS = (("uav", "quadrotor", "px4"), ("ugv", "rover", "ardupilot"), ("usv", "boat", "ardupilot"))
_PORTS = ("offboard_port", "gcs_port", "tcp_port", "px4_simulator_port", "ardupilot_json_port")
_FLEET_S = 60.0
_START_LIMIT_S = 300.0
_SLOWEST = 20.0  # times slower than real time, on a machine that does much else
_NODE = "mavlink_vehicles"


def write_vehicles(path: Path, fleet: tuple[int, int, int], listener: TelemetryListener) -> int:
    """The file of a fleet of cross_domain.launch that sends to a listener.

    Returns:
        How many vehicles it has.
    """
    names = [
        (f"{name}{number + 1}", kind, autopilot)
        for (name, kind, autopilot), count in zip(_KINDS, fleet, strict=True)
        for number in range(count)
    ]
    vehicles = [
        {
            "vehicle": name,
            "kind": kind,
            "autopilot": autopilot,
            "offboard_remote_port": listener.add_port(),
            **{port: free_port() for port in _PORTS},
        }
        for name, kind, autopilot in names
    ]
    content = {
        "vehicles": vehicles,
        "gcs_remote_port": listener.port,
        "router_port": free_port(),
    }
    path.write_text(yaml.safe_dump(content), encoding="utf-8")
    return len(vehicles)


def _start(bench: Bench, fleet: tuple[int, int, int], vehicles: Path) -> int:
    """World, controllers and the node; its process id."""
    counts = zip(("uavs", "ugvs", "usvs"), fleet, strict=True)
    arguments = [f"{name}:={count}" for name, count in counts]
    sensors = ("uav_lidar", "uav_camera", "ugv_lidar", "ugv_camera", "usv_lidar")
    arguments += [f"{name}:=false" for name in sensors]
    arguments += ["pilot:=mavlink", "batteries:=true", "duration:=0", "real_time_factor:=1"]
    command = ["roslaunch", "--disable-title", "trident_bringup", "cross_domain.launch"]
    bench.master.set_params({"/use_sim_time": True, f"/{_NODE}/vehicles_file": str(vehicles)})
    bench.processes.start("cross_domain", [*command, *arguments])
    node = [program("trident_bridges", "mavlink_vehicle_node"), f"__name:={_NODE}"]
    return bench.processes.start(_NODE, node).pid


def measure_fleet(bench: Bench, share: float, fleet: tuple[int, int, int]) -> dict[str, Any]:
    """CPU time of the node for each simulated second, and its memory.

    Args:
        bench: where it is started.
        share: of the whole measurement.
        fleet: how many multirotors, ground robots and vessels.

    Raises:
        EvalError: a process has failed, or a vehicle says nothing.
    """
    processes = bench.processes
    sim_s = max(share * _FLEET_S, 1.0)
    with TelemetryListener() as listener:
        file = processes.folder / "vehicles.yaml"
        count = write_vehicles(file, fleet, listener)
        try:
            pid = _start(bench, fleet, file)
            processes.wait_until(
                lambda: len(listener.systems()) == count,
                f"telemetry of {count} vehicles",
                _START_LIMIT_S,
            )
            begin, cpu_s = listener.snapshot(), process_cpu_s(pid)
            processes.wait_until(
                lambda: listener.snapshot().sim_s - begin.sim_s >= sim_s,
                f"{sim_s:g} simulated seconds",
                _SLOWEST * sim_s + _START_LIMIT_S,
            )
            end, cpu_s = listener.snapshot(), process_cpu_s(pid) - cpu_s
            memory = memory_of(pid)
        finally:
            processes.stop_started(["cross_domain", _NODE])
            bench.master.set_params({"/use_sim_time": False})
    packets, passed_s = end.packets - begin.packets, end.sim_s - begin.sim_s
    if packets == 0:
        raise EvalError("no vehicle sent anything")
    return {
        "messages_s": packets / passed_s,
        "mbit_s": 8e-6 * (end.bytes - begin.bytes) / passed_s,
        "cpu_s_per_s": cpu_s / passed_s,
        "cpu_ms_per_1000": 1e6 * cpu_s / packets,
        "rss_mb": memory.peak_mb,
        "message": f"{count} vehicles, each to a ground station and to an offboard port",
    }


def _twenty(bench: Bench, share: float) -> dict[str, Any]:
    return measure_fleet(bench, share, FLEET)


FLEET_ROWS = (
    OtherRow(
        "20 vehicles in one node",
        "mavlink",
        _twenty,
        (at_most("cpu_s_per_s", 0.1), at_most("rss_mb", 40.0)),
    ),
)
