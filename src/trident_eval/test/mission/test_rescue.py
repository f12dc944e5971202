# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The verdict of a search and rescue in the simulator, by the record that its node leaves."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from trident_eval.core.errors import EvalError
from trident_eval.core.report import table
from trident_eval.core.rescue import draw_rescue, judge_rescue, read_rescue
from trident_eval.core.subjects import judge_subject
from trident_eval.core.tracks import Tracks
from trident_fleet.core.missions.record import Flown, Record, Work, read_flown, write_flown
from trident_fleet.core.missions.setup import RECORD, Outcome, Setup
from trident_fleet.core.missions.truth import PersonState
from trident_fleet.core.search.area import SearchError

SCENE = """seed: 4
size: [8, 6]
cell: 2
cells: cells.png
heights: {file: heights.png, lowest: -2, relief: 4}
environment: package://x/y.yaml
bases: {air: [1, 1], ground: [1, 2], water: [1, -1]}
covers: []
casualties:
  - {name: casualty_0, x: -1, y: -2, where: water}
  - {name: casualty_1, x: -1, y: 2, where: open}
"""
RUN = {"state_hash": "ab12", "sim_s": 640.1, "repeatable": True, "not_repeatable": []}


def flown(folder: Path, setup: Setup | None = None, **changes: object) -> Flown:
    """A joint mission that found both, and served one."""
    (folder / "coast.scene.yaml").write_text(SCENE, encoding="utf-8")
    Image.fromarray(np.full((3, 4), 5, dtype=np.uint8)).save(folder / "cells.png")
    Image.fromarray(np.zeros((3, 4), dtype=np.uint16)).save(folder / "heights.png")
    record = Record(
        {"uav1": [(0.0, 0.0), (1.0, 0.5)], "usv1": [(0.0, -1.0), (0.0, -2.0)]},
        [Work("uav1", "search/0_0", "search", 1.0, 9.5)],
        [(0.5, 0.1), (1.0, 0.5)],
        np.array([[True, False, True, True], [True] * 4, [False] * 4]),
    )
    outcome = Outcome(
        *(640.0, True, 0.98, 2, 2, 2, 1, 40, 90.0, (3.0, 5.5), {"uav1": 9.0, "usv1": 4.0}),
        *(0, 99, (0.1, 0.5), ("casualty_0: not served",)),
    )
    people = [
        PersonState("casualty_0", "water", 3.0, 9.0, None),
        PersonState("casualty_1", "ground", 5.5, 10.0, 40.0),
    ]
    return Flown(
        folder / "coast.scene.yaml",
        setup or Setup(seed=3),
        True,
        replace(outcome, **changes),  # type: ignore[arg-type]
        record,
        people,
        np.array([[-1.0, -2.0], [-1.0, 2.0]]),
    )


def test_a_record_is_read_as_it_was_written(tmp_path: Path) -> None:
    setup = Setup("joint", "plain", "perfect", 7, (("usv1", 30.0),), (("uav1", 1.0, 2.0),))
    made = flown(tmp_path, setup)
    write_flown(tmp_path / RECORD, made)
    read = read_flown(tmp_path / RECORD)
    assert (read.setup, read.outcome, read.whole) == (setup, made.outcome, True)
    assert read.people == made.people
    assert np.array_equal(read.places, made.places)
    assert read.record.tracks == made.record.tracks
    assert read.record.work == made.record.work
    assert read.record.coverage == made.record.coverage
    assert read.record.covered is not None
    assert np.array_equal(read.record.covered, made.record.covered)


@pytest.mark.parametrize("text", ["{", "{}", '{"setup": 3}', "[]"])
def test_a_record_that_is_another_is_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / RECORD).write_text(text, encoding="utf-8")
    with pytest.raises(EvalError, match=f"{RECORD}: .*legal: what the node"):
        read_rescue(tmp_path)
    with pytest.raises(SearchError, match="cannot be written"):
        write_flown(tmp_path / "absent" / RECORD, flown(tmp_path))


def test_a_joint_mission_is_held_against_its_goals(tmp_path: Path) -> None:
    verdict = judge_rescue(flown(tmp_path), RUN)
    assert verdict.reasons == ["served is 50.0 %, the limit 95 %"]
    assert verdict.numbers["state_hash"] == "ab12"
    assert verdict.numbers["lost"] == ["casualty_0: not served"]
    said = table(verdict.to_json())
    for text in (
        "joint, improved, links: network",
        "98.0 %  (limit: at least 97 %)",
        "1 of 2  (limit: at least 95 %)",
        "casualty_0: not served",
    ):
        assert text in said
    assert not judge_rescue(flown(tmp_path, served=2), RUN).reasons
    assert judge_rescue(flown(tmp_path, served=2, contacts=3), RUN).reasons == [
        "3 contacts, the limit is 0"
    ]


def test_who_is_alone_or_has_lost_somebody_has_other_limits(tmp_path: Path) -> None:
    alone = flown(tmp_path, Setup(mode="usv"), coverage=0.4)
    assert not judge_rescue(alone, RUN).reasons
    short = replace(flown(tmp_path, coverage=0.2), whole=False)
    assert not judge_rescue(short, RUN).reasons
    bereft = Setup(deaths=(("usv1", 30.0),))
    assert not judge_rescue(flown(tmp_path, bereft, coverage=0.86), RUN).reasons
    assert judge_rescue(flown(tmp_path, bereft, coverage=0.8), RUN).reasons == [
        "coverage is 80.0 %, the limit 85 %"
    ]


def test_pictures_are_drawn(tmp_path: Path) -> None:
    for picture in draw_rescue(flown(tmp_path), tmp_path):
        assert picture.stat().st_size > 10_000
    with pytest.raises(EvalError, match=r"absent\.yaml"):
        draw_rescue(replace(flown(tmp_path), scene_file=tmp_path / "absent.yaml"), tmp_path)


def test_a_mission_without_a_record_has_not_come_to_its_end(tmp_path: Path) -> None:
    parameters = {"parameters": {"search_and_rescue": {"mode": "usv"}}}
    (tmp_path / "params.json").write_text(json.dumps(parameters), encoding="utf-8")
    tracks = Tracks(["usv1"], np.array([0.0, 1.0]), np.zeros((2, 1, 3)))
    judged = judge_subject(tracks, tmp_path)
    assert judged is not None
    names, verdict = judged
    assert names == ["usv1"]
    assert verdict.reasons == [f"no {RECORD}: the mission did not come to its end"]
    assert "search and rescue" in table(verdict.to_json())
