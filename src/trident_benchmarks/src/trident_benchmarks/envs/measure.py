# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the benchmark of environments: speed, resets, memory, repeated episodes, learning."""

from __future__ import annotations

import argparse
import gc
import re
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import package_folder
from trident_sim.envs import trident_formation_v0, trident_search_v0

import trident_sim
from trident_benchmarks.results import check_folder, keep_rows, limits_code, new_document

_RUNS = 3
_HOVER_PER_S, _SEARCH_PER_S = 70_000.0, 4_000.0
_RESETS, _GROWTH_MB = 1_000, 1.0
_LEARN_S, _HOVERS = 150.0, 0.9
_VECTOR = 64
_REPEATED = """
import gymnasium, numpy as np, trident_sim.envs
env = gymnasium.make("trident/Hover-v0", randomization={"mass": (0.8, 1.2), "wind": 3.0})
env.reset(seed=11)
random = np.random.default_rng(1)
for _ in range(300):
    action = random.uniform(-0.1, 0.1, 6).astype(np.float32)
    *_, ended, cut, info = env.step(action)
    if ended or cut:
        env.reset()
print(info["state_hash"])
"""


def speed_row(name: str, steps: int, limit: float = 0.0) -> dict[str, Any]:
    """Steps of an environment of Gymnasium in a CPU second, with resets; median of three."""
    env = gymnasium.make(f"trident/{name}-v0")
    action = np.zeros(env.action_space.shape, np.float32)  # type: ignore[arg-type]

    def roll() -> None:
        env.reset(seed=1)
        for _ in range(steps):
            _, _, ended, cut, _ = env.step(action)
            if ended or cut:
                env.reset()

    return _row(name, steps, _per_cpu_s(roll, steps), limit)


def bare_row(steps: int) -> dict[str, Any]:
    """Step and odometry of the same vehicle through `World`, to compare with."""
    world = trident_sim.World("package://rotors_gazebo/worlds/basic.world", timing="direct")
    world.spawn("uav", urdf=trident_sim.multirotor("uav", controlled=False), pose=(0, 0, 0.1))
    odometry = world.ports["uav/odometry_sensor1/odometry"]
    odometry.subscribe()

    def roll() -> None:
        for _ in range(steps):
            world.step()
            odometry.value  # noqa: B018

    return _row("bare step and odometry", steps, _per_cpu_s(roll, steps), 0.0)


