# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation
from trident_eval.core.errors import EvalError
from trident_eval.slam.__main__ import main
from trident_eval.slam.alignment import absolute_errors, relative_summary
from trident_eval.slam.grid import (
    FREE,
    OCCUPIED,
    UNKNOWN,
    Grid,
    mean_map_entropy,
    read_grid,
    wall_thickness,
)
from trident_eval.slam.map_agreement import agreement
from trident_eval.slam.relations import Relations, nearest, read_relations, relation_errors
from trident_eval.slam.trajectory import Trajectory, read_tum


def drive(count: int = 50, seed: int = 3) -> Trajectory:
    """A planar trajectory that turns, 10 Hz."""
    rng = np.random.default_rng(seed)
    yaw = np.cumsum(rng.normal(0.0, 0.1, count))
    step = 0.1 * np.column_stack([np.cos(yaw), np.sin(yaw)])
    x, y = np.cumsum(step, axis=0).T
    return Trajectory.planar(100.0 + 0.1 * np.arange(count), x, y, yaw)


def relations_of(trajectory: Trajectory, gap: int) -> Relations:
    """True relations between poses that are `gap` apart."""
    i = np.arange(len(trajectory) - gap)
    inverse = trajectory.R[i].inv()
    p = inverse.apply(trajectory.p[i + gap] - trajectory.p[i])
    R = inverse * trajectory.R[i + gap]
    return Relations(trajectory.stamp[i], trajectory.stamp[i + gap], p, R)


@settings(deadline=None, max_examples=20)
@given(seed=st.integers(0, 1000), angle=st.floats(-3, 3), gap=st.integers(1, 20))
def test_relations_do_not_see_where_the_map_lies(seed: int, angle: float, gap: int) -> None:
    truth = drive(seed=seed)
    R = Rotation.from_euler("Z", angle)
    moved = Trajectory(truth.stamp, R.apply(truth.p) + np.array([5.0, -7.0, 0.0]), R * truth.R)
    errors = relation_errors(moved, relations_of(truth, gap))
    np.testing.assert_allclose(errors.translation_m, 0.0, atol=1e-9)
    np.testing.assert_allclose(errors.rotation_rad, 0.0, atol=1e-7)


def test_relation_errors_are_means_of_lengths_and_angles() -> None:
    stamp = np.array([0.0, 1.0, 2.0])
    estimate = Trajectory.planar(stamp, np.array([0, 1.1, 2.0]), np.zeros(3), np.array([0, 0, 0.2]))
    truth = Trajectory.planar(stamp, np.array([0, 1.0, 2.0]), np.zeros(3), np.zeros(3))
    summary = relation_errors(estimate, relations_of(truth, 1)).summary()
    assert summary["translation_mean_m"] == pytest.approx(0.1)
    assert summary["translation_std_m"] == pytest.approx(0.0, abs=1e-12)
    assert summary["rotation_mean_deg"] == pytest.approx(np.degrees(0.1))
    assert summary["rotation_max_deg"] == pytest.approx(np.degrees(0.2))


def test_stamps_may_go_backwards_and_repeat() -> None:
    stamps = np.array([1.0, 3.0, 2.0, 3.0, 4.0])
    index, gap = nearest(stamps, np.array([3.0, 2.1, 0.0, 9.0]))
    assert index.tolist() == [1, 2, 0, 4]
    np.testing.assert_allclose(gap, [0.0, 0.1, 1.0, 5.0])


def test_relations_without_a_scan_are_counted() -> None:
    truth = drive()
    part = truth.select(np.arange(len(truth)) < 30)
    errors = relation_errors(part, relations_of(truth, 5))
    assert errors.unmatched == 20
    with pytest.raises(EvalError, match="no relation has its stamps"):
        relation_errors(Trajectory(truth.stamp + 1e4, truth.p, truth.R), relations_of(truth, 5))


@pytest.mark.parametrize("group", ["SE2", "SE3"])
def test_alignment_takes_out_a_rigid_motion(group: str) -> None:
    truth = drive(200)
    truth = Trajectory(truth.stamp, truth.p + [0, 0, 1] * np.sin(truth.stamp)[:, None], truth.R)
    angles = [2.0, 0.0, 0.0] if group == "SE2" else [2.0, 0.3, -0.4]
    R = Rotation.from_euler("ZYX", angles)
    shift = [3.0, 4.0, 0.0 if group == "SE2" else 2.0]
    moved = Trajectory(truth.stamp, R.apply(truth.p) + shift, R * truth.R)
    summary = absolute_errors(moved, truth, group).summary()
    assert summary["ate_rmse_m"] < 1e-9
    assert summary["ate_rotation_rmse_deg"] < 1e-5


