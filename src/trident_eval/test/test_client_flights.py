# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs that a MAVLink client has commanded: judged by what vehicles said and by where they were."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from trident_eval.__main__ import main
from trident_eval.core.bridges.client_flights import (
    RECORD,
    client_rows,
    judge_client_flights,
    judge_piloted,
    read_client_record,
)
from trident_eval.core.errors import EvalError
from trident_eval.core.report import table
from trident_eval.core.tracks import Tracks, tracks_of
from trident_eval.mavlink.errands import read_errands

ENTRY: dict[str, Any] = {
    "kind": "ugv",
    "radius": 1.0,
    "end": "hold",
    "places_wanted": 2,
    "start": [0.0, 0.0, 0.0],
    "places": [[10.0, 0.0, 0.0], [10.0, 10.0, 0.0]],
    "armed": True,
    "uploaded": 3,
    "downloaded_equal": True,
    "reached": [1, 2],
    "ended": True,
    "refusals": 0,
    "texts": ["Armed."],
    "problem": "",
}


def drive(corners: list[list[float]]) -> Tracks:
    """Along straight lines, a metre a step."""
    points = [np.array(corners[0])]
    for end in corners[1:]:
        begin = points[-1]
        count = round(float(np.linalg.norm(np.array(end) - begin)))
        points += [begin + (np.array(end) - begin) * step / count for step in range(1, count + 1)]
    times = [float(index) for index in range(len(points))]
    return tracks_of(times, ["ugv1"] * len(points), [point.tolist() for point in points])


WHOLE = drive([[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0, 10.0, 0.0]])


def reasons(tracks: Tracks = WHOLE, **changed: Any) -> list[str]:
    return judge_client_flights(tracks, {"ugv1": ENTRY | changed}, {}).reasons


def test_a_vehicle_that_did_all_of_it_passes() -> None:
    verdict = judge_client_flights(WHOLE, {"ugv1": ENTRY}, {"state_hash": "ab"})
    assert verdict.passed, verdict.reasons
    assert "2 of 2 items (2 reported), held, 0 refusals" in table(verdict.to_json())


@pytest.mark.parametrize(
    ("changed", "reason"),
    [
        ({"armed": False}, "ugv1: not armed"),
        ({"downloaded_equal": False}, "ugv1: its mission did not come back as it was sent"),
        ({"reached": [0, 1]}, "ugv1: 1 of 2 items reported as reached"),
        ({"ended": False}, "ugv1: not held"),
        ({"refusals": 2}, "ugv1: 2 refusals, the last of its texts: Armed."),
        ({"problem": "arming: not within 20 s"}, "ugv1: arming: not within 20 s"),
    ],
)
def test_what_a_vehicle_did_not_do_is_a_reason(changed: dict[str, Any], reason: str) -> None:
    verdict = judge_client_flights(WHOLE, {"ugv1": ENTRY | changed}, {})
    assert verdict.reasons == [reason]
    assert [row.is_satisfied for row in client_rows(verdict.to_json())] == [False]


def test_a_place_that_was_reported_but_not_passed_is_a_reason() -> None:
    short = drive([[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0, 6.0, 0.0]])
    assert reasons(short) == ["ugv1: 1 of 2 items passed"]


def test_a_client_that_got_nowhere_fails_with_its_reason() -> None:
    found = reasons(start=[], places=[], uploaded=0, reached=[], problem="telemetry: not within")
    assert "ugv1: telemetry: not within" in found
    assert "ugv1: 0 of 2 items passed" in found


def test_without_a_record_vehicles_only_have_to_be_there() -> None:
    assert judge_piloted(WHOLE, ["ugv1"], {}).passed
    assert judge_piloted(WHOLE, ["usv1"], {}).reasons == ["usv1: no finite state at the end"]


def test_a_record_that_is_none_is_one_error(tmp_path: Path) -> None:
    assert read_client_record(tmp_path) == {}
    (tmp_path / RECORD).write_text('{"vehicles": {"ugv1": {"kind": "ugv"}}}')
    with pytest.raises(EvalError, match=r"vehicles\.ugv1: no armed"):
        read_client_record(tmp_path)
    (tmp_path / RECORD).write_text("[]")
    with pytest.raises(EvalError, match=r"legal: what mavlink_demo\.py writes"):
        read_client_record(tmp_path)


def test_the_folder_of_a_run_becomes_a_verdict_and_a_picture(tmp_path: Path) -> None:
    (tmp_path / RECORD).write_text(json.dumps({"vehicles": {"ugv1": ENTRY}}))
    (tmp_path / "run.json").write_text(json.dumps({"state_hash": "ab", "sim_s": 20.0}))
    rows = zip(WHOLE.time, WHOLE.position[:, 0], strict=True)
    lines = [f"{t},ugv1,{x},{y},{z}" for t, (x, y, z) in rows]
    (tmp_path / "states.csv").write_text("t,name,x,y,z\n" + "\n".join(lines) + "\n")
    assert main(["verdict", str(tmp_path)]) == 0
    assert (tmp_path / "missions.png").is_file()
    verdict = json.loads((tmp_path / "verdict.json").read_text())
    assert verdict["commanded"]["ugv1"]["items_passed"] == 2


def test_errands_that_are_not_legal_are_named(tmp_path: Path) -> None:
    path = tmp_path / "errands.yaml"
    path.write_text("errands: [{vehicle: a, system: 1, kind: uav, radius: 1, places: [[1, 2, 3]]}]")
    assert read_errands(path)[0].places == ((1.0, 2.0, 3.0),)
    for text, part in [
        ("errands: [{vehicle: a, sys: 1}]", "sys"),
        ("errands: [{vehicle: a, system: 1, kind: plane, radius: 1, places: []}]", "legal: a list"),
        (
            "errands: [{vehicle: a, system: 1, kind: uav, radius: 1, places: [[1, 2]]}]",
            "errands[0]",
        ),
        ("[]", "legal: a list"),
        ("errands: {", "legal: a list"),
    ]:
        path.write_text(text)
        with pytest.raises(EvalError) as found:
            read_errands(path)
        assert part in str(found.value), found.value


def test_a_run_whose_vehicles_never_came_fails(tmp_path: Path) -> None:
    (tmp_path / "states.csv").write_text("t,name,x,y,z\n")
    (tmp_path / "run.json").write_text(json.dumps({"steps": 500}))
    assert main(["verdict", str(tmp_path), "--no-pictures"]) == 0, "a world alone"
    mission = {"kind": "ugv", "start": [0.0, 0.0, 0.0, 0.0]}
    parameters = {"parameters": {"ugv1": {"mission": mission}}}
    (tmp_path / "params.json").write_text(json.dumps(parameters))
    assert main(["verdict", str(tmp_path), "--no-pictures"]) == 1
