# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Modes ``lockstep_external`` and ``lockstep_nodelet``: the server and one controller per vehicle.

External: a process each, ROS between them. Nodelet: all in one nodelet manager.
"""

from __future__ import annotations

import json
import subprocess
import sys
import time
from collections.abc import Sequence
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import program

from trident_benchmarks.processes import Master, Processes
from trident_benchmarks.procfs import process_tree
from trident_benchmarks.sim.rows import Plan
from trident_benchmarks.sim.vehicle import (
    SPAWN_HEIGHT_M,
    Setup,
    describe,
    place,
    vehicle_name,
)

_NODELET = ("rosrun", "nodelet", "nodelet")
_MANAGER = "/nodelets"
_STEP_S = 0.01  # rotors_gazebo/worlds/basic.world
_SPAWN_LIMIT_S = 120.0
_FLIGHT_LIMIT_S = 900.0


def set_params(processes: Processes, master: Master, plan: Plan, setup: Setup) -> None:
    """Sets the parameters that a launch file would."""
    out = processes.folder / "out"
    out.mkdir()
    server = {"wait_for": plan.n, "real_time_factor": 0.0, "out_dir": str(out)}
    params: dict[str, Any] = {"/use_sim_time": True, "/gazebo": server}
    controller = setup.controller_params()
    for index in range(plan.n):
        params[f"/{vehicle_name(index)}"] = {
            "robot_description": describe(setup.template, index),
            "lee_position_controller_node": controller,
        }
    master.set_params(params)


def start_server(processes: Processes, setup: Setup) -> subprocess.Popen[bytes]:
    """Starts the simulator, paused at time zero."""
    command = [program("gazebo_ros", "gzserver"), "-u", str(setup.world), "__name:=gazebo"]
    return processes.start("gazebo", command)


def start_manager(processes: Processes, setup: Setup) -> subprocess.Popen[bytes]:
    """Starts a nodelet manager and loads the simulator into it."""
    manager = processes.start("manager", [*_NODELET, "manager", f"__name:={_MANAGER[1:]}"])
    words = ["gazebo_ros/gzserver", _MANAGER, "-u", str(setup.world), "__name:=gazebo"]
    processes.start("gazebo", [*_NODELET, "load", *words])
    return manager


def spawn_all(processes: Processes, n: int) -> None:
    """Runs one spawn_model process per vehicle, all at once, to their ends."""
    spawners = []
    for index in range(n):
        name = vehicle_name(index)
        x, y = place(index)
        command = [
            program("gazebo_ros", "spawn_model"),
            *("-urdf", "-param", "robot_description", "-model", name),
            *("-x", str(x), "-y", str(y), "-z", str(SPAWN_HEIGHT_M)),
        ]
        log = f"spawn_{name}"
        spawners.append((log, processes.start(log, command, {"ROS_NAMESPACE": name})))
    for log, process in spawners:
        processes.finish(log, process, _SPAWN_LIMIT_S)


def start_controllers(processes: Processes, n: int, command: Sequence[str]) -> list[int]:
    """Starts one controller process per vehicle, or one that loads it; returns their ids."""
    node = "lee_position_controller_node"
    words = [*command, f"__name:={node}", "odometry:=odometry_sensor1/odometry"]
    return [
        processes.start(f"{node}_{i + 1}", words, {"ROS_NAMESPACE": vehicle_name(i)}).pid
        for i in range(n)
    ]


def measure(plan: Plan, setup: Setup) -> dict[str, Any]:
    """One run.

    Raises:
        EvalError: a process fails or takes too long.
    """
    with Processes() as processes:
        roscore, master = processes.start_master()
        set_params(processes, master, plan, setup)
        program("gazebo_ros", "spawn_model")  # found now, so that the search is not timed
        in_manager = plan.mode == "lockstep_nodelet"
        begin = time.perf_counter()
        server = (start_manager if in_manager else start_server)(processes, setup)
        spawn_all(processes, plan.n)
        startup_s = time.perf_counter() - begin
        loading = [*_NODELET, "load", "rotors_control/lee_position_controller", _MANAGER]
        controllers = start_controllers(
            processes, plan.n, loading if in_manager else [setup.controller]
        )
        result = pilot_result(processes, plan, roscore.pid, server.pid, controllers)
        processes.stop(server)
        return result | {"startup_s": startup_s, "state_hash": final_hash(processes)}


def pilot_result(
    processes: Processes, plan: Plan, roscore: int, server: int, controllers: list[int]
) -> dict[str, Any]:
    """Lets the pilot fly; returns what it measured."""
    core = process_tree(roscore)
    command = [
        *(sys.executable, "-m", "trident_benchmarks.sim.pilot"),
        *("--window", str(plan.window_s), "--dt", str(_STEP_S), "--server", str(server)),
        *("--controllers", *map(str, controllers), "--master", *map(str, core)),
    ]
    pilot = processes.start("pilot", command)
    processes.finish("pilot", pilot, _FLIGHT_LIMIT_S)
    lines = processes.log("pilot").read_text(encoding="utf-8").splitlines()
    result: dict[str, Any] = json.loads(lines[-1])
    return result


def final_hash(processes: Processes) -> str:
    """Hash of the simulator's last state, from the run.json that it writes as it ends."""
    path = processes.folder / "out" / "run.json"
    try:
        return str(json.loads(path.read_text(encoding="utf-8"))["state_hash"])
    except (OSError, ValueError, KeyError) as error:
        raise EvalError(f"{path.name} of the simulator: {error}\n{processes.tails()}") from error
