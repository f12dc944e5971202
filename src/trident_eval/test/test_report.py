# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The page of a run: that it needs no other file, and says what the run was."""

from __future__ import annotations

import base64
import json
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from runs import NAMES, SUMMARY, Run
from trident_eval.__main__ import main
from trident_eval.core.errors import EvalError
from trident_eval.core.log_warnings import log_warnings
from trident_eval.core.provenance import Provenance, read_provenance
from trident_eval.core.report import verdict_rows
from trident_eval.core.scene import Scene
from trident_eval.core.tracks import Tracks
from trident_eval.core.vehicles import flights

LAUNCH: dict[str, Any] = {
    "command": ["./trident", "run", "fly.launch", "name:=two words"],
    "workspace": "/clone",
    "working_directory": "/clone",
    "launch_file": "/clone/launch/fly.launch",
    "args": {"name": "two words"},
    "commit": "c0ffee" * 6 + "abcd",
    "is_changed": False,
    "untracked": [],
    "version": "0.1.0",
    "inputs": {"/clone/launch/fly.launch": "12" * 32},
    "versions": {"libode-dev": "2:0.16.2-1"},
    "machine": {"cpu": "A <fast> one", "cores": "2"},
}


class Page(HTMLParser):
    """What a browser would fetch, show and link."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.images: dict[str, str] = {}
        self.fetched: list[str] = []
        self.links: list[str] = []
        self.words = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attrs}
        if tag == "img":
            self.images[values["alt"]] = values["src"]
        elif "src" in values or tag in ("link", "script", "iframe"):
            self.fetched.append(str(values))
        if tag == "a":
            self.links.append(values["href"])

    def handle_data(self, data: str) -> None:
        self.words += data


def report_of(folder: Path, *words: str) -> Page:
    assert main(["report", str(folder), *words]) == 0
    return Page((folder / "report.html").read_text(encoding="utf-8"))


@pytest.fixture
def launched_run(planned_run: Run) -> Run:
    """A run as ./trident run leaves it."""
    folder = planned_run.folder
    (folder / "launch.json").write_text(json.dumps(LAUNCH))
    tree = {"gazebo": {"seed": 3}, "UAV1": {"gain": [1, 2]}}
    saved = {"parameters": tree, "files": {"/data/f.txt": "34" * 32}}
    (folder / "params.json").write_text(json.dumps(saved))
    (folder / "run.json").write_text(json.dumps(SUMMARY | {"seed": 3, "steps": 100}))
    log = "fine\n\x1b[33m[ WARN] [1.0]: low battery\x1b[0m\n[ WARN] [2.5]: low battery\n"
    (folder / "roslaunch.log").write_text(log)
    return planned_run


def test_all_pictures_are_in_the_page_and_nothing_is_fetched(launched_run: Run) -> None:
    page = report_of(launched_run.folder, "--animate")
    files = {path.name for path in launched_run.folder.glob("*.png")} | {"animation.gif"}
    assert len(files) == 6
    assert set(page.images) == files
    for name, source in page.images.items():
        kind, _, data = source.partition(";base64,")
        assert kind == f"data:image/{name[-3:]}"
        assert base64.b64decode(data) == (launched_run.folder / name).read_bytes()
    assert page.fetched == []
    assert set(page.links) == files


def test_the_page_says_what_the_run_was_and_how_to_repeat_it(launched_run: Run) -> None:
    words = report_of(launched_run.folder).words
    for expected in (
        f"cd /clone\ngit checkout {LAUNCH['commit']}\n./trident run fly.launch 'name:=two words'",
        SUMMARY["state_hash"],
        "/clone/launch/fly.launch",
        "name:=",
        "/gazebo/seed",
        "/UAV1/gain",
        "[1, 2]",
        "34" * 32,
        "2:0.16.2-1",
        "A <fast> one",
        "matplotlib",
        "[ WARN] [2.5]: low battery",
    ):
        assert str(expected) in words, expected
    assert words.count("low battery") == 1
    assert "at least" in words
    assert "below 0.050 m" in words


def test_a_run_of_a_plain_roslaunch_has_a_page_too(planned_run: Run) -> None:
    page = report_of(planned_run.folder)
    assert "How to repeat it" not in page.words
    assert "PASS" in page.words


def test_an_animation_is_drawn_only_when_it_is_asked_for_and_then_stays(planned_run: Run) -> None:
    assert "animation.gif" not in report_of(planned_run.folder).images
    assert "animation.gif" in report_of(planned_run.folder, "--animate").images
    assert "animation.gif" in report_of(planned_run.folder).images


@pytest.mark.parametrize("name", ["launch.json", "params.json", "run.json"])
@pytest.mark.parametrize("text", ["{", "[1]"])
def test_what_no_run_has_written_is_refused(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(EvalError, match=name):
        read_provenance(tmp_path)


def test_a_broken_record_of_the_launch_costs_the_page_but_not_the_verdict(
    planned_run: Run, capsys: pytest.CaptureFixture[str]
) -> None:
    (planned_run.folder / "launch.json").write_text("{")
    assert main(["verdict", str(planned_run.folder)]) == 0
    assert "launch.json: " in capsys.readouterr().err


def test_uncommitted_changes_and_another_folder_are_part_of_the_repetition() -> None:
    launch = LAUNCH | {"is_changed": True, "working_directory": "/else where"}
    lines = Provenance(launch).repeat_commands()
    assert lines[0] == "cd /clone"
    assert lines[2].startswith("git apply changes.patch")
    assert lines[3] == "cd '/else where'"
    assert Provenance().repeat_commands() == []


def test_values_are_held_against_their_limits() -> None:
    verdict = {
        "vehicles": ["A"],
        "formation_rms_m": 0.05,
        "formation_rms_limit_m": 0.05,
        "min_separation_m": 1.2,
        "min_separation_limit_m": 1.2,
        "rows_flown": 3,
        "rows": 4,
        "rtf": 20.0,
    }
    satisfied = {row.label: row.is_satisfied for row in verdict_rows(verdict)}
    assert satisfied["formation RMS"] is False, "the limit itself is too much"
    assert satisfied["minimum separation"] is True
    assert satisfied["rows flown by all"] is False
    assert satisfied["real-time factor"] is None
    unknown = {row.label: row for row in verdict_rows(verdict | {"formation_rms_m": None})}
    assert unknown["formation RMS"].value == "unknown"
    assert unknown["formation RMS"].is_satisfied is False


def test_numbers_of_each_vehicle() -> None:
    time = np.array([0.0, 1.0, 2.0, 3.0])
    position = np.zeros((4, 2, 3))
    position[:, 0, 0] = [0.0, 3.0, 3.0, 3.0]
    position[:, 0, 2] = [0.0, 4.0, 4.0, 1.0]
    position[1:, 1] = np.nan
    commanded = position.copy()
    commanded[2, 0, 1] = 2.0
    commanded[0, 0, 1] = 50.0
    scene = Scene("s", Tracks(["A", "B"], time, position), commanded, counted_s=(1.0, 3.0))
    (flown,) = flights(scene)
    assert flown.name == "A"
    assert (flown.path_m, flown.highest_m, flown.fastest_m_s) == (8.0, 4.0, 5.0)
    assert flown.tracking_max_m == 2.0
    assert flown.tracking_rms_m == pytest.approx(np.sqrt(4.0 / 3.0))


def test_vehicles_without_a_command_have_no_tracking_error(planned_run: Run) -> None:
    for name in NAMES:
        (planned_run.folder / f"formation_{name}.json").unlink()
    assert "tracking RMS [m]" in report_of(planned_run.folder).words


def test_a_log_that_is_not_there_has_no_warnings(tmp_path: Path) -> None:
    assert log_warnings(tmp_path / "roslaunch.log") == []
