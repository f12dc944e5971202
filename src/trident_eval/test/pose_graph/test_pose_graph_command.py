# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
import gzip
import math
import random
from pathlib import Path

import numpy as np
import pytest
from trident_eval.core.errors import EvalError
from trident_eval.pose_graph import __main__ as command
from trident_eval.pose_graph.g2o import Layout, read_layout
from trident_eval.pose_graph.program import optimize

_INFORMATION = "100 0 0 100 0 100"


def _square(folder: Path, false_loops: int = 0) -> Path:
    """Twice around a square of 10 m, from dead reckoning that is 2 % off."""
    poses = [(0.0, 0.0, 0.0)]
    edges = []
    for k in range(40):
        turn = math.pi / 2 if k % 5 == 4 else 0.0
        edges.append(f"EDGE_SE2 {k} {k + 1} 2 0 {turn!r} {_INFORMATION}")
        x, y, yaw = poses[-1]
        x, y = x + 2.04 * math.cos(yaw), y + 2.04 * math.sin(yaw)
        poses.append((x, y, yaw + 1.02 * turn))
    edges += [f"EDGE_SE2 {k} {k + 20} 0 0 0 {_INFORMATION}" for k in range(0, 21, 2)]
    edges += [f"EDGE_SE2 {k} {k + 7} 1 1 1 {_INFORMATION}" for k in range(false_loops)]
    vertices = [f"VERTEX_SE2 {k} {x!r} {y!r} {yaw!r}" for k, (x, y, yaw) in enumerate(poses)]
    file = folder / "square.g2o"
    file.write_text("\n".join([*vertices, *edges]) + "\n", encoding="utf-8")
    return file


def _main(monkeypatch: pytest.MonkeyPatch, *words: object) -> int:
    monkeypatch.setattr("sys.argv", ["posegraph", *map(str, words)])
    return command.main()


def test_graph_is_optimized_written_reported_and_drawn(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    file, out, picture = _square(tmp_path), tmp_path / "out.g2o.gz", tmp_path / "p.png"
    assert _main(monkeypatch, file, "--out", out, "--picture", picture) == 0
    output = capsys.readouterr().out
    assert "SE2, 41 vertices, 51 edges" in output
    assert "NOT converged" not in output
    assert picture.read_bytes()[:4] == b"\x89PNG"
    layout = read_layout(out)
    np.testing.assert_allclose(layout.positions[20], [0.0, 0.0], atol=1e-6)
    np.testing.assert_allclose(layout.positions[10], [10.0, 10.0], atol=1e-6)


def test_graph_without_vertices_is_drawn_where_it_starts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = _square(tmp_path)
    lines = file.read_text(encoding="utf-8").splitlines()
    file.write_text("\n".join(line for line in lines if line.startswith("EDGE")), encoding="utf-8")
    drawn: list[list[tuple[str, Layout]]] = []
    monkeypatch.setattr(command, "draw", lambda panels, outliers, picture: drawn.append(panels))
    assert _main(monkeypatch, file) == 0
    (before_title, before), (after_title, after) = drawn[0]
    assert before_title.startswith("square, before: chi2 ")
    assert after_title.startswith("after: chi2 ")
    assert len(before.ids) == len(after.ids) == 41
    np.testing.assert_allclose(after.positions[10], [10.0, 10.0], atol=1e-6)


def test_parts_that_are_not_joined_are_reported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    file = _square(tmp_path)
    island = f"VERTEX_SE2 90 0 0 0\nVERTEX_SE2 91 0 0 0\nEDGE_SE2 91 90 1 0 0 {_INFORMATION}\n"
    file.write_text(file.read_text(encoding="utf-8") + island, encoding="utf-8")
    assert _main(monkeypatch, file, "--picture", tmp_path / "p.png") == 0
    assert "parts        2, not joined: each is held by its first" in capsys.readouterr().out
    assert optimize(_square(tmp_path), [])["parts"] == 1


def test_two_runs_write_the_same_bytes(tmp_path: Path) -> None:
    file = _square(tmp_path, 3)
    for name in ("a.g2o", "b.g2o"):
        optimize(file, ["--robust", "gnc", "--out", str(tmp_path / name)])
    assert (tmp_path / "a.g2o").read_bytes() == (tmp_path / "b.g2o").read_bytes()


def test_false_loops_are_named(tmp_path: Path) -> None:
    report = optimize(_square(tmp_path, 4), ["--robust", "gnc"])
    assert report["outliers"] == [[k, k + 7] for k in range(4)]
    assert report["cost_after"] == pytest.approx(
        4 * 4.033**2, abs=1e-3
    )  # each as its scale squared


def test_ceres_finds_the_same(tmp_path: Path) -> None:
    file = _square(tmp_path, 2)
    ours, theirs = (optimize(file, ["--solver", name]) for name in ("trident", "ceres"))
    assert theirs["chi2_after"] == pytest.approx(ours["chi2_after"], rel=1e-4)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--init", "lago"], "--init: unknown 'lago'"),
        (["--robust", "hubert"], "unknown robust kernel 'hubert'; did you mean 'huber'?"),
        (["--scale", "-1"], "graduated_scale is -1, but must be >= 0"),
        (["--speed", "1"], "unknown option '--speed'"),
        (["--solver", "ceres", "--ceres_linear_solver", "QR"], "unknown ceres_linear_solver 'QR'"),
    ],
)
def test_wrong_options_are_named(tmp_path: Path, words: list[str], message: str) -> None:
    with pytest.raises(EvalError, match=message.replace("?", r"\?")):
        optimize(_square(tmp_path), words)


