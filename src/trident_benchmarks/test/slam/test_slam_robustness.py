# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
import bz2
from pathlib import Path

import numpy as np
import pytest
from trident_benchmarks.slam import robustness
from trident_benchmarks.slam.changed_log import (
    NOTHING,
    Change,
    _scans,
    as_true_base,
    pose_matrix,
    write_changed,
)
from trident_eval.core.errors import EvalError
from trident_eval.slam.trajectory import Trajectory


def _log(folder: Path) -> Path:
    """Ten scans along a quarter of a circle of 1 m radius; the laser sits 0.2 m ahead."""
    lines = ["# a comment", "PARAM robot_front_laser_max 50"]
    for k in range(10):
        yaw = 0.5 * np.pi * k / 9.0
        base = pose_matrix(np.sin(yaw), 1.0 - np.cos(yaw), yaw)
        laser = base @ pose_matrix(0.2, 0.0, 0.0)
        poses = [v for T in (laser, base) for v in (T[0, 2], T[1, 2], np.arctan2(T[1, 0], T[0, 0]))]
        ranges = ["1.00", "2.00", "6.00", f"{NOTHING:.2f}"]
        lines.append(" ".join(["FLASER 4", *ranges, *map(str, poses), f"{k}.0 host {k}.0"]))
    file = folder / "a.clf.bz2"
    file.write_bytes(bz2.compress("\n".join(lines).encode()))
    return file


def _changed(folder: Path, change: Change) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    out = folder / "changed.clf"
    write_changed(_log(folder), change, out)
    return [(ranges, laser, base) for ranges, laser, base, _ in _scans(out)]


def test_unchanged_log_has_the_same_scans(tmp_path: Path) -> None:
    for before, after in zip(_scans(_log(tmp_path)), _changed(tmp_path, Change()), strict=True):
        for old, new in zip(before[:3], after, strict=True):
            np.testing.assert_allclose(new, old, atol=2e-6)


def test_odometry_errs_along_the_arc(tmp_path: Path) -> None:
    change = Change(scale=1.05, turn=1.1, drift=0.03)
    _, _, end = _changed(tmp_path, change)[-1]
    length, turned = 1.05 * 0.5 * np.pi, 1.1 * 0.5 * np.pi + 0.03 * 0.5 * np.pi
    radius = length / turned
    expected = pose_matrix(radius * np.sin(turned), radius * (1.0 - np.cos(turned)), turned)
    np.testing.assert_allclose(end, expected, atol=1e-4)


def test_worse_scans(tmp_path: Path) -> None:
    few = _changed(tmp_path, Change(every_beam=2, every_scan=3, farthest=5.6))
    assert len(few) == 4
    np.testing.assert_allclose(few[0][0], [1.0, NOTHING])
    noisy = np.array([ranges for ranges, _, _ in _changed(tmp_path, Change(noise=0.03))])
    assert 0.01 < (noisy[:, :3] - [1.0, 2.0, 6.0]).std() < 0.06
    np.testing.assert_allclose(noisy[:, 3], NOTHING)


def test_a_laser_configured_elsewhere_is_judged_where_it_is(tmp_path: Path) -> None:
    file, out = _log(tmp_path), tmp_path / "changed.clf"
    T_nominal_true = write_changed(file, Change(laser=(0.1, 0.05, 0.05)), out)
    true = [(laser, base) for _, laser, base, _ in _scans(file)]
    changed = [(laser, base) for _, laser, base, _ in _scans(out)]
    # SLAM finds the true laser, and a base relative to it as the nominal base is to the nominal
    # laser.
    believed = [
        laser @ np.linalg.inv(t_laser) @ t_base
        for (laser, _), (t_laser, t_base) in zip(true, changed, strict=True)
    ]
    columns = np.array([(T[0, 2], T[1, 2], np.arctan2(T[1, 0], T[0, 0])) for T in believed])
    judged = as_true_base(Trajectory.planar(np.arange(10.0), *columns.T), T_nominal_true)
    for k, (_, base) in enumerate(true):
        np.testing.assert_allclose(judged.p[k, :2], base[:2, 2], atol=1e-5)


def test_log_without_scans_is_an_error(tmp_path: Path) -> None:
    file = tmp_path / "a.clf"
    file.write_text("ODOM 0 0 0 0 0 0 0 host 0\n", encoding="utf-8")
    with pytest.raises(EvalError, match="has no FLASER message"):
        write_changed(file, Change(), tmp_path / "out.clf")


def test_twenty_combinations_and_what_is_missed_is_said() -> None:
    assert len(robustness.ODOMETRY_CHANGES) == 20
    good = {"translation_mean_m": 0.013, "of_plain": 1.0}
    bad = {"translation_mean_m": 0.158, "of_plain": 12.2}
    rows = [
        {"log": "intel", "change": "distance+ turn+ drift+", "final": bad, "causal": bad},
        {"log": "intel", "change": "3 cm of noise", "final": good, "causal": bad},
        {"log": "intel", "change": "laser x", "final": good, "causal": good},
    ]
    assert robustness.reasons(rows) == [
        "intel, distance+ turn+ drift+: final 0.1580 m is 12.20 times the plain one, limit 1.3",
        "intel, 3 cm of noise: causal 0.1580 m is 12.20 times the plain one, limit 3.0",
    ]
