# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""How long scans wait while a large graph is optimised: in process, and over ROS."""

from __future__ import annotations

import json
import math
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import program

from trident_benchmarks.processes import Processes
from trident_benchmarks.slam.live_drive import RATE_HZ, Drive, poses, write_log

#: A scan is reflected in map -> odom within this [ms].
LIMIT_MS = 100.0
_HOUR_SCANS = 3600 * RATE_HZ


@dataclass(frozen=True)
class Plan:
    """What to measure.

    Attributes:
        nodes: of the graph when the measurement begins.
        seconds: scans come for so long, in real time.
        blocks: of the office that is driven through.
        with_hour: also the memory after an hour's scans.
    """

    nodes: int = 5000
    seconds: float = 60.0
    blocks: int = 9
    with_hour: bool = True


def measure(plan: Plan, say: Callable[[str], None]) -> dict[str, Any]:
    """All figures.

    Raises:
        EvalError: a program fails.
    """
    with tempfile.TemporaryDirectory(prefix="trident_bench_live_") as folder:
        out = Path(folder)
        log = out / "drive.log"
        say(f"drive of {plan.blocks} x {plan.blocks} blocks")
        drive = Drive(blocks=plan.blocks)
        scans = write_log(drive, log)
        say(f"{scans} scans; a graph of {plan.nodes} nodes, then {plan.seconds:g} s in real time")
        seconds = ["--seconds", f"{plan.seconds:g}", "--rate", f"{RATE_HZ:g}"]
        core = _slam_live([str(log), "--out", folder, "--nodes", str(plan.nodes), *seconds])
        last = min(scans, core["scans_built"] + round(plan.seconds * RATE_HZ)) - 1
        core["last_error_m"] = _error(drive, last, core["last_x_y_yaw"])
        say("the same over ROS")
        node = _over_ros(plan, log, out, core["scans_built"])
        row = {"core": core, "node": node, "limit_ms": LIMIT_MS}
        if plan.with_hour:
            repeat = math.ceil(_HOUR_SCANS / scans)
            say(f"an hour's scans: the drive with each scan {repeat} times")
            row["hour"] = _slam_live([str(log), "--out", folder, "--repeat", str(repeat)])
    return row


def _error(drive: Drive, scan: int, found: list[float]) -> float:
    """How far a pose is from the truth, in a map that begins at the first pose [m]."""
    truth = poses(drive)
    assert truth[0, 2] == 0.0
    return float(np.linalg.norm(truth[scan, :2] - truth[0, :2] - found[:2]))


def _slam_live(words: list[str]) -> dict[str, Any]:
    done = subprocess.run(
        [program("trident_slam", "slam_live"), *words], capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        raise EvalError(done.stderr.strip() or f"slam_live ended with {done.returncode}")
    return dict(json.loads(done.stdout))


def _over_ros(plan: Plan, log: Path, out: Path, first: int) -> dict[str, Any]:
    """The node continues the session that the core built."""
    with Processes() as processes:
        processes.start_master()
        node = processes.start(
            "slam_toolbox",
            [
                program("slam_toolbox", "async_slam_toolbox_node"),
                "__name:=slam_toolbox",
                f"_map_file_name:={out / 'built'}",
                f"_autosave_file:={out / 'autosave.posegraph'}",
                "_autosave_interval:=10.0",
            ],
        )
        words = ["--first", str(first), "--rate", f"{RATE_HZ:g}", "--seconds", f"{plan.seconds:g}"]
        command = [sys.executable, "-m", "trident_benchmarks.slam.live_feeder", str(log), *words]
        feeder = processes.start("feeder", [*command, "--node", str(node.pid)])
        processes.finish("feeder", feeder, 60.0 + 2.0 * plan.seconds)
        lines = processes.log("feeder").read_text(encoding="utf-8").splitlines()
        processes.stop(node)
    return dict(json.loads(lines[-1]))


def table(row: dict[str, Any]) -> str:
    """The figures as Markdown."""
    lines = [
        f"| waits at {row['core']['nodes']} nodes, limit {LIMIT_MS:g} ms "
        "| scans | median [ms] | p99 [ms] | longest [ms] |",
        "|---|---|---|---|---|",
    ]
    waits = (
        ("scan to pose, in process", row["core"]["wait"]),
        ("scan to map -> odom, over ROS", row["node"]),
        ("snapshot for the map", row["core"]["map_snapshot"]),
        ("map, in its own thread", row["core"]["map"]),
        ("snapshot for a session", row["core"]["session_snapshot"]),
        ("session, in its own thread", row["core"]["session"]),
    )
    for name, one in waits:
        cells = [f"{one[key]:.1f}" for key in ("median_ms", "p99_ms", "max_ms")]
        lines.append(f"| {name} | {one['count']} | {' | '.join(cells)} |")
    core = row["core"]
    lines += [
        "",
        f"Whole graph optimised {core['realigned']} times meanwhile, {core['loops_after']} loops; "
        f"the last pose is {core['last_error_m']:.2f} m from the truth; "
        f"memory {core['rss_idle_mb']:.0f} MB, {core['rss_live_mb']:.0f} MB with all of that "
        f"running; node {row['node']['node_rss_mb']:.0f} MB.",
    ]
    if hour := row.get("hour"):
        lines.append(
            f"{hour['scans']} scans, {hour['nodes']} nodes: {hour['rss_before_mb']:.0f} MB before, "
            f"{hour['rss_after_mb']:.0f} MB after."
        )
    return "\n".join(lines)


def is_satisfied(row: dict[str, Any]) -> bool:
    """Whether no scan waited longer than the limit."""
    return bool(np.max([row["core"]["wait"]["max_ms"], row["node"]["max_ms"]]) <= LIMIT_MS)
