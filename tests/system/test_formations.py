# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Formations beyond six rows of text: patterns, MATLAB v7.3, fleets, followers of a leader."""

from __future__ import annotations

import re
from pathlib import Path

import h5py
import numpy as np
from harness import REPO
from trident_runs import Trident

MAIN_JOB = "multi_uav_simulation.launch"
TOUR = REPO / "config" / "formations" / "patterns_tour.yaml"


def as_v73(text_file: Path, path: Path) -> None:
    """The positions of six vehicles as MATLAB's save -v7.3 stores them."""
    rows = np.loadtxt(text_file, comments="%")[:, 1:]
    matrix = rows.reshape(-1, 6, 3).transpose(2, 1, 0)  # 3 x N x T
    with h5py.File(path, "w", userblock_size=512) as file:
        dataset = file.create_dataset("vehicle_pos", data=matrix.T, compression="gzip")
        dataset.attrs["MATLAB_class"] = np.bytes_("double")
    text = b"MATLAB 7.3 MAT-file, Platform: GLNXA64, HDF5 schema 1.00 ."
    with path.open("r+b") as stream:
        stream.write(text.ljust(116) + bytes(8) + b"\x00\x02IM")


def test_a_choreography_is_made_and_flown_from_text_and_from_matlab_v73(
    trident: Trident, tmp_path: Path
) -> None:
    text, mat = tmp_path / "tour.txt", tmp_path / "tour73.mat"
    made = trident("formation", TOUR, "--out", text)
    assert made.code == 0, made.output
    assert "6 vehicles, 236 rows, smallest separation 1.512 m" in made.output
    as_v73(text, mat)
    flown = [trident("run", MAIN_JOB, f"formation_file:={file}").passed for file in (text, mat)]
    assert flown[0]["rows_flown"] == flown[0]["rows"] == 236
    assert flown[0]["state_hash"] == flown[1]["state_hash"], "the same numbers, the same flight"


def test_a_file_of_four_is_flown_by_four_and_refused_for_six_before_anything_starts(
    trident: Trident, tmp_path: Path
) -> None:
    four = tmp_path / "four.txt"
    made = trident("formation", "line", "translate:2,0,0", "--uavs", 4, "--out", four)
    assert made.code == 0, made.output
    flown = trident("run", MAIN_JOB, f"formation_file:={four}", "uavs:=4").passed
    assert flown["rows_flown"] == flown["rows"]
    refused = trident("run", MAIN_JOB, f"formation_file:={four}")
    assert refused.code == 1
    assert refused.folder is None, "nothing was launched"
    assert f"uavs: 6, but {four} holds 4 vehicles; legal: 1 to 4" in refused.output


def test_a_damaged_v73_file_ends_the_run_with_its_name(trident: Trident, tmp_path: Path) -> None:
    mat = tmp_path / "damaged.mat"
    as_v73(TOUR.with_suffix(".txt"), mat)
    mat.write_bytes(mat.read_bytes()[:2000])
    run = trident("run", MAIN_JOB, "uavs:=1", f"formation_file:={mat}")
    assert run.code != 0
    assert re.search(r"damaged\.mat: not a readable \.mat file \(HDF5: ", run.output), run.output
    assert "Traceback" not in run.output


def test_a_fleet_of_nine_flies_from_a_launch_file_that_was_made_for_it(
    trident: Trident, tmp_path: Path
) -> None:
    launch = tmp_path / "nine.launch"
    made = trident("formation-launch", "--uavs", 9, "--out", launch)
    assert made.code == 0, made.output
    verdict = trident("run", launch).passed
    assert verdict["vehicles"] == [f"UAV{number}" for number in range(1, 10)]
    assert verdict["rows_flown"] == verdict["rows"]
    assert verdict["min_separation_m"] > 1.0 - 0.1
    fewer = trident("run", launch, "uavs:=2").passed
    assert fewer["vehicles"] == ["UAV1", "UAV2"]


def test_a_fleet_with_a_bad_file_ends_with_the_reason(trident: Trident, tmp_path: Path) -> None:
    launch, bad = tmp_path / "seven.launch", tmp_path / "bad.txt"
    assert trident("formation-launch", "--uavs", 7, "--out", launch).code == 0
    bad.write_text("1 0 0 1\n2 0 1\n")
    run = trident("run", launch, f"formation_file:={bad}")
    assert run.code == 1, run.output
    assert f"{bad}:2: 3 columns in '2 0 1'; legal: 4" in run.output


def test_followers_keep_their_places_and_repeat_to_the_bit(trident: Trident) -> None:
    arguments = ("run", "leader_follower.launch", "uavs:=4")
    first, second = (trident(*arguments).passed for _ in range(2))
    assert first["mode"] == "follow"
    assert first["vehicles"] == ["UAV1", "UAV2", "UAV3", "UAV4"]
    assert first["rows_flown"] == first["rows"] > 25
    assert first["formation_rms_m"] < 0.04
    assert second["state_hash"] == first["state_hash"]


def test_followers_know_the_leader_from_its_odometry_alone(trident: Trident) -> None:
    topic = "leader_topic:=/UAV1/odometry_sensor1/odometry"
    arguments = ("run", "leader_follower.launch", "uavs:=3", "pattern:=circle", topic)
    first, second = (trident(*arguments).passed for _ in range(2))
    assert first["rows_flown"] == first["rows"] > 25
    assert second["state_hash"] == first["state_hash"]
