# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a robot measures on a simulated drive through a building.

The simulator drives my_nav_robot with the rates of an RPLidar A1, without ROS.
"""

from __future__ import annotations

import math
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import numpy as np
import numpy.typing as npt
from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import package_folder

if TYPE_CHECKING:
    from trident_sim import LaserScanSample

Floats = npt.NDArray[np.float64]

_MY_LIDAR = '<xacro:lidar_2d link="laser_link" parent="base_link" x="0" y="0" z="0.06"/>'
_RPLIDAR_A1 = (
    '<xacro:lidar_2d link="laser_link" parent="base_link" x="0" y="0" z="0.06" samples="360" '
    'max_angle="${2 * pi * 359 / 360}" min_range="0.15" max_range="12" sigma="0" rate="5.5" '
    'plugin="libtrident_lidar.so"/>'  # its noise is added here: its spread grows with the range
)


@dataclass(frozen=True)
class Noise:
    """Errors that are added to what the simulator measures.

    Attributes:
        range_m, range_share: the spread of a range is the larger one of both [m, share].
        distance, turn: odometry's scale errors [share]; their signs are the seed's.
        yaw_walk: random walk of the heading [rad per root of a metre].
    """

    range_m: float = 0.01
    range_share: float = 0.01
    distance: float = 0.02
    turn: float = 0.02
    yaw_walk: float = math.radians(0.5)


@dataclass(frozen=True)
class Lidar:
    """What its scans have in common: angles [rad], limits [m], time between beams [s]."""

    angle_min: float
    angle_increment: float
    range_min: float
    range_max: float
    time_increment: float


@dataclass(frozen=True)
class Sweep:
    """One scan with its odometry.

    Attributes:
        stamp: of the first beam [s].
        ranges: with noise; infinite where nothing was hit [m], shape (n,).
        begin, end: odometry's poses (x, y, yaw) at the first beam and after the last one.
    """

    stamp: float
    ranges: Floats
    begin: Floats
    end: Floats


@dataclass(frozen=True)
class Recording:
    """One drive.

    Attributes:
        lidar: sits on the base's origin and looks ahead.
        sweeps: the scans.
        truth: time [s], x, y [m], yaw [rad] of each scan, shape (n, 4).
        start: true x, y, yaw at the begin of the drive.
        carried_s: when the robot was carried off.
    """

    lidar: Lidar
    sweeps: tuple[Sweep, ...]
    truth: Floats
    start: Floats
    carried_s: tuple[float, ...] = ()


class Pilot(Protocol):
    """Who drives."""

    @property
    def is_done(self) -> bool:
        """The drive is over."""

    def command(
        self, time_s: float, pose: Floats, scan: LaserScanSample | None
    ) -> tuple[float, float] | None:
        """Speed [m/s] and turn rate [rad/s], or None to continue as before.

        Args:
            time_s: now [s].
            pose: true x, y, yaw.
            scan: one that came just now.
        """


class Wanderer:
    """Drives about by the lidar alone, without an end."""

    is_done = False

    def __init__(self, seed: int) -> None:
        from trident_nav.core.wander import Wander, WanderConfig

        self._wander = Wander(WanderConfig(seed=seed))

    def command(
        self, time_s: float, pose: Floats, scan: LaserScanSample | None
    ) -> tuple[float, float] | None:
        """As Pilot says."""
        del time_s, pose
        if scan is None:
            return None
        angles = scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges))
        v, w = self._wander.command(scan.stamp, angles, scan.ranges.astype(float))
        return v, w


def description() -> str:
    """URDF of my_nav_robot with an RPLidar A1.

    Raises:
        EvalError: the robot's own lidar is not where it was, or xacro fails.
    """
    urdf = package_folder("trident_description") / "urdf"
    text = (urdf / "my_nav_robot.urdf.xacro").read_text(encoding="utf-8")
    if _MY_LIDAR not in text:
        raise EvalError("my_nav_robot.urdf.xacro: its lidar is not described as it was")
    text = text.replace(_MY_LIDAR, _RPLIDAR_A1)
    for part in ("parts.xacro", "sensors.xacro"):
        text = text.replace(f'filename="{part}"', f'filename="{urdf / part}"')
    with tempfile.NamedTemporaryFile("w", suffix=".urdf.xacro", encoding="utf-8") as file:
        file.write(text)
        file.flush()
        command = [str(package_folder("xacro") / "xacro"), file.name]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise EvalError(f"xacro: {done.stderr.strip()}")
    return done.stdout


def compose(a: Floats, b: Floats) -> Floats:
    """T_a * T_b of poses (x, y, yaw)."""
    c, s = math.cos(a[2]), math.sin(a[2])
    return np.array([a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], a[2] + b[2]])


def relative(a: Floats, b: Floats) -> Floats:
    """T_a^-1 * T_b of poses (x, y, yaw); the turn in [-pi, pi]."""
    c, s = math.cos(a[2]), math.sin(a[2])
    x, y = b[:2] - a[:2]
    turn = math.remainder(b[2] - a[2], 2.0 * math.pi)
    return np.array([c * x + s * y, c * y - s * x, turn])


class Odometry:
    """The encoders' poses with drift on top."""

    def __init__(self, noise: Noise, seed: int) -> None:
        self._random = np.random.default_rng((seed, 2))
        signs = self._random.choice([-1.0, 1.0], 2)
        self._distance_scale, self._turn = 1.0 + signs * (noise.distance, noise.turn)
        self._walk = noise.yaw_walk
        self._last: Floats | None = None
        self._pose = np.zeros(3)
        self.times: list[float] = []
        self.poses: list[Floats] = []

    def add(self, time_s: float, pose: Floats) -> None:
        """An encoder pose (x, y, yaw)."""
        if self._last is not None:
            x, y, turn = relative(self._last, pose)
            walk = self._walk * math.sqrt(math.hypot(x, y)) * self._random.standard_normal()
            scale = self._distance_scale
            step = np.array([scale * x, scale * y, self._turn * turn + walk])
            self._pose = compose(self._pose, step)
        self._last = pose
        self.times.append(time_s)
        self.poses.append(self._pose)

    def at(self, times: Floats) -> Floats:
        """Poses at some times, shape (n, 3)."""
        poses = np.array(self.poses)
        return np.column_stack([np.interp(times, self.times, column) for column in poses.T])


