# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""CARMEN logs with odometry that errs, a laser that is configured elsewhere, or worse scans."""

from __future__ import annotations

import bz2
import gzip
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

import numpy as np
from trident_eval.core.errors import EvalError
from trident_eval.core.tracks import Array
from trident_eval.slam.trajectory import Trajectory

#: What a SICK reports where it hits nothing [m].
NOTHING = 81.83
_MESSAGE = "FLASER"
_POSES = 6  # numbers: the laser's pose and the base's


@dataclass(frozen=True)
class Change:
    """What is done to a log; the defaults leave it as it is.

    Attributes:
        scale: of odometry's distances.
        turn: of its turns.
        drift: false turn that odometry reports [rad per metre ahead].
        laser: error of the mount, the nominal laser's pose in the true laser's frame:
            x, y [m], yaw [rad].
        every_beam, every_scan: of so many one is kept.
        farthest: returns beyond it are lost [m].
        noise: standard deviation of what is added to ranges [m].
    """

    scale: float = 1.0
    turn: float = 1.0
    drift: float = 0.0
    laser: tuple[float, float, float] = (0.0, 0.0, 0.0)
    every_beam: int = 1
    every_scan: int = 1
    farthest: float = NOTHING
    noise: float = 0.0


def pose_matrix(x: float, y: float, yaw: float) -> Array:
    """A pose in the plane as a matrix, shape (3, 3)."""
    c, s = np.cos(yaw), np.sin(yaw)
    return np.array([[c, -s, x], [s, c, y], [0.0, 0.0, 1.0]])


def _numbers(T: Array) -> tuple[float, float, float]:
    return float(T[0, 2]), float(T[1, 2]), float(np.arctan2(T[1, 0], T[0, 0]))


def _motion(odometry_motion: Array, change: Change) -> Array:
    """A motion between two scans (3, 3) as odometry that errs reports it.

    Distance, turn and drift belong to the arc that leads there, so that it does not matter how
    finely the log is sampled.
    """
    x, y, yaw = _numbers(odometry_motion)
    half = 0.5 * yaw
    scale_of_arc = half / np.tan(half) if abs(half) > 1e-6 else 1.0
    ahead, aside = scale_of_arc * x + half * y, scale_of_arc * y - half * x
    turned = change.turn * yaw + change.drift * ahead
    ahead, aside = change.scale * ahead, change.scale * aside
    sine = np.sin(turned) / turned if abs(turned) > 1e-6 else 1.0
    bow = (1.0 - np.cos(turned)) / turned if abs(turned) > 1e-6 else 0.5 * turned
    return pose_matrix(sine * ahead - bow * aside, bow * ahead + sine * aside, turned)


def _open(path: Path) -> TextIO:
    opener = {".bz2": bz2.open, ".gz": gzip.open}.get(path.suffix, open)
    try:
        return opener(path, "rt", encoding="utf-8", errors="replace")
    except OSError as error:
        raise EvalError(f"{path}: {error.strerror}; legal: a CARMEN log") from error


def _scans(path: Path) -> Iterator[tuple[Array, Array, Array, list[str]]]:
    """Ranges [m], pose of laser and base (3, 3), and what follows, of every scan."""
    with _open(path) as log:
        for line in log:
            words = line.split()
            if not words or words[0] != _MESSAGE:
                continue
            count = int(words[1])
            values = np.array(words[2 : 2 + count + _POSES], float)
            laser, base = values[count : count + 3], values[count + 3 :]
            yield values[:count], pose_matrix(*laser), pose_matrix(*base), words[2 + values.size :]


def _seen(ranges: Array, change: Change, dice: np.random.Generator) -> list[str]:
    """The beams that are kept, as far as the changed laser sees, with its noise."""
    seen = np.where(ranges > change.farthest, NOTHING, ranges)
    is_return = seen < NOTHING - 1.0
    seen = np.where(is_return, seen + dice.normal(0.0, change.noise, len(seen)), seen)
    return [f"{max(value, 0.0):.3f}" for value in seen[:: change.every_beam]]


def write_changed(path: Path, change: Change, out: Path) -> Array:
    """Write the FLASER messages of a log, changed; the same change gives the same bytes.

    Returns:
        T_told_base_true, shape (3, 3): where the base is in the frame of what SLAM will take for
        it, because the laser is configured elsewhere.

    Raises:
        EvalError: the log cannot be read or has no FLASER message.
    """
    dice = np.random.default_rng(1)
    offset = pose_matrix(*change.laser)
    T_base_laser = before = None
    odometry = np.eye(3)
    with out.open("w", encoding="utf-8") as file, _open(path) as log:
        file.writelines(line for line in log if line.startswith("PARAM"))
        for number, (ranges, laser, base, rest) in enumerate(_scans(path)):
            if before is None or T_base_laser is None:
                T_base_laser, odometry = np.linalg.inv(base) @ laser, base
            else:
                odometry = odometry @ _motion(np.linalg.inv(before) @ base, change)
            before = base
            if number % change.every_scan != 0:
                continue
            shown = _seen(ranges, change, dice)
            odometry_motion = odometry @ T_base_laser @ offset
            poses = [f"{value:.6f}" for T in (odometry_motion, odometry) for value in _numbers(T)]
            file.write(" ".join([_MESSAGE, str(len(shown)), *shown, *poses, *rest]) + "\n")
    if T_base_laser is None:
        raise EvalError(f"{path}: has no {_MESSAGE} message; legal: a CARMEN log of one laser")
    return np.asarray(T_base_laser @ offset @ np.linalg.inv(T_base_laser))


def as_true_base(trajectory: Trajectory, T_nominal_true: Array) -> Trajectory:
    """Where the base was in truth, of poses of what SLAM took for it; (3, 3) of write_changed."""
    x, y, turn = _numbers(T_nominal_true)
    yaw = trajectory.yaw
    c, s = np.cos(yaw), np.sin(yaw)
    return Trajectory.planar(
        trajectory.stamp,
        trajectory.p[:, 0] + c * x - s * y,
        trajectory.p[:, 1] + s * x + c * y,
        yaw + turn,
    )
