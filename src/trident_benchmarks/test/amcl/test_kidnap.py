# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The kidnapped robot: how it is judged, and two drives of the benchmark."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
import pytest
from trident_benchmarks.amcl import kidnap
from trident_benchmarks.amcl import measure as amcl
from trident_benchmarks.amcl.kidnap import Trial, judge
from trident_benchmarks.datasets.recorded_drive import (
    Lidar,
    Noise,
    Odometry,
    Recording,
    compose,
    relative,
)

STAMPS = np.arange(0.0, 40.0, 0.2)


def trial_of(right: npt.NDArray[np.bool_]) -> Trial:
    """A robot that stands at zero, carried off at 10 s, with a pose that is right at some times."""
    truth = np.zeros((len(STAMPS), 4))
    truth[:, 0] = STAMPS
    poses = np.zeros((len(STAMPS), 3))
    poses[~right, 0] = 1.0
    lidar = Lidar(0.0, 0.1, 0.1, 12.0, 0.0)
    return judge(Recording(lidar, (), truth, np.zeros(3), (10.0,)), poses, 4)[0]


def test_recovered_is_right_for_five_seconds_on_end() -> None:
    right = ((STAMPS > 12) & (STAMPS < 15)) | (STAMPS > 16)
    trial = trial_of(right)
    assert trial.recovered_s == pytest.approx(16.2 - 10.0 + 5.0)
    assert trial.is_recovered
    assert trial.error_m == 0.0


def test_right_too_late_or_not_for_long_is_lost() -> None:
    late = trial_of(STAMPS > 27.0)
    assert late.recovered_s == pytest.approx(22.2)
    assert not late.is_recovered
    assert trial_of((STAMPS % 4.0) < 2.0).recovered_s == math.inf
    summary = amcl.summarize([late, trial_of(STAMPS > 11.0)])
    assert (summary["recovered"], summary["trials"]) == (1, 2)
    assert summary["lost"] == ["seed 4 at 10 s"]


def test_poses_compose() -> None:
    a, b = np.array([1.0, 2.0, 0.5]), np.array([-3.0, 0.4, 2.0])
    assert compose(a, relative(a, b)) == pytest.approx(b)


def test_odometry_drifts_as_configured() -> None:
    straight, walked = Odometry(Noise(yaw_walk=0.0), 1), []
    for i in range(101):
        straight.add(float(i), np.array([0.1 * i, 0.0, 0.0]))
    assert abs(straight.poses[-1][0] - 10.0) == pytest.approx(0.2)
    for seed in range(200):
        odometry = Odometry(Noise(distance=0.0, turn=0.0), seed)
        for i in range(41):
            odometry.add(float(i), np.array([0.1 * i, 0.0, 0.0]))
        walked.append(odometry.poses[-1][2])
    assert np.std(walked) == pytest.approx(math.radians(0.5) * 2.0, rel=0.15)


@pytest.fixture(scope="module")
def office(tmp_path_factory: pytest.TempPathFactory) -> kidnap.Office:
    pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")
    return kidnap.Office(tmp_path_factory.mktemp("office"))


@pytest.mark.parametrize("seed", [0, 1])
def test_a_kidnapped_robot_finds_itself(office: kidnap.Office, seed: int) -> None:
    [trial] = kidnap.run(office, seed, 1)
    assert trial.is_recovered, trial
    assert trial.error_m < 0.1
