# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""From two looks at the clocks to the numbers of a run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from trident_eval.core.errors import EvalError


@dataclass(frozen=True)
class Sample:
    """Clocks at one instant [s]; CPU times are since the start of each process."""

    wall_s: float
    server_cpu_s: float
    controllers_cpu_s: float
    master_cpu_s: float
    machine_busy_s: float


def to_result(begin: Sample, end: Sample, sim_s: float) -> dict[str, Any]:
    """Numbers of a run between two samples that are ``sim_s`` of simulated time apart.

    ``others_cpu_cores`` is what the rest of the machine used meanwhile, in cores.

    Raises:
        EvalError: no time has passed.
    """
    wall_s = end.wall_s - begin.wall_s
    if wall_s <= 0.0 or sim_s <= 0.0:
        raise EvalError(f"the window is {sim_s} s simulated, {wall_s} s wall; legal: both > 0")
    server_s = end.server_cpu_s - begin.server_cpu_s
    controllers_s = end.controllers_cpu_s - begin.controllers_cpu_s
    master_s = end.master_cpu_s - begin.master_cpu_s
    busy_s = end.machine_busy_s - begin.machine_busy_s
    others_s = max(0.0, busy_s - server_s - controllers_s - master_s)
    return {
        "rtf": sim_s / wall_s,
        "cpu_s_per_sim_s": (server_s + controllers_s) / sim_s,
        "sim_s": sim_s,
        "wall_s": wall_s,
        "others_cpu_cores": others_s / wall_s,
        "cpu_split_s_per_sim_s": {
            "server": server_s / sim_s,
            "controllers": controllers_s / sim_s,
            "master and rosout": master_s / sim_s,
        },
    }
