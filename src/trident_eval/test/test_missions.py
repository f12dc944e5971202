# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Missions of several kinds of platforms, judged by where they were."""

from __future__ import annotations

import json
import math
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from trident_eval.__main__ import main
from trident_eval.core.errors import EvalError
from trident_eval.core.missions import follow, judge_missions, read_missions
from trident_eval.core.tracks import Tracks, tracks_of

RUN = {"rtf": 3.0, "state_hash": "cd" * 32, "sim_s": 20.0, "wall_s": 6.7}


def mission(kind: str, **more: Any) -> dict[str, Any]:
    places = [[10, 0, 5], [10, 10, 5]] if kind == "uav" else [[10, 0], [10, 10]]
    common = {"kind": kind, "waypoints": places, "reach": 0.5, "tracking_limit": 0.3}
    return common | {"start": [1.0, 2.0, 0.0, math.pi / 2]} | more


def folder_of(tmp_path: Path, **missions: dict[str, Any]) -> Path:
    parameters = {name: {"mission": given} for name, given in missions.items()}
    parameters["gazebo"] = {"seed": 1}
    text = json.dumps({"parameters": parameters, "files": {}})
    (tmp_path / "params.json").write_text(text)
    (tmp_path / "run.json").write_text(json.dumps(RUN))
    return tmp_path


def track(name: str, corners: list[list[float]], aside: float = 0.0) -> Tracks:
    """Along straight lines, a metre a second, `aside` of them in z for a UAV, else in x."""
    points = [np.array(corners[0], dtype=float)]
    for begin, end in pairwise(corners):
        a, b = np.array(begin, dtype=float), np.array(end, dtype=float)
        count = round(10 * float(np.linalg.norm(b - a)))
        points += [a + share * (b - a) for share in np.arange(1, count + 1) / count]
    moved = np.array(points)
    moved[1:-1, 0] += aside
    times = [0.1 * index for index in range(len(moved))]
    return tracks_of(times, [name] * len(moved), moved.tolist())


# 90 degrees to the left of the start at (1, 2): ahead is +y.
GROUND = [[1.0, 2.0, 0.0], [1.0, 12.0, 0.0], [-9.0, 12.0, 0.0]]
AIR = [[1.0, 2.0, 0.0], [1.0, 12.0, 5.0], [-9.0, 12.0, 5.0]]


@pytest.mark.parametrize(("kind", "corners"), [("uav", AIR), ("ugv", GROUND), ("usv", GROUND)])
def test_a_mission_along_its_lines_passes(
    kind: str, corners: list[list[float]], tmp_path: Path
) -> None:
    (one,) = read_missions(folder_of(tmp_path, r1=mission(kind)))
    verdict = judge_missions(track("r1", corners), [one], RUN)
    assert verdict.passed
    numbers = verdict.numbers["platforms"]["r1"]
    assert numbers["waypoints_reached"] == numbers["waypoints"] == 2
    assert numbers["tracking_rms_m"] == pytest.approx(0.0, abs=1e-9)
    assert verdict.numbers["rtf"] == 3.0


def test_the_error_is_the_distance_to_the_path(tmp_path: Path) -> None:
    (one,) = read_missions(folder_of(tmp_path, r1=mission("ugv")))
    straight = track("r1", [[1.0, 2.0, 0.0], [1.0, 11.0, 0.0]], aside=0.4)
    outcome = follow(straight, one)
    assert outcome.reached == 0
    assert outcome.error[1:-1] == pytest.approx(0.4)
    reasons = judge_missions(straight, [one], {}).reasons
    assert "r1: 0 of 2 waypoints reached" in reasons
    assert any(reason.startswith("r1: tracking RMS 0.3") for reason in reasons)


def test_places_count_in_their_order_only(tmp_path: Path) -> None:
    (one,) = read_missions(folder_of(tmp_path, r1=mission("usv")))
    backwards = track("r1", [GROUND[0], GROUND[2]])
    assert follow(backwards, one).reached == 0


def test_what_was_never_there_fails(tmp_path: Path) -> None:
    missions = read_missions(folder_of(tmp_path, r1=mission("ugv"), r2=mission("uav")))
    verdict = judge_missions(track("r1", GROUND), missions, RUN)
    assert verdict.reasons == ["r2: no states"]


@pytest.mark.parametrize(
    "bad", [{"kind": "submarine"}, {"start": [0, 0]}, {"waypoints": 3}, {"reach": "far"}]
)
def test_a_bad_mission_is_one_clear_error(bad: dict[str, Any], tmp_path: Path) -> None:
    with pytest.raises(EvalError, match=r"/r1/mission: .*legal: kind uav, ugv or usv"):
        read_missions(folder_of(tmp_path, r1=mission("ugv") | bad))


def test_a_run_of_missions_is_judged_and_drawn(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = folder_of(tmp_path, r1=mission("uav", reach=2.5), r2=mission("ugv"))
    lines = ["t,name,x,y,z"]
    for name, corners in (("r1", AIR), ("r2", GROUND), ("buoy", GROUND)):
        found = track(name, corners)
        for time, (x, y, z) in zip(found.time, found.position[:, 0], strict=True):
            if time <= 19.5:
                lines.append(f"{time},{name},{x},{y},{z - (name == 'buoy')}")
    (folder / "states.csv").write_text("\n".join(lines) + "\n")
    assert main(["verdict", str(folder)]) == 0
    shown = capsys.readouterr().out
    assert "2 of 2 waypoints" in shown
    assert "buoy" not in shown
    verdict = json.loads((folder / "verdict.json").read_text())
    assert verdict["pass"] is True
    assert verdict["state_hash"] == RUN["state_hash"]
    assert set(verdict["platforms"]) == {"r1", "r2"}
    assert (folder / "missions.png").stat().st_size > 10_000
    assert "missions.png" in (folder / "report.html").read_text()
