# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Modes ``startup``, ``main_job``, ``tutorial_full``: whole launch files, as users start them."""

from __future__ import annotations

import json
import subprocess
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError

from trident_benchmarks.processes import Processes, last_lines
from trident_benchmarks.procfs import Memory, memory_of, process_cpu_s
from trident_benchmarks.sim.launch_log import interpolate, node_pids, run_folder, spawn_times
from trident_benchmarks.sim.rows import Plan
from trident_benchmarks.sim.vehicle import MAV, SPAWN_HEIGHT_M, place, vehicle_name

_SAMPLE_PERIOD_S = 0.05
_START_LIMIT_S = 120.0
_BUILD_LIMIT_S = 3600.0
_JOB_LIMIT_S = 600.0


def startup_launch_text(n: int) -> str:
    """A launch file of the simulator, paused, and ``n`` vehicles; no controllers."""
    groups = []
    for index in range(n):
        name, (x, y) = vehicle_name(index), place(index)
        groups.append(
            f'  <group ns="{name}">\n'
            '    <include file="$(find rotors_gazebo)/launch/multi/multi_spawn_mav.launch">\n'
            f'      <arg name="namespace" value="{name}"/>\n'
            f'      <arg name="mav_name" value="{MAV}"/>\n'
            '      <arg name="model" value="$(find rotors_description)/urdf/'
            'mav_generic_odometry_sensor.gazebo"/>\n'
            f'      <arg name="x" value="{x}"/>\n'
            f'      <arg name="y" value="{y}"/>\n'
            f'      <arg name="z" value="{SPAWN_HEIGHT_M}"/>\n'
            "    </include>\n"
            "  </group>\n"
        )
    return (
        "<launch>\n"
        '  <include file="$(find gazebo_ros)/launch/empty_world.launch">\n'
        '    <arg name="world_name" value="$(find rotors_gazebo)/worlds/basic.world"/>\n'
        '    <arg name="paused" value="true"/>\n'
        '    <arg name="gui" value="false"/>\n'
        "  </include>\n" + "".join(groups) + "</launch>\n"
    )


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except FileNotFoundError:
        return ""


def measure_startup(plan: Plan) -> dict[str, Any]:
    """From starting roslaunch, which brings up the master, to the last vehicle's spawning.

    Raises:
        EvalError: it takes too long, or a vehicle is missing.
    """
    with Processes() as processes:
        launch = processes.folder / "startup.launch"
        launch.write_text(startup_launch_text(plan.n), encoding="utf-8")
        command = ["roslaunch", "--disable-title", "-p", str(processes.port), str(launch)]
        begin = time.time()
        processes.start("roslaunch", command)
        log = processes.log("roslaunch")
        processes.wait_until(
            lambda: len(spawn_times(_read(log))) >= plan.n,
            f"the spawning of {plan.n} vehicles",
            _START_LIMIT_S,
        )
        memory = _server_memory(node_pids(_read(log)))
        return {
            "startup_s": spawn_times(_read(log))[plan.n - 1] - begin,
            "peak_rss_mb": memory.peak_mb,
        }


def _server_memory(nodes: Mapping[str, int]) -> Memory:
    if "gazebo" not in nodes:
        raise EvalError("roslaunch has not started the node gazebo")
    return memory_of(nodes["gazebo"])


@dataclass
class JobWatch:
    """Looks at the nodes of a running launch, often and cheaply.

    Attributes:
        cpu: pairs of wall time [s since 1970] and CPU seconds of all nodes together.
        memory: of the simulator, as it was last seen.
    """

    log: Path
    cpu: list[tuple[float, float]] = field(default_factory=list)
    memory: Memory | None = None
    _nodes: dict[str, int] = field(default_factory=dict)
    _node_cpu_s: dict[str, float] = field(default_factory=dict)
    _log_size: int = 0

    def look(self) -> None:
        """Takes one sample. A node that has ended keeps its last CPU time."""
        text = _read(self.log)
        if len(text) != self._log_size:
            self._log_size, self._nodes = len(text), node_pids(text)
        for name, pid in self._nodes.items():
            try:
                self._node_cpu_s[name] = process_cpu_s(pid)
                if name == "gazebo":
                    self.memory = memory_of(pid)
            except EvalError:
                continue
        self.cpu.append((time.time(), sum(self._node_cpu_s.values())))


def workspace_root() -> Path:
    """The checkout that this file is part of.

    Raises:
        EvalError: it is not part of one.
    """
    for folder in Path(__file__).resolve().parents:
        if (folder / "trident").is_file() and (folder / "tools/trident.py").is_file():
            return folder
    raise EvalError(f"{__file__} is in no checkout: ./trident is needed to run the launch files")


