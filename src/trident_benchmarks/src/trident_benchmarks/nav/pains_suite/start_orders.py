# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""P10: nodes started in random orders; the first goal is to be reached."""

from __future__ import annotations

import random
import tempfile
import time
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError

from trident_benchmarks.nav.pains_suite.rows import pain
from trident_benchmarks.nav.pains_suite.stack import client_rows, commands, save_true_map
from trident_benchmarks.processes import Processes
from trident_benchmarks.results import say

_ORDERS, _QUICK_ORDERS = 20, 2
_LONGEST_GAP_S = 3.0  # wall time between two starts
_LIMIT_S = 150.0  # wall time of a goal, from the last start
_SPEED = 2.0  # real-time factor
_GOAL = "2.0,0.0,0.0"
_SUCCEEDED = 3  # actionlib's


def first_goal(map_file: Path, seed: int) -> str:
    """Starts everything in an order of its own; returns what failed, or "".

    Raises:
        EvalError: a process fails.
    """
    order = random.Random(seed)
    with Processes() as processes:
        _, master = processes.start_master()
        # As a launch file sets it before its nodes.
        master.set_params({"/use_sim_time": True})
        parts = commands(processes.folder, map_file, "room", (0.0, 0.0, 0.0), ("--", _GOAL), _SPEED)
        names = list(parts)
        order.shuffle(names)
        for name in names:
            process = processes.start(name, parts[name])
            if name == "client":
                client = process
            time.sleep(order.uniform(0.0, _LONGEST_GAP_S))
        try:
            processes.wait_until(lambda: client.poll() is not None, "a result", _LIMIT_S)
        except EvalError as error:
            return f"{', '.join(names)}: {error}"
        rows = client_rows(processes)
        if rows and rows[0]["state"] == _SUCCEEDED:
            return ""
        return f"{', '.join(names)}: {rows[0]['text'] if rows else 'no result'}"


def start_orders(quick: bool) -> list[dict[str, Any]]:
    """P10.

    Raises:
        EvalError: the workspace is not built.
    """
    orders = _QUICK_ORDERS if quick else _ORDERS
    failures = []
    with tempfile.TemporaryDirectory(prefix="trident_pains_") as temporary:
        map_file = save_true_map(Path(temporary), "room")
        for seed in range(orders):
            failure = first_goal(map_file, seed)
            say(f"P10: order {seed}: {failure or 'reached'}")
            failures += [failure] if failure else []
    what = f"world, robot, localization, move_base and client started in {orders} random orders"
    return [
        pain(
            "P10",
            "navigation2#3749, #1194, #4754",
            f"{what}: first goals that fail",
            float(len(failures)),
            0.0,
            "goals",
            note="; ".join(failures),
        )
    ]
