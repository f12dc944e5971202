# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import io
import json
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from trident_fleet.cli import check_launch
from trident_fleet.core.errors import FormationError
from trident_fleet.core.file_check import check_formation, closest
from trident_fleet.core.files.formation_file import FormationSource
from trident_fleet.core.separation import min_separation
from trident_fleet.core.settings import FleetSettings

REPO = Path(__file__).resolve().parents[4]
MAIN_JOB = REPO / "launch" / "multi_uav_simulation.launch"
LOADER = REPO / "tools" / "trident_tool" / "launch" / "load_launch.py"
Checked = Callable[[list[str]], tuple[int, str, str]]


def written(path: Path, rows: np.ndarray) -> Path:
    path.write_text("".join(f"1 {x} {y} {z}\n" for x, y, z in rows.reshape(-1, 3)))
    return path


def crossing(steps: int = 30) -> np.ndarray:
    """Four vehicles 2 m apart on a line; the last flies across the others, 0.7 m over the first."""
    rows = np.zeros((steps, 4, 3))
    rows[..., 0] = 0.05 * np.arange(steps)[:, None]
    rows[..., 1] = 2.0 * np.arange(4)
    rows[..., 2] = 1.0
    rows[:, 0, 2], rows[:, 3, 2] = 1.1, 1.8
    along = np.linspace(6.0, -6.0, steps)  # passes y = 0 between two rows
    rows[:, 3, 1] = along
    return rows


def test_the_closest_two_are_named_with_the_row_before() -> None:
    rows = crossing()
    near = closest(rows)
    assert near is not None
    assert near.distance_m == pytest.approx(min_separation(rows), abs=1e-12)
    assert near.distance_m == pytest.approx(0.7, abs=1e-6)
    assert near.vehicles == (0, 3)
    before, after = rows[near.row, 3, 1], rows[near.row + 1, 3, 1]
    assert before >= 0.0 >= after


def test_many_rows_are_searched_in_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = closest(crossing())
    monkeypatch.setattr("trident_fleet.core.file_check._NUMBERS_AT_ONCE", 7 * 18)
    assert closest(crossing()) == whole


def test_a_lone_vehicle_has_no_closest_two() -> None:
    assert closest(np.zeros((3, 1, 3))) is None


def test_vehicles_that_come_too_close_are_said(tmp_path: Path) -> None:
    file = written(tmp_path / "cross.txt", crossing())
    source = FormationSource(str(file), vehicles_in_file=4)
    (line,) = check_formation(FleetSettings(source))
    assert line.startswith(f"{file}: vehicles ")
    assert "come within 0.700 m of each other at row" in line
    assert line.endswith("below min_separation 1 m")
    assert check_formation(FleetSettings(FormationSource(str(file), 4, uavs=3))) == []


def test_a_row_too_far_away_is_refused(tmp_path: Path) -> None:
    file = written(tmp_path / "far.txt", crossing() * 1e4)
    what = rf"{file}: row \d+, vehicle \d: .* legal: .* <= 10000 m"
    with pytest.raises(FormationError, match=what):
        check_formation(FleetSettings(FormationSource(str(file), 4)))


def plan_of(file: Path, words: list[str]) -> str:
    """What a launch file would start, as JSON."""
    command = ["/usr/bin/python3", str(LOADER), str(file), *words]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


@pytest.fixture
def checked(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> Callable[[list[str]], tuple[int, str, str]]:
    """Exit code and words of a check of the main job with some arguments."""

    def check(words: list[str]) -> tuple[int, str, str]:
        monkeypatch.setattr("sys.stdin", io.StringIO(plan_of(MAIN_JOB, words)))
        code = check_launch.main()
        return (code, *capfd.readouterr())

    return check


def test_the_launch_file_is_read_with_its_arguments(tmp_path: Path, checked: Checked) -> None:
    file = written(tmp_path / "cross.txt", crossing())
    words = [f"formation_file:={file}", "uavs:=4"]
    (settings,) = check_launch.formations(json.loads(plan_of(MAIN_JOB, words)))
    assert settings.source.uavs == 4
    code, report, _ = checked(words)
    assert (code, "come within 0.700 m" in report) == (0, True)
    assert checked([*words, "scale_z:=3", "offset_z:=-1"]) == (0, "", "")
    code, _, error = checked(words[:1])
    assert (code, "uavs: 6, but" in error) == (1, True)


def test_a_row_below_where_the_vehicles_are_spawned_is_refused(tmp_path: Path) -> None:
    file = written(tmp_path / "low.txt", crossing())
    settings = FleetSettings(FormationSource(str(file), 4))
    assert check_formation(settings, lowest_m=1.0)
    with pytest.raises(FormationError, match=rf"{file}: row 1, .*; legal: z >= spawn height 1.05"):
        check_formation(settings, lowest_m=1.05)


@pytest.mark.parametrize(
    ("words", "what"),
    [
        (["formation_file:=/nowhere/f.txt"], "/nowhere/f.txt: No such file"),
        (["scale_x:=0"], "scale_x: 0.0; legal"),
        (["mode:=walk"], "mode: 'walk'; legal: time, gate"),
    ],
)
def test_a_launch_that_cannot_fly_is_reported_in_one_line(
    words: list[str], what: str, checked: Checked
) -> None:
    code, _, error = checked(words)
    assert code == 1
    assert what in error
    assert len(error.splitlines()) == 1


def test_a_launch_file_without_formations_has_nothing_to_be_said() -> None:
    plan = json.loads(plan_of(REPO / "launch" / "robot_in_room.launch", []))
    assert check_launch.formations(plan) == []
