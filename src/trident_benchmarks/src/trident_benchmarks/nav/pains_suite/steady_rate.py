# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""P3: 20 Hz in the office while another process burns a core."""

from __future__ import annotations

import re
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError

from trident_benchmarks.nav.pains_suite.rows import pain
from trident_benchmarks.nav.pains_suite.stack import client_rows, commands, save_true_map
from trident_benchmarks.processes import Processes

_MISSED = re.compile(r"The control loop missed (\d+) of its periods of .* longest was ([\d.]+) s.*")
_RATE_HZ = 20.0
_DURATION_S, _QUICK_DURATION_S = 600.0, 30.0  # simulated
_SPARE_S = 180.0  # wall time beyond that
_START = (0.0, -4.5, 0.0)
_GOALS = ("4.0,-4.5,0.0", "0.0,-4.5,3.14")
_BURN = "while True: pass"


def missed_periods(log: str) -> tuple[int, list[str]]:
    """How many periods move_base says it missed, and its lines."""
    found = [match for line in log.splitlines() if (match := _MISSED.search(line))]
    return sum(int(match[1]) for match in found), [match[0] for match in found]


def _longest_s(line: str) -> float:
    match = _MISSED.search(line)
    return float(match[2]) if match else 0.0


def unnamed(lines: list[str]) -> int:
    """Lines that name no step."""
    return sum("took longest in it" not in line for line in lines)


def steady_rate(quick: bool) -> list[dict[str, Any]]:
    """P3.

    Raises:
        EvalError: a process fails, or the drive does not end.
    """
    duration_s = _QUICK_DURATION_S if quick else _DURATION_S
    with tempfile.TemporaryDirectory(prefix="trident_pains_") as temporary, Processes() as running:
        map_file = save_true_map(Path(temporary), "office")
        _, master = running.start_master()
        master.set_params({"/use_sim_time": True})
        words = ("--for", str(duration_s), "--", *_GOALS)
        parts = commands(running.folder, map_file, "office", _START, words, 1.0)
        running.start("burner", [sys.executable, "-c", _BURN])
        for name, command in parts.items():
            process = running.start(name, command)
            time.sleep(1.0)
        running.wait_until(
            lambda: process.poll() is not None, "the end of the drive", duration_s + _SPARE_S
        )
        goals = client_rows(running)
        log = running.log("move_base").read_text(encoding="utf-8", errors="replace")
    if not goals:
        raise EvalError("P3: the client has seen no result")
    missed, lines = missed_periods(log)
    driven_s = sum(goal["time_s"] for goal in goals)
    worst = max(lines, key=_longest_s, default="")
    what = f"20 Hz for {driven_s:.0f} s next to a process that burns a core"
    return [
        pain(
            "P3",
            "navigation#468, navigation2#5712",
            f"{what}: part of the periods that is longer by over 20 %",
            missed / (driven_s * _RATE_HZ),
            0.01,
            "1",
            note=worst,
        ),
        pain(
            "P3",
            "teb_local_planner#278",
            "the same: of these, those whose longest step is not named",
            float(unnamed(lines)),
            0.0,
            "lines",
        ),
    ]
