# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Mode ``in_process``: the program sim_benchmark, controllers as plugins, no ROS."""

from __future__ import annotations

import json
from typing import Any

from trident_eval.ros_paths import program

from trident_benchmarks.processes import Processes
from trident_benchmarks.sim.rows import Plan
from trident_benchmarks.sim.vehicle import MARKER, Setup

_LIMIT_S = 600.0


def measure(plan: Plan, setup: Setup, profile: bool) -> dict[str, Any]:
    """One run in a process of its own, so that its memory is its own.

    Raises:
        EvalError: the program fails or takes too long.
    """
    with Processes() as processes:
        urdf = processes.folder / "vehicle.urdf"
        urdf.write_text(setup.template, encoding="utf-8")
        command = [
            program("trident_sim", "sim_benchmark"),
            *("--world", str(setup.world), "--urdf", str(urdf), "--marker", MARKER),
            *("--parameters", " ".join(str(path) for path in setup.parameter_files)),
            *("--n", str(plan.n), "--window", str(plan.window_s)),
            *(["--profile"] if profile else []),
        ]
        process = processes.start("sim_benchmark", command)
        processes.finish("sim_benchmark", process, _LIMIT_S)
        lines = processes.log("sim_benchmark").read_text(encoding="utf-8").splitlines()
        result: dict[str, Any] = json.loads(lines[-1])
        return result