def test_absolute_error_is_what_is_left() -> None:
    truth = drive(200)
    bent = Trajectory(truth.stamp, truth.p.copy(), truth.R)
    bent.p[::2, 1] += 0.1
    errors = absolute_errors(bent, truth, "none")
    assert errors.summary()["ate_rmse_m"] == pytest.approx(0.1 / 2**0.5)
    assert absolute_errors(bent, truth).summary()["ate_rmse_m"] == pytest.approx(0.05, rel=0.02)
    with pytest.raises(EvalError, match="SE4"):
        absolute_errors(bent, truth, "SE4")


def test_last_stamps_that_are_rounded_up_are_within_the_truth() -> None:
    truth = drive(20)
    rounded = truth.stamp + np.where(np.arange(20) == 19, 4e-7, 0.0)
    rounded[0] -= 1e-3
    errors = absolute_errors(Trajectory(rounded, truth.p, truth.R), truth, "none")
    assert errors.stamp.tolist() == rounded[1:].tolist()


def test_relative_error_over_a_meter() -> None:
    count = 101
    x = 0.1 * np.arange(count)
    truth = Trajectory.planar(np.arange(count) * 1.0, x, np.zeros(count), np.zeros(count))
    longer = Trajectory.planar(truth.stamp, 1.02 * x, np.zeros(count), np.zeros(count))
    summary = relative_summary(absolute_errors(longer, truth, "none"), 1.0 - 1e-9)
    assert summary["rpe_pairs"] == 91
    assert summary["rpe_rmse_m"] == pytest.approx(0.02)


def room(resolution: float = 0.05, thickness: int = 1, size: int = 100) -> Grid:
    """A square room, free inside, unknown outside."""
    cells = np.full((size, size), UNKNOWN, np.int8)
    cells[10:-10, 10:-20] = OCCUPIED
    inner = slice(10 + thickness, -10 - thickness)
    cells[inner, 10 + thickness : -20 - thickness] = FREE
    return Grid(cells, resolution, np.array([-1.0, 2.0, 0.0]))


@pytest.mark.parametrize("thickness", [1, 2, 4])
def test_wall_thickness(thickness: int) -> None:
    assert wall_thickness(room(thickness=thickness)) == pytest.approx(0.05 * thickness)


def test_entropy_of_a_line_is_that_of_its_gaussian() -> None:
    cells = np.full((3, 101), FREE, np.int8)
    cells[1] = OCCUPIED
    square = 0.05**2 / 12.0
    inside = np.var(0.05 * np.arange(-6, 7)) + square  # 13 cells within 0.3 m
    expected = 0.5 * np.log((2 * np.pi * np.e) ** 2 * inside * square)
    found = mean_map_entropy(Grid(cells, 0.05, np.zeros(3)), 0.301)
    assert found == pytest.approx(expected, abs=0.05)  # less at the ends
    assert np.isnan(mean_map_entropy(Grid(np.zeros((4, 4), np.int8), 0.05, np.zeros(3))))


def test_entropy_grows_with_the_blur_of_walls() -> None:
    one, two, four = (mean_map_entropy(room(thickness=cells)) for cells in (1, 2, 4))
    assert one < two - 0.3 < four - 0.6


def test_a_map_that_is_turned_agrees_where_it_is_laid() -> None:
    truth = room()
    c, s = np.cos(0.7), np.sin(0.7)
    shift = np.array([[c, s], [-s, c]]) @ (truth.origin[:2] - [2.0, 3.0])
    turned = Grid(truth.cells, 0.05, np.array([*shift, -0.7]))
    rough = np.array(
        [[np.cos(0.72), -np.sin(0.72), 2.1], [np.sin(0.72), np.cos(0.72), 2.9], [0, 0, 1]]
    )
    summary = agreement(turned, truth, rough).summary()
    assert summary["map_precision"] == pytest.approx(1.0)
    assert summary["map_recall"] == pytest.approx(1.0)


def test_a_wall_too_many_is_wrong() -> None:
    truth = room()
    cells = truth.cells.copy()
    cells[30:70, 40] = OCCUPIED
    result = agreement(Grid(cells, truth.resolution, truth.origin), truth)
    walls = int((cells == OCCUPIED).sum())
    assert result.summary()["map_precision"] == pytest.approx(1 - 40 / walls)
    assert result.summary()["map_recall"] == pytest.approx(1.0)


