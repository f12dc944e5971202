# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from radio_runs import write_links
from trident_eval.core.errors import EvalError
from trident_eval.core.radio.link_trial import (
    LinkTrial,
    Station,
    add_trial,
    crossed,
    judge_trial,
    read_stations,
    read_trial,
)
from trident_eval.core.radio.links import LinkLog, read_links
from trident_eval.core.radio.station_plots import draw_stations
from trident_eval.core.report import table, verdict_rows
from trident_eval.core.tracks import Tracks
from trident_eval.core.verdict import Verdict

TRIAL = LinkTrial("usv1", "shore", 10.0, 0.05, 0.99)
GIVEN: dict[str, Any] = {
    "source": "usv1",
    "destination": "shore",
    "from_s": 10,
    "direct_limit": 0.05,
    "relayed_limit": 0.99,
}
FENCE = [[-20, -20], [20, -20], [20, 20], [-20, 20]]


def phase(time_s: float, name: str) -> dict[str, Any]:
    return {"time_s": time_s, "phase": name, "reason": "", "goal": [0, 0, 20], "found_db": None}


def station(*phases: dict[str, Any]) -> Station:
    record = {"vehicle": "uav1", "links": ["usv1", "shore"], "phases": list(phases)}
    where = {"places": {"shore": [0, 10, 3]}, "fence": FENCE, "lowest_m": 15.0, "highest_m": 30.0}
    return Station("uav1", record | where)


FLOWN = station(phase(0.1, "on the ground"), phase(20.0, "take-off"), phase(30.0, "survey"))


def run(folder: Path, direct: float, relayed: float) -> LinkLog:
    """Ten messages a second; the UAV takes off at 20 s and is up at 30 s."""
    lines, delivered = [], 0.0
    for tick in range(121):
        t = 0.5 * tick
        delivered += 5.0 * (relayed if t > 25.0 else direct) * (tick > 0)
        for one, other in (("usv1", "shore"), ("usv1", "uav1"), ("shore", "uav1")):
            counts = f"{round(delivered)},{5 * tick}" if other == "shore" else "0,0"
            lines.append(f"{t:.9g},{one},{other},80,{10 + tick % 7},3,0,0,0,0,1,{counts}")
            lines.append(f"{t:.9g},{other},{one},80,{10 + tick % 7},3,0,0,0,0,1,0,0")
    write_links(folder, lines)
    log = read_links(folder)
    assert log is not None
    return log


def test_what_crossed_in_a_span_is_counted(tmp_path: Path) -> None:
    log = run(tmp_path, 0.2, 1.0)
    share = crossed(log, TRIAL, 10.0, 20.0)
    assert (share.offered, share.delivered) == (100, 20)
    assert share.share == pytest.approx(0.2)
    assert crossed(log, LinkTrial("shore", "boat", 0.0, 0.0, 0.0), 0.0, 20.0).share is None


def test_a_run_is_held_against_both_limits(tmp_path: Path) -> None:
    numbers, reasons = judge_trial(run(tmp_path, 0.02, 1.0), TRIAL, [FLOWN])
    assert reasons == []
    assert (numbers["direct"]["from_s"], numbers["direct"]["to_s"]) == (10.0, 20.0)
    assert (numbers["relayed"]["from_s"], numbers["relayed"]["share"]) == (33.0, 1.0)
    _, reasons = judge_trial(run(tmp_path, 0.2, 0.9), TRIAL, [FLOWN])
    assert reasons == [
        "usv1 -> shore directly: 20.0 % delivered, limit below 5 %",
        "usv1 -> shore with uav1 up: 90.0 % delivered, limit 99 %",
    ]


def test_without_a_station_all_of_the_run_is_direct(tmp_path: Path) -> None:
    numbers, reasons = judge_trial(run(tmp_path, 0.02, 0.02), TRIAL, [])
    assert reasons == []
    assert numbers["direct"]["to_s"] == 60.0
    assert "relayed" not in numbers


def test_a_station_that_never_was_up_fails_the_run(tmp_path: Path) -> None:
    _, reasons = judge_trial(run(tmp_path, 0.0, 0.0), TRIAL, [station(phase(0.1, "on the ground"))])
    assert len(reasons) == 1
    assert "usv1 -> shore with uav1 up: no message was to cross" in reasons[0]


def test_a_verdict_has_rows_of_both_shares(tmp_path: Path) -> None:
    run(tmp_path, 0.02, 0.9)
    (tmp_path / "params.json").write_text(json.dumps({"parameters": {"link_trial": GIVEN}}))
    (tmp_path / "base_station_uav1.json").write_text(json.dumps(FLOWN.record))
    verdict = Verdict({"vehicles": ["usv1"]})
    add_trial(verdict, tmp_path)
    assert verdict.reasons == ["usv1 -> shore with uav1 up: 90.0 % delivered, limit 99 %"]
    direct, relayed = verdict_rows(verdict.to_json())[-2:]
    assert (direct.value, direct.is_satisfied) == ("2.0 %, 2 of 100, 10 s to 20 s", True)
    assert (relayed.limit, relayed.is_satisfied) == ("at least 99 %", False)
    assert "usv1 -> shore with base station" in table(verdict.to_json())


def test_a_run_that_is_held_against_nothing_has_no_rows(tmp_path: Path) -> None:
    verdict = Verdict({})
    add_trial(verdict, tmp_path)
    assert verdict.numbers == {}
    assert verdict.reasons == []


@pytest.mark.parametrize(
    ("given", "what"),
    [
        ("shore", "legal: a map of source, destination, from_s, direct_limit, relayed_limit"),
        ({"source": "usv1"}, "legal: a map of source"),
        (GIVEN | {"from_s": "noon"}, "legal: numbers for from_s, direct_limit, relayed_limit"),
    ],
)
def test_an_illegal_trial_is_refused(tmp_path: Path, given: Any, what: str) -> None:
    (tmp_path / "params.json").write_text(json.dumps({"parameters": {"link_trial": given}}))
    with pytest.raises(EvalError, match=what):
        read_trial(tmp_path)


@pytest.mark.parametrize("text", ["{", "[]", '{"vehicle": "uav1"}', '{"vehicle": 1, "phases": 3}'])
def test_a_file_that_is_no_record_is_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "base_station_uav1.json").write_text(text)
    with pytest.raises(EvalError, match="legal: the record of a base station"):
        read_stations(tmp_path)


def test_a_picture_is_drawn(tmp_path: Path) -> None:
    log = run(tmp_path, 0.0, 1.0)
    time = np.arange(0.0, 60.0, 0.5)
    position = np.zeros((len(time), 2, 3))
    position[:, 0] = np.column_stack([np.sin(time), np.cos(time), np.minimum(time, 20.0)])
    tracks = Tracks(["uav1", "usv1"], time, position)
    (path,) = draw_stations(tracks, log, [FLOWN], "a run", tmp_path)
    assert path.name == "base_station_uav1.png"
    assert path.stat().st_size > 30_000
    assert draw_stations(tracks, log, [Station("uav9", FLOWN.record)], "a run", tmp_path) == []