def vector_row(steps: int) -> dict[str, Any]:
    """Steps of 64 worlds in a second of wall time, on all cores."""
    envs = gymnasium.make_vec("trident/Hover-v0", num_envs=_VECTOR, hashes=False)
    actions = np.zeros((_VECTOR, 6), np.float32)
    envs.reset(seed=1)
    rounds = max(steps // _VECTOR, 1)
    rates = []
    for _ in range(_RUNS):
        begin = time.perf_counter()
        for _ in range(rounds):
            envs.step(actions)
        rates.append(rounds * _VECTOR / (time.perf_counter() - begin))
    return _row(f"Hover, vector of {_VECTOR}", rounds * _VECTOR, float(np.median(rates)), 0.0)


def team_row(name: str, env: Any, steps: int, limit: float = 0.0) -> dict[str, Any]:
    """Steps of a whole team in a CPU second, under random actions."""
    random = np.random.default_rng(1)
    shape = env.action_space(env.possible_agents[0]).shape
    draws = random.uniform(-1.0, 1.0, (50, len(env.possible_agents), *shape)).astype(np.float32)

    def roll() -> None:
        for step in range(steps):
            if not env.agents:
                env.reset(seed=step)
            env.step(dict(zip(env.agents, draws[step // 20 % 50], strict=True)))

    return _row(name, steps, _per_cpu_s(roll, steps), limit)


def reset_row(resets: int) -> dict[str, Any]:
    """Resets in a CPU second, and by how much they make the process larger."""
    env = gymnasium.make("trident/Hover-v0", randomization={"mass": (0.8, 1.2), "wind": 3.0})
    action = np.zeros(6, np.float32)

    def roll(count: int) -> None:
        for seed in range(count):
            env.reset(seed=seed)
            env.step(action)

    roll(resets)
    gc.collect()
    before_mb, begin = _resident_mb(), time.process_time()
    roll(resets)
    per_s = resets / (time.process_time() - begin)
    gc.collect()
    growth_mb = _resident_mb() - before_mb
    return {
        "row": "resets",
        "resets": resets,
        "per_cpu_s": per_s,
        "growth_mb": growth_mb,
        "passed": growth_mb <= _GROWTH_MB,
    }


def repeated_row() -> dict[str, Any]:
    """The hash at the end of 300 steps, in two processes."""
    hashes = {_output(["-c", _REPEATED]).strip() for _ in range(2)}
    return {"row": "same hash in two processes", "hashes": len(hashes), "passed": len(hashes) == 1}


def learning_row(seconds: float, generations: int = 1000) -> dict[str, Any]:
    """The example that learns to hover: its mean return, and from which share of starts it does."""
    example = package_folder("trident_sim_py") / "examples" / "learn_to_hover.py"
    begin = time.perf_counter()
    limits = ["--seconds", f"{seconds:g}", "--generations", str(generations)]
    text = _output([str(example), *limits])
    wall_s = time.perf_counter() - begin
    returns = [float(value) for value in re.findall(r"mean return +(-?[0-9.]+)", text)]
    share = re.search(r"hovers from (\d+)% of starts", text)
    if share is None or len(returns) < 3:
        raise EvalError(f"{example} printed no result:\n{text}")
    hovers = int(share[1]) / 100.0
    return {
        "row": "learn to hover",
        "wall_s": wall_s,
        "generations": len(returns) - 1,
        "first_return": returns[0],
        "last_return": returns[-1],
        "hovers": hovers,
        "passed": hovers >= _HOVERS and wall_s <= 180.0,
    }


def _per_cpu_s(roll: Callable[[], None], steps: int) -> float:
    rates = []
    for _ in range(_RUNS):
        begin = time.process_time()
        roll()
        rates.append(steps / (time.process_time() - begin))
    return float(np.median(rates))


def _row(name: str, steps: int, per_s: float, limit: float) -> dict[str, Any]:
    row = {"row": name, "steps": steps, "per_s": per_s, "us": 1e6 / per_s, "limit_per_s": limit}
    return row | {"passed": per_s >= limit}


def _resident_mb() -> float:
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * 4096 / 2**20


def _output(words: list[str]) -> str:
    result = subprocess.run([sys.executable, *words], capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise EvalError(f"{words[0]} failed:\n{result.stderr}")
    return result.stdout


def line(row: dict[str, Any]) -> str:
    """A row as one line."""
    parts = [
        f"{key} {value:.5g}" if isinstance(value, float) else f"{key} {value}"
        for key, value in row.items()
        if key not in ("row", "passed") and value != 0.0
    ]
    return f"{row['row']}: {', '.join(parts)}" + ("" if row["passed"] else " (limit missed)")


def rows_of(quick: bool) -> list[Callable[[], dict[str, Any]]]:
    """All of them, each measured when it is called."""
    part = 10 if quick else 1
    return [
        lambda: bare_row(60_000 // part),
        lambda: speed_row("Hover", 60_000 // part, _HOVER_PER_S),
        lambda: speed_row("Waypoints", 30_000 // part),
        lambda: speed_row("DockBoat", 3_000 // part),
        lambda: speed_row("DriveRoom", 1_500 // part),
        lambda: vector_row(200_000 // part),
        lambda: team_row(
            "trident_formation_v0, four vehicles",
            trident_formation_v0.parallel_env(),
            10_000 // part,
        ),
        lambda: team_row(
            "trident_search_v0, three robots",
            trident_search_v0.parallel_env(),
            6_000 // part,
            _SEARCH_PER_S,
        ),
        lambda: reset_row(_RESETS),
        repeated_row,
        lambda: learning_row(15.0 if quick else _LEARN_S),
    ]


def measure(options: argparse.Namespace) -> int:
    """All rows; the exit code."""
    check_folder(options.out)
    document = new_document() | {"rows": []}
    keep_rows((make() for make in rows_of(options.quick)), line, options.out, document)
    return limits_code(document)