def write_tum(path: Path, trajectory: Trajectory) -> None:
    rows = np.column_stack([trajectory.stamp, trajectory.p, trajectory.R.as_quat()])
    np.savetxt(path, rows, fmt="%.6f")


def write_map(folder: Path, grid: Grid) -> Path:
    shades = np.select([grid.cells == OCCUPIED, grid.cells == FREE], [0, 254], 205).astype(np.uint8)
    head = f"P5\n# a comment\n{shades.shape[1]} {shades.shape[0]}\n255\n".encode()
    (folder / "map.pgm").write_bytes(head + shades[::-1].tobytes())
    origin = ", ".join(f"{value:.6f}" for value in grid.origin)
    path = folder / "map.yaml"
    path.write_text(
        f"image: map.pgm\nresolution: {grid.resolution}\norigin: [{origin}]\n"
        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    return path


def test_the_command_writes_numbers_pictures_and_a_page(tmp_path: Path) -> None:
    truth = drive(200)
    write_tum(tmp_path / "trajectory.tum", truth)
    write_tum(tmp_path / "truth.tum", truth)
    relations = relations_of(truth, 10)
    yaw = relations.R.as_euler("ZYX")[:, 0]
    rows = np.column_stack([relations.begin, relations.to, relations.p, 0 * yaw, 0 * yaw, yaw])
    np.savetxt(tmp_path / "log.relations", rows, fmt="%.6f")
    yaml = write_map(tmp_path, room())
    words = ["--relations", tmp_path / "log.relations", "--truth", tmp_path / "truth.tum"]
    words += ["--true-map", yaml, "--out", tmp_path / "out"]
    assert main(["evaluate", str(tmp_path), *map(str, words)]) == 0
    numbers = json.loads((tmp_path / "out" / "evaluation.json").read_text())
    assert numbers["final"]["translation_mean_m"] < 2e-6
    assert numbers["final"]["ate_rmse_m"] < 1e-6
    assert numbers["map"]["map_precision"] == 1.0
    page = (tmp_path / "out" / "report.html").read_text()
    assert page.count("data:image/png;base64,") == 4
    np.testing.assert_array_equal(read_grid(yaml).cells, room().cells)


@pytest.mark.parametrize(
    ("text", "error_text"),
    [
        ("", "has no row"),
        ("1 2 3\n", ":1: '1 2 3' is not legal"),
        ("# t\n1 2 3 4 5 6 seven 8\n", ":2: could not convert"),
        ("1 2 3 4 5 6 nan 8\n", ":1: "),
        ("1 2 3 4 0 0 0 0\n", "pose 1 has a quaternion of norm 0"),
    ],
)
def test_bad_trajectories_are_named(tmp_path: Path, text: str, error_text: str) -> None:
    path = tmp_path / "bad.tum"
    path.write_text(text)
    with pytest.raises(EvalError, match=r"bad\.tum") as error:
        read_tum(path)
    assert error_text in str(error.value)


def test_bad_maps_are_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_tum(tmp_path / "trajectory.tum", drive())
    path = write_map(tmp_path, room())
    text = path.read_text()
    for bad, error_text in [
        (text.replace("0.05", "-1"), "resolution above 0"),
        (text.replace("map.pgm", "none.pgm"), "none.pgm"),
        ("[", "map.yaml"),
        ("image: map.pgm\n", "needs image, resolution and origin"),
    ]:
        path.write_text(bad)
        assert main(["evaluate", str(tmp_path)]) == 2
        assert error_text in capsys.readouterr().err
    with pytest.raises(EvalError, match=r"none\.relations"):
        read_relations(tmp_path / "none.relations")


def test_a_reader_may_stop_at_any_line(tmp_path: Path) -> None:
    truth = drive(20)
    stamped = np.column_stack([truth.stamp, truth.p, truth.R.as_quat()])
    np.savetxt(tmp_path / "trajectory.tum", stamped, fmt="%.6f")
    np.savetxt(tmp_path / "truth.tum", stamped, fmt="%.6f")
    read, write = os.pipe()
    os.close(read)
    words = ["evaluate", str(tmp_path), "--truth", str(tmp_path / "truth.tum"), "--no-pictures"]
    command = [sys.executable, "-m", "trident_eval.slam", *words]
    done = subprocess.run(command, stdout=write, stderr=subprocess.PIPE, text=True, check=False)
    os.close(write)
    assert (done.returncode, done.stderr) == (141, "")