def test_bad_line_is_one_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "bad.g2o"
    file.write_text("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 zero 0\n", encoding="utf-8")
    assert _main(monkeypatch, file) == 1
    error = capsys.readouterr().err
    assert error == f"trident: {file}:2: y is 'zero', but must be a finite number\n"


def _spoil_information(file: Path) -> None:
    """Gives two edges information that would pay for errors along x."""
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace(_INFORMATION, "-5 0 0 100 0 100", 2), encoding="utf-8")


def test_indefinite_information_is_taken_with_one_warning(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    file = _square(tmp_path)
    _spoil_information(file)
    assert _main(monkeypatch, file, "--picture", tmp_path / "p.png") == 0
    captured = capsys.readouterr()
    assert captured.err.count("\n") == 1
    assert captured.err.startswith(f"warning: {file}: the information of 2 of 51 edges is not")
    assert "NOT converged" not in captured.out


def test_strict_refuses_indefinite_information(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    file = _square(tmp_path)
    _spoil_information(file)
    assert _main(monkeypatch, file, "--strict") == 1
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert f"{file}:42: the least eigenvalue of the information is '-5', but must be >= 0" in error


def _noisy_grid(folder: Path) -> Path:
    """Rows of a grid driven to and fro with turns that err by 0.4 rad, vertices by them alone."""
    dice = random.Random(4)
    columns, rows, loops = 30, 30, 0.3
    cells = [(c if r % 2 == 0 else columns - 1 - c, r) for r in range(rows) for c in range(columns)]
    number = {cell: k for k, cell in enumerate(cells)}
    poses, edges = [(0.0, 0.0, 0.0)], []
    for (x, y), k in number.items():
        for cell in ((x + 1, y), (x - 1, y), (x, y + 1)):
            other = number.get(cell, -1)
            if other <= k or (other != k + 1 and dice.random() > loops):
                continue
            turn = dice.gauss(0.0, 0.4)
            dx, dy = cell[0] - x, cell[1] - y
            edges.append(f"EDGE_SE2 {k} {other} {dx} {dy} {turn!r} {_INFORMATION}")
            if other == k + 1:
                px, py, yaw = poses[-1]
                cosine, sine = math.cos(yaw), math.sin(yaw)
                poses.append(
                    (px + cosine * dx - sine * dy, py + sine * dx + cosine * dy, yaw + turn)
                )
    vertices = [f"VERTEX_SE2 {k} {x!r} {y!r} {yaw!r}" for k, (x, y, yaw) in enumerate(poses)]
    file = folder / "grid.g2o"
    file.write_text("\n".join([*vertices, *edges]) + "\n", encoding="utf-8")
    return file


def test_start_at_the_file_is_not_worse_than_ceres(tmp_path: Path) -> None:
    file = _noisy_grid(tmp_path)
    best = optimize(file, [])["chi2_after"]
    theirs = optimize(file, ["--init", "file", "--solver", "ceres"])["chi2_after"]
    ours = optimize(file, ["--init", "file"])
    assert theirs > 1.5 * best  # the file's own start leads astray
    assert ours["chi2_given_up"] > 1.5 * best
    assert ours["chi2_after"] == pytest.approx(best, rel=1e-3)


def test_levenberg_marquardt_converges_where_turns_err(tmp_path: Path) -> None:
    file = _noisy_grid(tmp_path)
    report = optimize(file, ["--strategy", "levenberg_marquardt", "--iterations", "60"])
    assert report["converged"]
    assert report["chi2_after"] == pytest.approx(optimize(file, [])["chi2_after"], rel=1e-4)


def test_layout_of_packed_3d_file(tmp_path: Path) -> None:
    text = (
        "VERTEX_SE3:QUAT 4 1 2 3 0 0 0 1\nVERTEX_SE3:QUAT 2 0 0 1 0 0 0 1\nEDGE_SE3:QUAT 2 4 ...\n"
    )
    file = tmp_path / "a.g2o.gz"
    file.write_bytes(gzip.compress(text.encode()))
    layout = read_layout(file)
    assert layout.is_3d
    np.testing.assert_array_equal(layout.segments(), [[[0.0, 0.0, 1.0], [1.0, 2.0, 3.0]]])


def test_a_graph_that_is_no_text_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "binary.g2o"
    file.write_bytes(bytes(range(128, 256)) * 40)
    assert _main(monkeypatch, file) != 0
    assert "binary.g2o" in capsys.readouterr().err
