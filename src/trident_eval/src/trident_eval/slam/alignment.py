# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Absolute and relative trajectory error against a true trajectory.

Sturm et al.: A benchmark for the evaluation of RGB-D SLAM systems, IROS 2012. The alignment is
Umeyama's (1991) without scale.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from trident_eval.core.errors import EvalError
from trident_eval.core.tracks import Array
from trident_eval.slam.trajectory import Trajectory, interpolated


@dataclass(frozen=True)
class AbsoluteErrors:
    """Errors after the rigid motion that fits best.

    Attributes:
        stamp: [s], shape (N,).
        truth: true poses at these stamps.
        aligned: estimated poses in the true frame.
        T_truth_map: that motion, a 4 x 4 matrix.
    """

    stamp: Array
    truth: Trajectory
    aligned: Trajectory
    T_truth_map: Array

    @property
    def translation_m(self) -> Array:
        """Shape (N,)."""
        return np.asarray(np.linalg.norm(self.aligned.p - self.truth.p, axis=1))

    @property
    def rotation_rad(self) -> Array:
        """Shape (N,), not negative."""
        return np.asarray((self.truth.R.inv() * self.aligned.R).magnitude())

    def summary(self) -> dict[str, float | int]:
        """RMSE, mean and worst."""
        rotation = np.degrees(self.rotation_rad)
        return {
            "poses": len(self.stamp),
            "ate_rmse_m": float(np.sqrt(np.mean(self.translation_m**2))),
            "ate_mean_m": float(self.translation_m.mean()),
            "ate_max_m": float(self.translation_m.max()),
            "ate_rotation_rmse_deg": float(np.sqrt(np.mean(rotation**2))),
            "ate_rotation_max_deg": float(rotation.max()),
        }


def absolute_errors(estimate: Trajectory, truth: Trajectory, group: str = "SE2") -> AbsoluteErrors:
    """Align an estimate with the truth and compare them pose by pose.

    Args:
        estimate: any stamps within the truth's.
        truth: is interpolated at the estimate's stamps.
        group: of motions to align by: "SE2" (x, y, yaw), "SE3", or "none".

    Raises:
        EvalError: no common stamps, or an unknown group.
    """
    if group not in ("SE2", "SE3", "none"):
        raise EvalError(f"alignment {group!r} is not legal; legal: SE2, SE3, none")
    true_poses, known = interpolated(truth, estimate.stamp)
    poses = estimate.select(known)
    T = np.eye(4) if group == "none" else _fit(poses.p, true_poses.p, group)
    R = Rotation.from_matrix(T[:3, :3])
    aligned = Trajectory(poses.stamp, R.apply(poses.p) + T[:3, 3], R * poses.R)
    return AbsoluteErrors(poses.stamp, true_poses, aligned, T)


def _fit(source: Array, target: Array, group: str) -> Array:
    """The 4 x 4 motion that brings points (N, 3) nearest to others in the mean square."""
    size = 2 if group == "SE2" else 3
    a, b = source[:, :size], target[:, :size]
    u, _, vt = np.linalg.svd((b - b.mean(0)).T @ (a - a.mean(0)))
    mirror = np.ones(size)
    mirror[-1] = np.sign(np.linalg.det(u @ vt))
    T = np.eye(4)
    T[:size, :size] = u @ np.diag(mirror) @ vt
    T[:size, 3] = b.mean(0) - T[:size, :size] @ a.mean(0)
    return T


def relative_errors(errors: AbsoluteErrors, distance_m: float) -> tuple[Array, Array]:
    """Relative pose errors over a driven distance.

    Args:
        errors: of the trajectory; alignment does not matter here.
        distance_m: driven by the true trajectory between the two poses of a pair.

    Returns:
        Translation [m] and rotation [rad] of each pair, shape (M,); M may be 0.
    """
    steps = np.linalg.norm(np.diff(errors.truth.p, axis=0), axis=1)
    driven = np.concatenate([[0.0], np.cumsum(steps)])
    begin = np.arange(len(driven))
    end = np.searchsorted(driven, driven + distance_m)
    begin, end = begin[end < len(driven)], end[end < len(driven)]
    moves = []
    for poses in (errors.truth, errors.aligned):
        inverse = poses.R[begin].inv()
        moves.append((inverse.apply(poses.p[end] - poses.p[begin]), inverse * poses.R[end]))
    (true_p, true_R), (p, R) = moves
    return np.linalg.norm(p - true_p, axis=1), np.asarray((true_R.inv() * R).magnitude())


def relative_summary(errors: AbsoluteErrors, distance_m: float = 1.0) -> dict[str, float | int]:
    """Relative pose errors over a distance in numbers; empty when nothing was driven so far."""
    translation, rotation = relative_errors(errors, distance_m)
    if not len(translation):
        return {}
    return {
        "rpe_distance_m": distance_m,
        "rpe_pairs": len(translation),
        "rpe_rmse_m": float(np.sqrt(np.mean(translation**2))),
        "rpe_rotation_rmse_deg": float(np.degrees(np.sqrt(np.mean(rotation**2)))),
    }
