# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Trajectories in the TUM format, and what is true at their stamps."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation, Slerp

from trident_eval.core.errors import EvalError
from trident_eval.core.tracks import Array

_MIN_QUATERNION_NORM = 0.5
_STAMP_DIGIT = 1e-6  # of TUM files [s]


@dataclass(frozen=True)
class Trajectory:
    """Poses T_map_base with their stamps, in the order of the file.

    Attributes:
        stamp: labels [s], shape (N,); they may repeat and go backwards.
        p: positions [m], shape (N, 3).
        R: attitudes, N of them.
    """

    stamp: Array
    p: Array
    R: Rotation

    def __len__(self) -> int:
        return len(self.stamp)

    def select(self, index: NDArray[Any]) -> Trajectory:
        """Some of the poses, shape (M,) of indices or (N,) of booleans."""
        return Trajectory(self.stamp[index], self.p[index], self.R[index])

    @property
    def yaw(self) -> Array:
        """Headings [rad], shape (N,)."""
        return np.asarray(self.R.as_euler("ZYX")[:, 0])

    @staticmethod
    def planar(stamp: Array, x: Array, y: Array, yaw: Array) -> Trajectory:
        """Poses in the plane; four arrays of shape (N,)."""
        p = np.column_stack([x, y, np.zeros(len(stamp))])
        return Trajectory(np.asarray(stamp, float), p, Rotation.from_euler("Z", yaw))


def read_numbers(path: Path, columns: int, meaning: str) -> Array:
    """The rows of a text file of numbers; `#` begins a comment.

    Returns:
        Shape (N, columns), N >= 1.

    Raises:
        EvalError: unreadable, empty, or a row that is not `columns` finite numbers.
    """
    rows = []
    for number, line in enumerate(_read_lines(path, meaning), start=1):
        words = line.partition("#")[0].replace(",", " ").split()
        if not words:
            continue
        row = _row(words, f"{path}:{number}", meaning)
        if len(row) != columns or not np.isfinite(row).all():
            raise EvalError(f"{path}:{number}: {line.strip()!r} is not legal; legal: {meaning}")
        rows.append(row)
    if not rows:
        raise EvalError(f"{path}: has no row; legal: {meaning}")
    return np.array(rows)


def _row(words: list[str], where: str, meaning: str) -> list[float]:
    try:
        return [float(word) for word in words]
    except ValueError as error:
        raise EvalError(f"{where}: {error}; legal: {meaning}") from error


def _read_lines(path: Path, meaning: str) -> list[str]:
    if path.exists() and not path.is_file():
        raise EvalError(f"{path}: no file; legal: {meaning}")
    try:
        return path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise EvalError(f"{path}: {error}; legal: {meaning}") from error


def read_tum(path: Path) -> Trajectory:
    """Read a trajectory, one pose per line.

    Raises:
        EvalError: a line that is not `stamp x y z qx qy qz qw`.
    """
    rows = read_numbers(path, 8, "lines `stamp x y z qx qy qz qw`")
    norms = np.linalg.norm(rows[:, 4:], axis=1)
    if bad := np.flatnonzero(norms < _MIN_QUATERNION_NORM).tolist():
        raise EvalError(f"{path}: pose {bad[0] + 1} has a quaternion of norm {norms[bad[0]]:.3g}")
    return Trajectory(rows[:, 0], rows[:, 1:4], Rotation.from_quat(rows[:, 4:]))


def interpolated(truth: Trajectory, stamp: Array) -> tuple[Trajectory, Array]:
    """Poses of a trajectory at other stamps.

    Args:
        truth: with increasing stamps; repeated ones are taken once.
        stamp: [s], shape (M,).

    Returns:
        The poses for those stamps that lie within the trajectory (to the last digit that TUM files
        give), and which they are: (M,) of bool.

    Raises:
        EvalError: no stamp lies within it.
    """
    _, first = np.unique(truth.stamp, return_index=True)
    truth = truth.select(first)
    first_stamp, last_stamp = truth.stamp[0], truth.stamp[-1]
    known = (stamp > first_stamp - _STAMP_DIGIT) & (stamp < last_stamp + _STAMP_DIGIT)
    if not known.any() or len(truth) < 2:
        raise EvalError(
            f"the trajectory's stamps {stamp.min():.3f} .. {stamp.max():.3f} s and the truth's"
            f" {truth.stamp[0]:.3f} .. {truth.stamp[-1]:.3f} s have nothing in common"
        )
    at = stamp[known].clip(first_stamp, last_stamp)
    p = np.column_stack([np.interp(at, truth.stamp, truth.p[:, i]) for i in range(3)])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # on half turns between neighbours
        R = Slerp(truth.stamp, truth.R)(at)
    return Trajectory(stamp[known], p, R), known
