# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs of the program nav_trial: one process per core, one task each."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import package_folder, program

_LIMIT_S = 1800.0  # wall time of a task
_CONFIG = Path("config") / "nav"


@dataclass(frozen=True)
class Robot:
    """What a robot's tasks have in common.

    Attributes:
        name: of its xacro in trident_description, and of its file in config/nav/robots.
        lidar: the sensor that scans.
        scan: its topic.
        wheel_radius: as its odometry believes it [m].
        left: joints of the wheels of that side.
        right: joints of the wheels of that side.
    """

    name: str
    lidar: str
    scan: str
    wheel_radius: float
    left: tuple[str, ...]
    right: tuple[str, ...]


JACKAL = Robot(
    "jackal",
    "front_laser",
    "front/scan",
    0.098,
    ("front_left_wheel_joint", "rear_left_wheel_joint"),
    ("front_right_wheel_joint", "rear_right_wheel_joint"),
)


@dataclass(frozen=True)
class Task:
    """One world and where to go in it.

    Attributes:
        name: of the task, for error texts.
        world: SDF text.
        start: x, y [m], yaw [rad] in the world.
        goal: the same, from the start.
        time_limit_s: of a run.
        success_radius_m: of the goal by the truth; 0: move_base's own judgment.
        moved_m: from which on the time counts.
    """

    name: str
    world: str
    start: tuple[float, float, float]
    goal: tuple[float, float, float]
    time_limit_s: float
    success_radius_m: float
    moved_m: float


@dataclass(frozen=True)
class Outcome:
    """One run.

    Attributes:
        end: "reached", "collided", "timeout" or "aborted".
        time_s: since it had moved.
        text: what was touched, or why the goal was given up.
        recoveries: with their causes.
        track: x, y, yaw by the truth.
        cpu_s: of costmaps, planner and controller.
    """

    seed: int
    end: str
    time_s: float
    text: str
    recoveries: tuple[str, ...]
    track: tuple[tuple[float, float, float], ...]
    cpu_s: float

    @property
    def is_success(self) -> bool:
        """Whether the goal was reached without contact."""
        return self.end == "reached"


def default_parameters(robot: Robot) -> list[Path]:
    """The files of parameters of a robot without a map; later ones win."""
    folder = package_folder("trident_bringup") / _CONFIG
    names = ("costmaps.yaml", "move_base.yaml", "mapless.yaml", f"robots/{robot.name}.yaml")
    return [folder / name for name in names]


class Trials:
    """Runs tasks of one robot, as many at a time as there are jobs."""

    def __init__(self, robot: Robot, parameters: Sequence[Path], jobs: int | None) -> None:
        """Find the program.

        Raises:
            EvalError: it is not built.
        """
        self._program = program("trident_benchmarks", "nav_trial")
        self._robot = robot
        self._parameters = [str(file.resolve()) for file in parameters]
        self._jobs = jobs or len(os.sched_getaffinity(0))

    def run(
        self,
        tasks: Sequence[Task],
        seeds: Sequence[int],
        report: Callable[[Task, list[Outcome]], None],
    ) -> list[list[Outcome]]:
        """All seeds of all tasks, in the order of the tasks.

        Args:
            tasks: what to drive.
            seeds: of each.
            report: called with each task that is done, in their order.

        Raises:
            EvalError: a run could not be made.
        """
        from trident_sim import expand_xacro

        path = package_folder("trident_description") / "urdf" / f"{self._robot.name}.urdf.xacro"
        results = []
        with tempfile.TemporaryDirectory(prefix="trident_bench_") as name:
            folder = Path(name)
            (folder / "robot.urdf").write_text(expand_xacro(path), encoding="utf-8")
            with ThreadPoolExecutor(self._jobs) as pool:
                waiting = [pool.submit(self._run_one, folder, task, seeds) for task in tasks]
                try:
                    for task, future in zip(tasks, waiting, strict=True):
                        results.append(future.result())
                        report(task, results[-1])
                finally:
                    pool.shutdown(cancel_futures=True)
        return results

    def _run_one(self, folder: Path, task: Task, seeds: Sequence[int]) -> list[Outcome]:
        world = folder / f"{task.name}.world"
        world.write_text(task.world, encoding="utf-8")
        trial = folder / f"{task.name}.yaml"  # JSON is YAML, too
        trial.write_text(json.dumps(self._trial(folder, world, task, seeds)), encoding="utf-8")
        done = subprocess.run(
            ["setpriv", "--pdeathsig", "TERM", self._program, str(trial)],
            capture_output=True,
            text=True,
            check=False,
            timeout=_LIMIT_S,
        )
        if done.returncode != 0:
            last = (done.stderr.strip().splitlines() or ["no output"])[-1]
            raise EvalError(f"{task.name}: nav_trial ended with {done.returncode}: {last}")
        return [_outcome(json.loads(line)) for line in done.stdout.splitlines()]

    def _trial(self, folder: Path, world: Path, task: Task, seeds: Sequence[int]) -> dict[str, Any]:
        robot = self._robot
        return {
            "world": str(world),
            "robot": str(folder / "robot.urdf"),
            "robot_name": robot.name,
            "lidar": robot.lidar,
            "scan_topic": robot.scan,
            "parameters": self._parameters,
            "start": task.start,
            "goal": task.goal,
            "seeds": list(seeds),
            "time_limit_s": task.time_limit_s,
            "success_radius_m": task.success_radius_m,
            "moved_m": task.moved_m,
            "odometry": {
                "wheel_radius": robot.wheel_radius,
                "left_joints": robot.left,
                "right_joints": robot.right,
            },
        }


def _outcome(record: dict[str, Any]) -> Outcome:
    return Outcome(
        seed=int(record["seed"]),
        end=str(record["end"]),
        time_s=float(record["time_s"]),
        text=str(record["text"]),
        recoveries=tuple(record["recoveries"]),
        track=tuple((x, y, yaw) for x, y, yaw in record["track"]),
        cpu_s=float(record["navigation_cpu_s"]),
    )
