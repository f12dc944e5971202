# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The challenge's task over ROS: the simulator, move_base and a client of its action, in lockstep.

Odometry is that of the robot's drive. Success, time and contact are judged by the world's states,
as the runs in one process are.
"""

from __future__ import annotations

import csv
import math
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
from scipy.spatial.transform import Rotation
from trident_eval.core.errors import EvalError

from trident_benchmarks.nav.fields import (
    GOAL_AHEAD_M,
    GOAL_RADIUS_M,
    MOVED_M,
    START,
    TIME_LIMIT_S,
    Field,
)
from trident_benchmarks.nav.limits import RobotLimits
from trident_benchmarks.nav.trials import JACKAL, Outcome
from trident_benchmarks.processes import Processes

Floats = npt.NDArray[np.float64]

_LIMIT_S = 600.0  # wall time of a run
_BETWEEN = 10  # poses that contact is looked for at, per state
_PATIENCE_S = 60.0  # wall time that the world waits for move_base

_LAUNCH = """<launch>
  <rosparam param="/gazebo/answers/move_base">{{state: /odom, commands: [/cmd_vel]}}</rosparam>
  <param name="/gazebo/end_time" type="double" value="{end_s}"/>
  <param name="/gazebo/lockstep_timeout" type="double" value="{patience_s}"/>
  <include file="$(find trident_bringup)/launch/sim/world.launch">
    <arg name="world" value="{world}"/>
    <arg name="real_time_factor" value="0"/>
    <arg name="seed" value="{seed}"/>
    <arg name="out_dir" value="{out}"/>
    <arg name="paused" value="true"/>
  </include>
  <include file="$(find trident_bringup)/launch/robot/ground_robot.launch">
    <arg name="robot" value="{robot}"/>
    <arg name="x" value="{x}"/>
    <arg name="y" value="{y}"/>
    <arg name="yaw" value="{yaw}"/>
  </include>
  <node name="move_base" pkg="move_base" type="move_base" output="screen">
    {loads}
    <param name="lockstep" type="bool" value="true"/>
    <remap from="scan" to="{scan}"/>
  </node>
</launch>
"""


def launch_text(field_file: Path, out: Path, parameters: Sequence[Path], seed: int) -> str:
    """The launch file of a run."""
    x, y, yaw = START
    loads = "".join(f'<rosparam command="load" file="{file}"/>' for file in parameters)
    return _LAUNCH.format(
        end_s=TIME_LIMIT_S + 5.0,
        patience_s=_PATIENCE_S,
        world=field_file,
        seed=seed,
        out=out,
        x=x,
        y=y,
        yaw=yaw,
        loads=loads,
        scan=JACKAL.scan,
        robot=JACKAL.name,
    )


def touches(field: Field, footprint: Floats, poses: Floats) -> int | None:
    """The first of some poses at which a footprint reaches into a cylinder.

    Args:
        field: the world.
        footprint: corners of a rectangle along the robot's axes, shape (4, 2) [m].
        poses: x, y [m], yaw [rad], shape (n, 3).

    Returns:
        Its index, or None.
    """
    low, high = footprint.min(axis=0), footprint.max(axis=0)
    cylinders = np.array(field.cylinders).reshape(-1, 3)
    for i, (x, y, yaw) in enumerate(poses):
        offset = cylinders[:, :2] - (x, y)
        c, s = math.cos(yaw), math.sin(yaw)
        at = offset @ np.array([[c, -s], [s, c]])
        gap = np.linalg.norm(at - np.clip(at, low, high), axis=1)
        if np.any(gap < cylinders[:, 2]):
            return i
    return None


def judge(field: Field, footprint: Floats, t_s: Floats, poses: Floats, seed: int) -> Outcome:
    """What came of a run by the states of the robot.

    Args:
        field: the world.
        footprint: of the robot, shape (4, 2) [m].
        t_s: times, shape (n,).
        poses: x, y [m], yaw [rad], shape (n, 3).
        seed: of the run.
    """
    x, y, yaw = START
    goal = (x + GOAL_AHEAD_M * math.cos(yaw), y + GOAL_AHEAD_M * math.sin(yaw))
    begin = poses[0, :2]
    moved = np.flatnonzero(np.linalg.norm(poses[:, :2] - begin, axis=1) > MOVED_M)
    near = np.flatnonzero(np.linalg.norm(poses[:, :2] - goal, axis=1) < GOAL_RADIUS_M)
    end = int(near[0]) if len(near) else len(poses) - 1
    fine = np.linspace(0.0, end, end * _BETWEEN + 1)
    unwrapped = np.column_stack((poses[:, :2], np.unwrap(poses[:, 2])))
    between = np.column_stack(
        [np.interp(fine, np.arange(len(poses)), unwrapped[:, k]) for k in range(3)]
    )
    touched = touches(field, footprint, between)
    begin_s = float(t_s[moved[0]]) if len(moved) else float(t_s[0])
    last = end if touched is None else touched // _BETWEEN
    how = "reached" if len(near) else "timeout"
    track = tuple((float(a), float(b), float(c)) for a, b, c in poses[: last + 1])
    return Outcome(
        seed=seed,
        end=how if touched is None else "collided",
        time_s=float(t_s[last]) - begin_s,
        text="",
        recoveries=(),
        track=track,
        cpu_s=0.0,
    )


def read_poses(file: Path, name: str) -> tuple[Floats, Floats]:
    """Times and x, y [m], yaw [rad] of one model in a states.csv.

    Raises:
        EvalError: it cannot be read, or has no states of the model.
    """
    try:
        with file.open(encoding="utf-8", newline="") as stream:
            rows = [row for row in csv.DictReader(stream) if row["name"] == name]
            columns = ("t", "x", "y", "qx", "qy", "qz", "qw")
            values = np.array([[float(row[column]) for column in columns] for row in rows])
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise EvalError(f"{file}: {error}; legal: a states.csv") from error
    if not len(values):
        raise EvalError(f"{file}: no states of {name}")
    yaw = Rotation.from_quat(values[:, 3:]).as_euler("ZYX")[:, :1]
    return values[:, 0], np.column_stack((values[:, 1:3], yaw))


def run_field(field: Field, parameters: Sequence[Path], limits: RobotLimits, seed: int) -> Outcome:
    """One run.

    Args:
        field: the world.
        parameters: files of move_base; later ones win.
        limits: of the robot, for its footprint.
        seed: of all noise.

    Raises:
        EvalError: a process fails, or nothing was recorded.
    """
    with Processes() as running:
        world = running.folder / "field.world"
        world.write_text(field.sdf(), encoding="utf-8")
        out = running.folder / "out"
        out.mkdir()
        launch = running.folder / "barn.launch"
        launch.write_text(launch_text(world, out, parameters, seed), encoding="utf-8")
        running.start_master()
        stack = running.start("stack", ["roslaunch", "--disable-title", str(launch)])
        words = [f"/{JACKAL.scan}", "base_footprint", str(GOAL_AHEAD_M), "0.0", "0.0"]
        client = running.start(
            "client", [sys.executable, "-m", "trident_benchmarks.nav.first_goal", *words]
        )
        running.wait_until(
            lambda: client.poll() is not None or stack.poll() is not None, "a result", _LIMIT_S
        )
        running.stop_all()
        t_s, poses = read_poses(out / "states.csv", JACKAL.name)
    return judge(field, limits.corners, t_s, poses, seed)
