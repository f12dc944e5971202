# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident bench slam` on logs."""

from __future__ import annotations

import json
import stat
from pathlib import Path

import pytest
from trident_benchmarks.__main__ import main
from trident_benchmarks.slam import public_logs
from trident_eval.slam import offline

PROGRAM = """#!/bin/sh
# Stands for slam_offline: a robot that drives a metre.
while [ "$1" != --out ]; do shift; done
mkdir -p "$2"; cd "$2"
printf '0 0 0 0 0 0 0 1\\n1 1 0 0 0 0 0 1\\n' > trajectory.tum; cp trajectory.tum causal.tum
printf 'P5 2 2 255 \\000\\376\\376\\315' > map.pgm
printf 'image: map.pgm\\nresolution: 0.5\\norigin: [0, 0, 0]\\n' > map.yaml
echo '{"scans": 2, "cpu_s": 0.5, "peak_rss_mb": 10.0}' > timing.json
"""


@pytest.fixture
def stand_in(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A program in the place of slam_offline, and a log with its relations."""
    path = tmp_path / "slam_offline"
    path.write_text(PROGRAM)
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setattr(offline, "program", lambda package, name: str(path))
    folder = tmp_path / "logs"
    folder.mkdir()
    (folder / "intel.clf.gz").write_text("")
    (folder / "intel.relations").write_text("0 1 1.01 0 0 0 0 0\n")
    (folder / "other.log").write_text("")
    return folder


def test_the_benchmark_sets_others_next_to_ours(
    stand_in: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rows = tmp_path / "rows.json"
    words = ["--data", str(stand_in), "--runs", "3", "--out", str(rows)]
    assert main(["slam", *words]) == 0
    lines = capsys.readouterr().out.splitlines()
    alone = [f"{method}, no odometry" for method in public_logs.BY_SCANS_ALONE]
    for method in ("graph_slam_2d", "particle_slam_2d", "hector_slam_2d", "odometry", *alone):
        figures = "0.0100 ± 0.0000 | 0.000 ± 0.000"
        final = f"| intel | **{method}, final** | {figures} | 0.5 | ? | 0.50 | 10 |"
        assert final in lines
        assert f"| intel | **{method}, causal** | {figures} |  |  |  |  |" in lines
        assert f"| other | **{method}** | no truth |  | 0.5 | ? | 0.50 | 10 |" in lines
    assert "| intel | slam_toolbox, final | 0.302 | 0.9 |  |  | 23.5 | 69 |" in lines
    assert not any("fr079" in line or "ekf_slam" in line for line in lines)
    written = json.loads(rows.read_text())["rows"]
    assert written[0]["cpu_s"] == 0.5
    runs = {row["system"]: row["runs"] for row in written}
    assert runs["graph_slam_2d"] == 3
    assert runs["odometry"] == runs["hector_slam_2d, no odometry"] == 1


def test_landmarks_are_a_row_of_the_benchmark(
    stand_in: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "landmark").mkdir()
    (tmp_path / "landmark" / "victoria_park.txt").write_text("")
    program = tmp_path / "slam_offline"
    timing = """{"scans": 2, "cpu_s": 0.1, "peak_rss_mb": 10.0, "observations": 9,
      "association_share": 0.875, "true_landmarks": 3, "landmarks": 4}"""
    program.write_text(PROGRAM + f"echo '{timing}' > timing.json\n")
    assert main(["slam", "--data", str(stand_in), "--runs", "1", "--method", "ekf_slam"]) == 0
    assert (
        "| victoria_park | **ekf_slam** | 87.5% of 9 associated as in the log | "
        "4 landmarks, true 3 |  |  | 0.10 | 10 |"
    ) in capsys.readouterr().out.splitlines()


def test_pictures_of_the_benchmark(stand_in: Path, tmp_path: Path) -> None:
    words = ["--data", str(stand_in), "--quick", "--pictures", str(tmp_path / "shown")]
    assert main(["slam", *words]) == 0
    names = {path.name for path in (tmp_path / "shown" / "intel_graph_slam_2d").iterdir()}
    assert {"map.png", "report.html"} <= names


def test_without_data_the_benchmark_says_so(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.delenv(public_logs.DATA, raising=False)
    assert main(["slam", "--quick"]) == 0
    assert capsys.readouterr().err.startswith("SKIPPED: TRIDENT_DATA")
    assert main(["slam", "--data", str(tmp_path)]) == 2
