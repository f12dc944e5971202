# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import stat
from pathlib import Path

import pytest
from trident_eval.core.errors import EvalError
from trident_eval.slam import offline
from trident_eval.slam.__main__ import main

PROGRAM = """#!/bin/sh
# Stands for slam_offline: a robot that drives a metre.
while [ "$1" != --out ]; do shift; done
mkdir -p "$2"; cd "$2"
echo ' 50 % 1 scans' >&2; echo 'warning: log:3: odd' >&2
printf '0 0 0 0 0 0 0 1\\n1 1 0 0 0 0 0 1\\n' > trajectory.tum; cp trajectory.tum causal.tum
printf 'P5 2 2 255 \\000\\376\\376\\315' > map.pgm
printf 'image: map.pgm\\nresolution: 0.5\\norigin: [0, 0, 0]\\n' > map.yaml
echo '{"scans": 2, "cpu_s": 0.5, "peak_rss_mb": 10.0, "odometry_calibration":
  {"turn_scale": {"value": 0.97, "sigma": 0.002, "is_observed": true},
   "laser_x": {"value": 0.0, "sigma": 0.1, "is_observed": false}}}' > timing.json
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


def test_a_log_becomes_a_folder(
    stand_in: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["--relations", str(stand_in / "intel.relations"), "--out", str(tmp_path / "out")]
    assert main(["slam", str(stand_in / "intel.clf.gz"), *words]) == 0
    said = capsys.readouterr()
    assert "translation_mean_m         0.01" in said.out
    assert "odometry: turn_scale 0.9700 ± 0.0020; not observable: laser_x\n" in said.out
    assert said.err == "warning: log:3: odd\n"
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert {"map.png", "report.html", "evaluation.json", "trajectory.tum"} <= names


def test_a_program_that_fails_is_quoted(
    stand_in: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    script = "#!/bin/sh\necho 'scans: /s' >&2\necho 'slam_offline: no scan' >&2; exit 1\n"
    (tmp_path / "slam_offline").write_text(script)
    assert main(["slam", str(stand_in / "other.log"), "--out", str(tmp_path / "out")]) == 2
    assert capsys.readouterr().err == "scans: /s\ntrident: no scan\n"


def test_a_program_that_quotes_bytes_is_quoted(
    stand_in: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    script = "#!/bin/sh\nprintf 'slam_offline: c.yaml:2: \\377\\376\\n' >&2; exit 1\n"
    (tmp_path / "slam_offline").write_text(script)
    assert main(["slam", str(stand_in / "other.log"), "--out", str(tmp_path / "out")]) == 2
    assert "trident: c.yaml:2: \ufffd\ufffd" in capsys.readouterr().err


@pytest.mark.parametrize("file", ["map.png", "evaluation.json", "report.html"])
def test_a_full_disk_is_one_sentence(
    stand_in: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], file: str
) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / file).symlink_to("/dev/full")
    assert main(["slam", str(stand_in / "other.log"), "--out", str(out)]) == 2
    output = capsys.readouterr().err.splitlines()[-1]
    assert output.startswith(f"trident: {out}")
    assert output.endswith(": No space left on device")


def test_bags_go_to_their_reader(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(offline, "program", lambda package, name: name)
    bag = tmp_path / "a.log"
    bag.write_bytes(b"#ROSBAG V2.0\n")
    run = offline.Run(bag, "m", tmp_path, tmp_path / "c.yaml", ("--scan", "/s"))
    words = ["slam_offline_bag", str(bag), "--method", "m", "--config", str(tmp_path / "c.yaml")]
    assert offline.command(run) == [*words, "--out", str(tmp_path), "--scan", "/s"]
    with pytest.raises(EvalError, match="a CARMEN log or a rosbag"):
        offline.command(offline.Run(tmp_path / "none.bag", "m", tmp_path))


@pytest.mark.parametrize("name", ["slam_offline", "slam_offline_bag", "landmark_offline"])
def test_an_error_is_said_by_the_caller_alone(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
    name: str,
) -> None:
    words = ["sh", "-c", f"echo warning: odd >&2; echo {name}: a.bag: damaged >&2; exit 1"]
    monkeypatch.setattr(offline, "command", lambda run: words)
    with pytest.raises(EvalError, match=r"^warning: odd\na.bag: damaged$"):
        offline.run_log(offline.Run(tmp_path / "a.bag", "m", tmp_path))
    assert capfd.readouterr().err == "warning: odd\n"


def test_landmarks_go_to_their_filter(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(offline, "program", lambda package, name: f"{package}/{name}")
    run = offline.Run(tmp_path / "park.txt", offline.LANDMARK_METHOD, tmp_path)
    words = ["trident_slam/landmark_offline", str(tmp_path / "park.txt")]
    assert offline.command(run) == [*words, "--out", str(tmp_path)]


def test_the_bar_fills() -> None:
    assert offline.bar(50, 100).endswith("[###############...............]  50 %  100 scans")


def test_a_map_without_a_cell_is_reported_in_one_sentence(
    stand_in: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    program = PROGRAM.replace("P5 2 2 255 \\000\\376\\376\\315", "P5\\n0 0\\n255\\n")
    (tmp_path / "slam_offline").write_text(program)
    assert main(["slam", str(stand_in / "other.log"), "--out", str(tmp_path / "out")]) == 2
    assert "map.pgm: the map is empty: no scan has a return" in capsys.readouterr().err


def test_a_map_that_is_too_large_is_kept_and_not_drawn(
    stand_in: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    program = PROGRAM.replace("P5 2 2 255 \\000\\376\\376\\315", "P5\\n600000 600000\\n255\\n")
    (tmp_path / "slam_offline").write_text(program)
    assert main(["slam", str(stand_in / "other.log"), "--out", str(tmp_path / "out")]) == 0
    said = capsys.readouterr()
    assert "600000 x 600000 cells: too many to be drawn and judged" in said.err
    assert (tmp_path / "out" / "evaluation.json").exists()


def test_what_a_binary_file_makes_the_program_say_is_shown(
    stand_in: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    script = "#!/bin/sh\nprintf 'bad.yaml: \\311\\377 is no YAML\\n' >&2; exit 1\n"
    (tmp_path / "slam_offline").write_text(script)
    assert main(["slam", str(stand_in / "other.log"), "--out", str(tmp_path / "out")]) == 2
    assert "is no YAML" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["zero", "urandom"])
def test_a_device_is_no_log(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["slam", f"/dev/{name}"]) == 2
    assert f"/dev/{name}: a device; legal: a CARMEN log or a rosbag" in capsys.readouterr().err