def _job_folder(processes: Processes, trident: subprocess.Popen[bytes]) -> Path:
    """Waits until ./trident run has built and says where its results go."""
    output = processes.log("trident")
    processes.wait_until(
        lambda: run_folder(_read(output)) is not None or trident.poll() is not None,
        "the start of ./trident run",
        _BUILD_LIMIT_S,
    )
    name = run_folder(_read(output))
    if name is None:
        raise EvalError(f"./trident run has failed\n{last_lines(output)}")
    return workspace_root() / name


def _run_summary(folder: Path) -> dict[str, Any] | None:
    """The simulator's run.json, or None before it has ended; ./trident run writes another first."""
    try:
        summary: dict[str, Any] = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return summary if "state_hash" in summary else None


def _watch(trident: subprocess.Popen[bytes], folder: Path) -> JobWatch:
    """Samples until the simulator has ended."""
    watch = JobWatch(folder / "roslaunch.log")
    deadline = time.monotonic() + _JOB_LIMIT_S
    while _run_summary(folder) is None:
        if trident.poll() is not None:
            raise EvalError(f"./trident run ended before the simulator\n{last_lines(watch.log)}")
        if time.monotonic() > deadline:
            raise EvalError(f"no end within {_JOB_LIMIT_S:.0f} s\n{last_lines(watch.log)}")
        watch.look()
        time.sleep(_SAMPLE_PERIOD_S)
    return watch


def job_result(summary: Mapping[str, Any], watch: JobWatch, end: float) -> dict[str, Any]:
    """Numbers of a job.

    Args:
        summary: the simulator's run.json.
        watch: what was seen meanwhile.
        end: wall time of the simulator's end [s since 1970].
    """
    sim_s, wall_s = float(summary["sim_s"]), float(summary["wall_s"])
    used_s = interpolate(watch.cpu, end) - interpolate(watch.cpu, end - wall_s)
    return {
        "rtf": float(summary["rtf"]),
        "sim_s": sim_s,
        "wall_s": wall_s,
        "cpu_s_per_sim_s": used_s / sim_s,
        "rss_mb": watch.memory.rss_mb if watch.memory else None,
        "peak_rss_mb": watch.memory.peak_mb if watch.memory else None,
        "state_hash": str(summary["state_hash"]),
    }


def _measure_job(
    words: Sequence[str], env: Mapping[str, str], n: int, judged: bool
) -> dict[str, Any]:
    with Processes() as processes:
        command = [str(workspace_root() / "trident"), "run", *words]
        trident = processes.start("trident", command, env)
        folder = _job_folder(processes, trident)
        log = folder / "roslaunch.log"
        processes.wait_until(log.exists, "the start of roslaunch")
        begin = time.time()
        watch = _watch(trident, folder)
        summary = _run_summary(folder)
        assert summary is not None  # _watch has seen it
        result = job_result(summary, watch, (folder / "run.json").stat().st_mtime)
        spawned = spawn_times(_read(log))
        if len(spawned) < n:
            raise EvalError(f"{log}: {len(spawned)} vehicles were spawned; legal: {n}")
        result["startup_s"] = spawned[n - 1] - begin
        if judged:
            processes.finish("trident", trident, _JOB_LIMIT_S)
            result |= _verdict(folder)
        return result


def _verdict(folder: Path) -> dict[str, Any]:
    verdict = json.loads((folder / "verdict.json").read_text(encoding="utf-8"))
    keys = ("rtf", "state_hash", "formation_rms_m", "tracking_rms_m", "min_separation_m", "pass")
    return {key: verdict[key] for key in keys}


def measure_main_job(plan: Plan) -> dict[str, Any]:
    """``./trident run multi_uav_simulation.launch``, whose verdict must be good.

    Raises:
        EvalError: it fails.
    """
    words = ["multi_uav_simulation.launch", f"uavs:={plan.n}"]
    return _measure_job(words, {}, plan.n, judged=True)


def measure_tutorial(plan: Plan) -> dict[str, Any]:
    """The tutorial's launch file with all its nodes, as fast as possible.

    It says nothing about an end, so its other nodes would stay: it is ended when the simulator has
    ended, and there is no verdict.

    Raises:
        EvalError: it fails.
    """
    words = ["rotors_gazebo", "multi_uav_simulation.launch", "gui:=false", "paused:=false"]
    return _measure_job(words, {"TRIDENT_WAIT_FOR": str(plan.n)}, plan.n, judged=False)
