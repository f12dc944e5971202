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
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import package_folder, program

_LIMIT_S = 7200.0  # wall time of a task
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
        odometry: topic of the odometry that its drive computes; empty: wheels and a gyro.
        xacro_args: of its description.
    """

    name: str
    lidar: str
    scan: str
    wheel_radius: float = 0.1
    left: tuple[str, ...] = ()
    right: tuple[str, ...] = ()
    odometry: str = ""
    xacro_args: dict[str, str] = field(default_factory=dict)

    def urdf(self) -> str:
        """Its description.

        Raises:
            trident_sim.Error: it cannot be expanded.
        """
        from trident_sim import expand_xacro

        path = package_folder("trident_description") / "urdf" / f"{self.name}.urdf.xacro"
        return expand_xacro(path, **self.xacro_args)

    def keys(self, urdf: Path) -> dict[str, Any]:
        """What a trial says of its robot, whose description is in a file."""
        return {
            "robot": str(urdf),
            "robot_name": self.name,
            "lidar": self.lidar,
            "scan_topic": self.scan,
            "odometry": {
                "topic": self.odometry,
                "wheel_radius": self.wheel_radius,
                "left_joints": self.left,
                "right_joints": self.right,
            },
        }


@dataclass(frozen=True)
class MappingRobot(Robot):
    """my_nav_robot with the RPLidar A1 that maps are made with."""

    def urdf(self) -> str:
        """Its description.

        Raises:
            EvalError: it cannot be expanded.
        """
        from trident_benchmarks.datasets.recorded_drive import description

        return description()


JACKAL = Robot(
    "jackal",
    "front_laser",
    "front/scan",
    0.098,
    ("front_left_wheel_joint", "rear_left_wheel_joint"),
    ("front_right_wheel_joint", "rear_right_wheel_joint"),
)
_ENCODERS = {"odometry_source": "encoder"}
MY_NAV_ROBOT = MappingRobot("my_nav_robot", "laser_link", "scan", odometry="odom")
BURGER = Robot("turtlebot3_burger", "base_scan", "scan", odometry="odom", xacro_args=_ENCODERS)
WAFFLE = Robot("turtlebot3_waffle", "base_scan", "scan", odometry="odom", xacro_args=_ENCODERS)
UGV = Robot("tutorial_ugv", "laser_link", "scan", odometry="odom", xacro_args=_ENCODERS)
CAR = Robot("ackermann_car", "laser_link", "scan", odometry="odom", xacro_args=_ENCODERS)

ROBOTS = (MY_NAV_ROBOT, BURGER, WAFFLE, JACKAL, UGV, CAR)


def scan_topic_of(robot: str) -> str:
    """The topic of a robot's lidar; "scan" for a robot that is not known."""
    return next((known.scan for known in ROBOTS if known.name == robot), "scan")


@dataclass(frozen=True)
class KnownMap:
    """What a robot knows of the world.

    Attributes:
        file: YAML file of the map.
        pose: x, y [m], yaw [rad] of the map's frame in the world.
        localization: "amcl" or "truth".
        amcl: file of amcl's parameters; None: the default ones.
        start_sigma: spread of the start that amcl is given: x, y [m], yaw [rad].
    """

    file: Path
    pose: tuple[float, float, float]
    localization: str = "amcl"
    amcl: Path | None = None
    start_sigma: tuple[float, float, float] = (0.1, 0.1, 0.05)

    def record(self) -> dict[str, Any]:
        """As the program has it."""
        default = package_folder("trident_bringup") / "config" / "localization" / "amcl.yaml"
        return {
            "file": str(self.file.resolve()),
            "pose": self.pose,
            "localization": self.localization,
            "amcl": str(self.amcl or default),
            "start_sigma": self.start_sigma,
        }


