# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from runs import NAMES, Run
from trident_eval.__main__ import main

PICTURES = [
    "formation_error.png",
    "height.png",
    "paths.png",
    "separation.png",
    "tracking_error.png",
]


def assert_is_picture(path: Path) -> None:
    """Not blank: ink on a white ground, and more than a frame's worth of it."""
    from matplotlib.image import imread

    pixels = imread(path)[..., :3]
    assert min(pixels.shape[:2]) > 300
    ink = (pixels < 0.9).any(axis=-1).mean()
    assert 0.005 < ink < 0.5


def test_a_good_run_gets_its_verdict_and_its_pictures(
    planned_run: Run, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["verdict", str(planned_run.folder)]) == 0
    numbers = json.loads((planned_run.folder / "verdict.json").read_text())
    assert numbers["pass"] is True
    assert numbers["state_hash"] == "ab" * 32
    assert numbers["rtf"] == 25.0
    assert numbers["reasons"] == []
    for name in PICTURES:
        assert_is_picture(planned_run.folder / name)
    page = (planned_run.folder / "report.html").read_text()
    assert all(name in page for name in PICTURES)
    shown = capsys.readouterr().out
    assert "12 of 12" in shown
    assert "PASS" in shown


def test_a_bad_run_exits_with_one_and_says_why(
    planned_run: Run, capsys: pytest.CaptureFixture[str]
) -> None:
    planned_run.position[-1, 0] = np.nan
    planned_run.write()
    assert main(["verdict", "--no-pictures", str(planned_run.folder)]) == 1
    assert "UAV1: no finite state after" in capsys.readouterr().out
    assert json.loads((planned_run.folder / "verdict.json").read_text())["pass"] is False
    assert not list(planned_run.folder.glob("*.png"))


def test_a_run_that_left_nothing_fails(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["verdict", str(tmp_path)]) == 1
    assert "states.csv: No such file" in capsys.readouterr().out
    page = (tmp_path / "report.html").read_text()
    assert "FAIL" in page
    assert "states.csv: No such file" in page
    verdict = json.loads((tmp_path / "verdict.json").read_text())
    assert verdict["pass"] is False


@pytest.mark.parametrize(("steps", "code"), [(500, 0), (0, 1)])
def test_a_world_without_vehicles_passes_once_it_has_run(
    tmp_path: Path, steps: int, code: int
) -> None:
    (tmp_path / "states.csv").write_text("t,name,x,y,z\n")
    (tmp_path / "run.json").write_text(json.dumps({"steps": steps, "state_hash": "ab" * 32}))
    assert main(["verdict", "--no-pictures", str(tmp_path)]) == code


def test_the_verdict_is_printed_before_anything_is_drawn(
    planned_run: Run, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    shown: list[str] = []

    def draw(_scene: object, _folder: Path) -> list[Path]:
        shown.append(capsys.readouterr().out)
        return []

    monkeypatch.setattr("trident_eval.__main__.draw_all", draw)
    assert main(["verdict", str(planned_run.folder)]) == 0
    assert "PASS" in shown[0]
    assert (planned_run.folder / "verdict.json").is_file()


def test_no_folder_is_no_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["verdict", str(tmp_path / "none")]) == 2
    assert "no such folder" in capsys.readouterr().err


def test_a_broken_summary_is_reported(planned_run: Run, capsys: pytest.CaptureFixture[str]) -> None:
    (planned_run.folder / "run.json").write_text("{")
    assert main(["report", str(planned_run.folder)]) == 2
    assert "run.json: " in capsys.readouterr().err


def test_a_report_goes_where_it_is_wanted(planned_run: Run, tmp_path: Path) -> None:
    out = tmp_path / "elsewhere" / "report"
    assert main(["report", str(planned_run.folder), "--out", str(out)]) == 0
    assert {path.name for path in out.iterdir()} == {*PICTURES, "report.html"}
    assert not list(planned_run.folder.glob("*.png"))


def test_a_run_without_formation_has_paths_and_separation(planned_run: Run) -> None:
    for name in NAMES:
        (planned_run.folder / f"formation_{name}.json").unlink()
    assert main(["verdict", str(planned_run.folder)]) == 0
    drawn = sorted(path.name for path in planned_run.folder.glob("*.png"))
    assert drawn == ["height.png", "paths.png", "separation.png"]


def test_the_same_run_gives_the_same_pictures(planned_run: Run, tmp_path: Path) -> None:
    folders = [tmp_path / "a", tmp_path / "b"]
    for folder in folders:
        assert main(["report", str(planned_run.folder), "--out", str(folder)]) == 0
    for name in PICTURES:
        assert (folders[0] / name).read_bytes() == (folders[1] / name).read_bytes()
