# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident mission`: a mission is flown, judged and drawn; trees are checked and drawn."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from trident_eval.mission.__main__ import FAILED, PASSED, UNUSABLE, main
from trident_eval.mission.goals import missed_goals
from trident_fleet.core.missions.record import Record
from trident_fleet.core.missions.setup import Outcome

TREE = """\
tree:
  selector:
    - sequence:
        - battery_low: {reserve: 12.0}
        - go_home: {}
    - search_by_gain: {}
"""


def outcome(coverage: float, found: int, served: int, contacts: int) -> Outcome:
    return Outcome(
        *(600.0, True, coverage, 12, found, found, served, 40, 90.0, (), {}, contacts, 9, (), ())
    )


def test_what_is_missed_is_named_with_its_limit() -> None:
    assert missed_goals(outcome(0.98, 12, 12, 0)) == []
    assert missed_goals(outcome(0.5, 12, 11, 2)) == [
        "coverage is 50.0 %, the limit 97 %",
        "served is 91.7 %, the limit 95 %",
        "2 contacts, the limit is 0",
    ]


def test_a_mission_leaves_a_verdict_and_pictures(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["fly", "--seed", "3", "--until", "20", "--kill", "usv1@10", "--out", str(tmp_path)]
    assert main(words) == FAILED
    verdict = json.loads((tmp_path / "verdict.json").read_text())
    assert not verdict["passed"]
    assert verdict["end_s"] == 20.0
    assert 0.0 < verdict["coverage"] < 0.2
    assert "usv1: killed at 10 s" in verdict["lost"]
    for name in ("map.png", "times.png"):
        assert (tmp_path / name).stat().st_size > 10_000
    said = capsys.readouterr().out
    assert "usv1: killed at 10 s" in said
    assert "verdict             FAIL" in said


def test_work_begins_and_ends_with_the_task() -> None:
    record = Record()
    for now_s, task in ((1.0, None), (2.0, ("a", "serve")), (3.0, ("a", "serve"))):
        record.note_task("uav1", now_s, task)
    record.note_task("uav1", 5.0, ("b", "search"))
    record.note_task("uav1", 6.0, None)
    spans = [(work.task_id, work.kind, work.begin_s, work.end_s) for work in record.work]
    assert spans == [("a", "serve", 2.0, 5.0), ("b", "search", 5.0, 6.0)]


def test_a_tree_is_printed_and_drawn(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, picture = tmp_path / "tree.yaml", tmp_path / "tree.png"
    file.write_text(TREE)
    assert main(["check", str(file)]) == PASSED
    assert capsys.readouterr().out.splitlines()[:3] == [
        "selector",
        "  sequence",
        "    battery_low (reserve 12, detour 0.1)",
    ]
    assert main(["draw", str(file), "--out", str(picture)]) == PASSED
    assert picture.stat().st_size > 3_000


@pytest.mark.parametrize(
    ("words", "what"),
    [
        (["fly", "--mode", "quad"], "mode is 'quad', legal: joint, uav"),
        (["fly", "--kill", "uav1"], "--kill uav1; legal: ROBOT@SECONDS"),
        (["fly", "--kill", "uav1@nan"], "legal: ROBOT@SECONDS, finite, from 0"),
        (["fly", "--kill", "uav9@5"], "robot is 'uav9', legal: uav1, ugv1, usv1"),
        (["fly", "--links", "radio"], "links is 'radio', legal: network, perfect"),
        (["fly", "--scene", "absent.yaml"], "absent.yaml"),
        (["check", "absent.yaml"], "absent.yaml"),
    ],
)
def test_bad_words_are_refused(
    words: list[str], what: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words) == UNUSABLE
    assert what in capsys.readouterr().err


def test_a_wrong_tree_is_refused_with_its_place(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "tree.yaml"
    file.write_text(TREE.replace("go_home", "go_hom"))
    assert main(["check", str(file)]) == UNUSABLE
    assert "unknown node; legal: selector, sequence" in capsys.readouterr().err
