# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The relations metric: how well a trajectory keeps hand-checked relative poses.

Kuemmerle et al.: On measuring the accuracy of SLAM algorithms, Autonomous Robots 27 (2009). No
global alignment is needed, and an error early in the log does not count again in all that follows.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from trident_eval.core.errors import EvalError
from trident_eval.core.tracks import Array
from trident_eval.slam.trajectory import Trajectory, read_numbers

#: A relation whose stamps lie further from those of the trajectory is not judged [s].
MAX_STAMP_GAP_S = 0.05


@dataclass(frozen=True)
class Relations:
    """True poses of the base at `to` as seen from the base at `begin`.

    Attributes:
        begin, to: stamps [s], shape (N,).
        p: [m], shape (N, 3).
        R: N attitudes.
    """

    begin: Array
    to: Array
    p: Array
    R: Rotation


@dataclass(frozen=True)
class RelationErrors:
    """Errors of each relation that could be judged.

    Attributes:
        translation_m, rotation_rad: shape (M,), not negative.
        unmatched: relations whose stamps the trajectory does not have.
    """

    translation_m: Array
    rotation_rad: Array
    unmatched: int

    def summary(self) -> dict[str, float | int]:
        """Mean and standard deviation as they are published, and the worst."""
        rotation = np.degrees(self.rotation_rad)
        return {
            "relations": len(self.translation_m),
            "unmatched": self.unmatched,
            "translation_mean_m": float(self.translation_m.mean()),
            "translation_std_m": float(self.translation_m.std()),
            "translation_max_m": float(self.translation_m.max()),
            "rotation_mean_deg": float(rotation.mean()),
            "rotation_std_deg": float(rotation.std()),
            "rotation_max_deg": float(rotation.max()),
        }


def read_relations(path: Path) -> Relations:
    """Read a .relations file: lines `t1 t2 x y z roll pitch yaw` [s, m, rad].

    Raises:
        EvalError: a line that is not that.
    """
    rows = read_numbers(path, 8, "lines `t1 t2 x y z roll pitch yaw`")
    R = Rotation.from_euler("ZYX", rows[:, [7, 6, 5]])
    return Relations(rows[:, 0], rows[:, 1], rows[:, 2:5], R)


def nearest(stamps: Array, wanted: Array) -> tuple[Array, Array]:
    """Indices of the stamps nearest to those wanted, and the gaps [s]; shapes (N,), (M,) -> (M,).

    Stamps may go backwards; of equal ones the first counts.
    """
    order = np.argsort(stamps, kind="stable")
    ordered = stamps[order]
    after = np.clip(np.searchsorted(ordered, wanted, side="left"), 0, len(ordered) - 1)
    before = np.maximum(after - 1, 0)
    is_before = np.abs(wanted - ordered[before]) < np.abs(ordered[after] - wanted)
    # The first of those that are equal to the one before.
    chosen = np.searchsorted(ordered, ordered[np.where(is_before, before, after)], side="left")
    return order[chosen], np.abs(ordered[chosen] - wanted)


def relation_errors(trajectory: Trajectory, relations: Relations) -> RelationErrors:
    """Judge a trajectory.

    Raises:
        EvalError: it has none of the relations' stamps.
    """
    i, gap_i = nearest(trajectory.stamp, relations.begin)
    j, gap_j = nearest(trajectory.stamp, relations.to)
    known = np.maximum(gap_i, gap_j) <= MAX_STAMP_GAP_S
    if not known.any():
        raise EvalError(
            f"no relation has its stamps in the trajectory: relations from"
            f" {relations.begin.min():.3f} s, trajectory from {trajectory.stamp.min():.3f} s"
        )
    i, j = i[known], j[known]
    inverse = trajectory.R[i].inv()
    p = inverse.apply(trajectory.p[j] - trajectory.p[i])
    R = inverse * trajectory.R[j]
    translation = np.linalg.norm(p - relations.p[known], axis=1)
    rotation = np.asarray((relations.R[known].inv() * R).magnitude())
    return RelationErrors(translation, rotation, int((~known).sum()))
