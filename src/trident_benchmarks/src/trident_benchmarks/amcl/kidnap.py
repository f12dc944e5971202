# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A robot that drives about an office, is carried off again and again, and must find itself.

What it measured is fed to amcl's core (the program amcl_replay), whose poses are compared with the
truth.
"""

from __future__ import annotations

import math
import subprocess
import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
from scipy import ndimage
from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import package_folder, program

from trident_benchmarks.datasets.recorded_drive import Floats, Noise, Recording, drive, relative

WORLD = "office"
WITHIN_M, WITHIN_RAD = 0.3, math.radians(10.0)
HELD_S = 5.0
LIMIT_S = 20.0
SETTLE_S = 10.0  # before the robot is carried off for the first time
APART_S = 27.0  # from one time to the next
_LIDAR_Z_M = 0.115
_CLEAR_M = 0.45  # about a place where the robot is put down
_MAX_OTHER_PLACE = 0.8  # of the score there, for a place that is unique in the map


@dataclass(frozen=True)
class Trial:
    """What came of carrying the robot off once.

    Attributes:
        seed: of the drive.
        carried_s: when [s].
        recovered_s: from then until the pose had been right for HELD_S; inf: not [s].
        error_m: median error while it was held [m].
    """

    seed: int
    carried_s: float
    recovered_s: float
    error_m: float

    @property
    def is_recovered(self) -> bool:
        """Within the limit."""
        return self.recovered_s <= LIMIT_S


class Office:
    """The world's true map on disk, and the places in it that are unlike any other.

    Attributes:
        map_file: YAML of the map.
    """

    def __init__(self, folder: Path, world: str = WORLD) -> None:
        """Cut the world at the lidar's height.

        Args:
            folder: where the map goes.
            world: name of a file in worlds/.
        """
        from trident_sim.occupancy import FREE, MapConfig, occupancy_map

        from trident_sim import SimulationWarning, World

        self.world_file = package_folder("trident_bringup") / "worlds" / f"{world}.world"
        self._params = package_folder("trident_bringup") / "config/localization/amcl.yaml"
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SimulationWarning)
            grid = occupancy_map(World(self.world_file), MapConfig(heights=(_LIDAR_Z_M,)))
        grid.save(folder / "office.pgm")
        self.map_file = folder / "office.yaml"
        clear = ndimage.distance_transform_edt(grid.cells == FREE) * grid.resolution
        rows, columns = np.nonzero(clear > _CLEAR_M)
        self._free = np.column_stack((columns, rows)) * grid.resolution + np.array(grid.origin)

    def replay(self, records: bytes) -> list[list[str]]:
        """What amcl_replay prints, in words.

        Raises:
            EvalError: it fails.
        """
        command = [
            program("trident_estimation", "amcl_replay"),
            str(self.map_file),
            str(self._params),
        ]
        done = subprocess.run(command, input=records, capture_output=True, check=False)
        if done.returncode != 0:
            raise EvalError(f"amcl_replay: {done.stderr.decode().strip()}")
        return [line.split() for line in done.stdout.decode().splitlines()]

    def unique_places(self, count: int, seed: int) -> Floats:
        """Places from which a scan fits nowhere else.

        Args:
            count: of places.
            seed: of the choice.

        Returns:
            x, y [m], yaw [rad], shape (count, 3).

        Raises:
            EvalError: too few of the free places are unique.
        """
        random = np.random.default_rng((seed, 1))
        found: list[Floats] = []
        for _ in range(20):
            chosen = self._free[random.integers(len(self._free), size=2 * count)]
            places = np.column_stack((chosen, random.uniform(-math.pi, math.pi, 2 * count)))
            rows = np.column_stack((np.full(len(places), 3.0), places))
            answers = self.replay(rows.tobytes())
            shares = np.array([float(answer[1]) for answer in answers])
            found += list(places[shares < _MAX_OTHER_PLACE])
            if len(found) >= count:
                return np.array(found[:count])
        raise EvalError(f"{self.world_file}: only {len(found)} unique places, {count} are wanted")


def records(recording: Recording) -> bytes:
    """A drive as amcl_replay reads it: where it begins, roughly, and its scans."""
    lidar = recording.lidar
    rows = [np.array([1.0, *recording.start, 0.02, 0.02, 0.01])]
    for sweep in recording.sweeps:
        row = [0.0, sweep.stamp, *sweep.begin, *relative(sweep.begin, sweep.end), 0.0, 0.0, 0.0]
        row += [lidar.angle_min, lidar.angle_increment, lidar.range_min, lidar.range_max]
        rows.append(np.array([*row, len(sweep.ranges), *sweep.ranges]))
    return b"".join(row.tobytes() for row in rows)


def judge(recording: Recording, poses: Floats, seed: int) -> list[Trial]:
    """Each time the robot was carried off.

    Args:
        recording: the drive.
        poses: x, y [m], yaw [rad] that amcl gave for each scan, shape (n, 3).
        seed: of the drive.
    """
    times = recording.truth[:, 0]
    away = np.linalg.norm(poses[:, :2] - recording.truth[:, 1:3], axis=1)
    turned = np.abs(
        np.remainder(poses[:, 2] - recording.truth[:, 3] + math.pi, 2 * math.pi) - math.pi
    )
    is_right = (away < WITHIN_M) & (turned < WITHIN_RAD)
    trials = []
    for begin in recording.carried_s:
        window = np.flatnonzero((times > begin) & (times < begin + APART_S))
        held = _first_held(times[window], is_right[window])
        recovered, error = math.inf, math.nan
        if held is not None:
            since = times[window[held]]
            recovered = float(since + HELD_S - begin)
            error = float(np.median(away[(times >= since) & (times <= since + HELD_S)]))
        trials.append(Trial(seed, begin, recovered, error))
    return trials


def _first_held(times: Floats, is_right: npt.NDArray[np.bool_]) -> int | None:
    """The first sample from which all are right for HELD_S; None if there is no such sample."""
    for first in np.flatnonzero(is_right):
        held = (times >= times[first]) & (times <= times[first] + HELD_S)
        if is_right[held].all() and times[-1] >= times[first] + HELD_S - 0.3:
            return int(first)
    return None


def run(office: Office, seed: int, times: int) -> list[Trial]:
    """One drive on which the robot is carried off some times.

    Raises:
        EvalError: amcl_replay fails.
    """
    places = office.unique_places(times + 1, seed)
    carried = [SETTLE_S + APART_S * i for i in range(times)]
    end_s = SETTLE_S + APART_S * times
    recording = drive(office.world_file, places, seed, end_s, Noise(), carried)
    words = office.replay(records(recording))
    return judge(recording, np.array([line[2:5] for line in words], float), seed)