def _yaw(q: Floats) -> float:
    return math.atan2(2.0 * (q[3] * q[2] + q[0] * q[1]), 1.0 - 2.0 * (q[1] ** 2 + q[2] ** 2))


def drive(
    world_file: Path,
    places: Floats,
    seed: int,
    end_s: float,
    noise: Noise,
    carried: Sequence[float] = (),
    pilot: Pilot | None = None,
) -> Recording:
    """Drive from the first place, and be carried off to each of the others.

    Args:
        world_file: SDF of the building.
        places: x, y, yaw [m, rad, world], shape (n, 3).
        seed: of all that is left to chance.
        end_s: of the drive at the latest [s].
        noise: of sensors.
        carried: when the robot is carried off to places[1], places[2] ... [s].
        pilot: who drives; None: a Wanderer.
    """
    import trident_sim

    world = trident_sim.World(world_file, seed=seed)
    x, y, yaw = places[0]
    world.spawn("robot", urdf=description(), namespace="", pose=(x, y, 0.0, 0.0, 0.0, yaw))
    robot = world.model("robot")
    scans, encoders = world.ports["scan"], world.ports["odom"]
    scans.subscribe()
    encoders.subscribe()
    pilot, odometry = pilot or Wanderer(seed), Odometry(noise, seed)
    due = list(zip(carried, places[1:], strict=True))
    truth: list[tuple[float, float, float, float]] = []
    taken: list[LaserScanSample] = []
    while world.time < end_s and not pilot.is_done:
        if due and world.time >= due[0][0]:
            x, y, yaw = due.pop(0)[1]
            robot.set_pose((x, y, float(robot.position[2]), 0.0, 0.0, yaw))
        world.step(10)
        truth.append((world.time, *robot.position[:2], _yaw(robot.orientation)))
        sample = encoders.read()
        if sample is not None:
            pose = np.array([*sample.position[:2], _yaw(sample.orientation)])
            odometry.add(sample.stamp, pose)
        scan = scans.read()
        if scan is not None:
            taken.append(scan)
        velocity = pilot.command(world.time, np.array(truth[-1][1:]), scan)
        if velocity is not None:
            v, w = velocity
            world.ports["cmd_vel"].write(trident_sim.TwistCommand((v, 0, 0), (0, 0, w)))
    return _recording(taken, odometry, np.array(truth), tuple(carried), noise, seed)


def _recording(
    taken: Sequence[LaserScanSample],
    odometry: Odometry,
    truth: Floats,
    carried: tuple[float, ...],
    noise: Noise,
    seed: int,
) -> Recording:
    random = np.random.default_rng((seed, 3))
    sweeps = []
    begin = np.array([scan.stamp for scan in taken])
    took = np.array([scan.time_increment * len(scan.ranges) for scan in taken])
    at_begin, at_end = odometry.at(begin), odometry.at(begin + took)
    for i, scan in enumerate(taken):
        ranges = scan.ranges.astype(float)
        is_hit = np.isfinite(ranges)
        spread = np.maximum(noise.range_m, noise.range_share * ranges[is_hit])
        ranges[is_hit] += spread * random.standard_normal(len(spread))
        sweeps.append(Sweep(scan.stamp, ranges, at_begin[i], at_end[i]))
    scan = taken[0]
    lidar = Lidar(
        scan.angle_min, scan.angle_increment, scan.range_min, scan.range_max, scan.time_increment
    )
    yaw = np.unwrap(truth[:, 3])
    columns = [np.interp(begin, truth[:, 0], c) for c in (truth[:, 1], truth[:, 2], yaw)]
    poses = np.column_stack((begin, *columns))
    return Recording(lidar, tuple(sweeps), poses, truth[0, 1:], carried)