@dataclass(frozen=True)
class Task:
    """One world and where to go in it.

    Attributes:
        name: of the task, for error texts.
        world: SDF text.
        start: x, y [m], yaw [rad] in the world.
        goal: the same, from the start.
        time_limit_s: of a goal.
        success_radius_m: of the goal by the truth; 0: move_base's own judgment.
        moved_m: from which on the time counts.
        goals: one after the other, in the world; none: `goal`.
        extra: further keys of the program's configuration.
    """

    name: str
    world: str
    start: tuple[float, float, float]
    goal: tuple[float, float, float]
    time_limit_s: float
    success_radius_m: float
    moved_m: float
    goals: tuple[tuple[float, float, float], ...] = ()
    extra: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class GoalOutcome:
    """One goal of a run.

    Attributes:
        goal: x, y [m], yaw [rad] in the world.
        end: "reached", "collided", "timeout" or "aborted".
        text: why it was given up.
        time_s: since it was given.
        position_error_m: by the truth, at the end.
        heading_error_rad: by the truth, at the end.
        touched: what was touched first; empty: nothing.
        recoveries: how many.
    """

    goal: tuple[float, float, float]
    end: str
    text: str
    time_s: float
    position_error_m: float
    heading_error_rad: float
    touched: str
    recoveries: int


@dataclass(frozen=True)
class Outcome:
    """One run.

    Attributes:
        seed: of its noise.
        end: "reached", "collided", "timeout" or "aborted".
        time_s: since it had moved.
        text: what was touched, or why the goal was given up.
        recoveries: with their causes.
        track: x, y, yaw by the truth.
        cpu_s: of costmaps, planner and controller.
        goals: each that was tried.
        localization_error_m: the greatest one at the end of a goal.
        least_speed_m_s: by odometry; negative: backwards.
        odometry_error_m: of the position that odometry has, at the end.
    """

    seed: int
    end: str
    time_s: float
    text: str
    recoveries: tuple[str, ...]
    track: tuple[tuple[float, float, float], ...]
    cpu_s: float
    goals: tuple[GoalOutcome, ...] = ()
    localization_error_m: float = 0.0
    least_speed_m_s: float = 0.0
    odometry_error_m: float = 0.0

    @property
    def is_success(self) -> bool:
        """Whether the goal was reached without contact."""
        return self.end == "reached"


def failures(runs: Sequence[Outcome]) -> list[str]:
    """What came of the runs that were no success, in words."""
    return [f"seed {run.seed}: {run.end}: {run.text}" for run in runs if not run.is_success]


def recoveries(runs: Sequence[Outcome]) -> int:
    """Of all runs together."""
    return sum(len(run.recoveries) for run in runs)


def default_parameters(robot: Robot, has_map: bool = False) -> list[Path]:
    """The files of parameters of a robot; later ones win."""
    folder = package_folder("trident_bringup") / _CONFIG
    names = ["costmaps.yaml", "move_base.yaml", "repeatable.yaml"]
    names += [] if has_map else ["mapless.yaml"]
    names.append(f"robots/{robot.name}.yaml")
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
        results = []
        with tempfile.TemporaryDirectory(prefix="trident_bench_") as name:
            folder = Path(name)
            (folder / "robot.urdf").write_text(self._robot.urdf(), encoding="utf-8")
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
        keys = self._robot.keys(folder / "robot.urdf") | {
            "world": str(world),
            "parameters": self._parameters,
            "start": task.start,
            "goal": task.goal,
            "seeds": list(seeds),
            "time_limit_s": task.time_limit_s,
            "success_radius_m": task.success_radius_m,
            "moved_m": task.moved_m,
            "goals": task.goals,
        }
        return keys | task.extra


def _outcome(record: dict[str, Any]) -> Outcome:
    return Outcome(
        seed=int(record["seed"]),
        end=str(record["end"]),
        time_s=float(record["time_s"]),
        text=str(record["text"]),
        recoveries=tuple(record["recoveries"]),
        track=tuple((x, y, yaw) for x, y, yaw in record["track"]),
        cpu_s=float(record["navigation_cpu_s"]),
        goals=tuple(_goal_outcome(one) for one in record["goals"]),
        localization_error_m=float(record["localization_error_m"]),
        least_speed_m_s=float(record["least_speed_m_s"]),
        odometry_error_m=float(record["odometry_error_m"]),
    )


def _goal_outcome(record: dict[str, Any]) -> GoalOutcome:
    x, y, yaw = record["goal"]
    values = {key: value for key, value in record.items() if key != "goal"}
    return GoalOutcome(goal=(x, y, yaw), **values)
