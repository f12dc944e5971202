# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What radios carried: how it is read, and judged."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from radio_runs import HEADER, add_relay, call_entry, entry, three_radios, write_links
from runs import Run
from trident_eval.__main__ import main
from trident_eval.core.errors import EvalError
from trident_eval.core.radio.calls import judge_calls
from trident_eval.core.radio.links import read_links
from trident_eval.core.radio.radio_verdict import add_links
from trident_eval.core.radio.relay import judge_links, read_relay
from trident_eval.core.report import table, verdict_rows
from trident_eval.core.rows import Row
from trident_eval.core.verdict import Verdict

GOOD_LINE = "0.5,a,b,10,20,7,1,0,0,0,1,0,0"
ODOMETRY, DETECTIONS = "rule 1 (odometry)", "rule 2 (detections)"


def broadcast(**counts: int) -> dict[str, Any]:
    """As it was sent: it arrives in the entries of its receivers."""
    sent = {"reliable": False, "deadline_s": 0.0, "delivered": 0}
    none = {"delay_mean_s": 0.0, "delay_max_s": 0.0}
    return entry(ODOMETRY, "uav1", "all", **sent, **none) | counts


def heard(destination: str, delivered: int) -> dict[str, Any]:
    """The entry of a receiver of a broadcast."""
    more = {"reliable": False, "deadline_s": 0.0, "offered": 0, "delivered": delivered}
    return entry(ODOMETRY, "uav1", destination, **more)


def test_links_are_read_in_any_order(tmp_path: Path) -> None:
    lines = ["1,b,a,12.5,-inf,0,3,2,1,4,0,0,0", GOOD_LINE, "1,a,b,12.5,19.5,7,5,0,0,0,1,0,0"]
    write_links(tmp_path, lines)
    log = read_links(tmp_path)
    assert log is not None
    assert log.pairs == [("a", "b"), ("b", "a")]
    np.testing.assert_array_equal(log.time, [0.5, 1.0])
    np.testing.assert_array_equal(log.snr_db, [[20.0, np.nan], [19.5, -np.inf]])
    np.testing.assert_array_equal(log.delivered[1], [5, 3])
    last = [log.lost, log.expired, log.refused, log.line_of_sight, log.distance, log.mcs]
    assert [values[1, 1] for values in last] == [2, 1, 4, 0, 12.5, 0]


@pytest.mark.parametrize("text", [None, "", HEADER[:20], HEADER, HEADER + "\n", HEADER + "\n0.5,a"])
def test_a_run_without_radios_or_with_no_time_for_them_has_no_links(
    tmp_path: Path, text: str | None
) -> None:
    if text is not None:
        (tmp_path / "links.csv").write_text(text)
    assert read_links(tmp_path) is None


def test_a_torn_last_line_is_left_out(tmp_path: Path) -> None:
    path = write_links(tmp_path, [GOOD_LINE])
    path.write_text(path.read_text() + "1.0,a,b,10,2")
    log = read_links(tmp_path)
    assert log is not None
    assert len(log.time) == 1


@pytest.mark.parametrize(
    ("line", "what"),
    [
        ("x,a,b,10,20,7,1,0,0,0,1,0,0", "links.csv:3: t: 'x'; legal: seconds, at most 1e9"),
        ("nan,a,b,10,20,7,1,0,0,0,1,0,0", "links.csv:3: t: 'nan'; legal: seconds"),
        ("1,,b,10,20,7,1,0,0,0,1,0,0", "links.csv:3: source: ''; legal: the name of a radio"),
        ("1,a,b,-1,20,7,1,0,0,0,1,0,0", "links.csv:3: distance: '-1'; legal: meters, at least 0"),
        ("1,a,b,10,inf,7,1,0,0,0,1,0,0", "links.csv:3: snr_db: 'inf'; legal: dB, or -inf"),
        ("1,a,b,10,nan,7,1,0,0,0,1,0,0", "links.csv:3: snr_db: 'nan'; legal: dB, or -inf"),
        ("1,a,b,10,20,7.5,1,0,0,0,1,0,0", "links.csv:3: mcs: '7.5'; legal: a whole number"),
        ("1,a,b,10,20,7,-1,0,0,0,1,0,0", "links.csv:3: delivered: '-1'; legal: a whole number, at"),
        ("1,a,b,10,20,7,1,inf,0,0,1,0,0", "links.csv:3: lost: 'inf'; legal: a whole number, at"),
        ("1,a,b,10,20,7,1,0,0,0,2,0,0", "links.csv:3: line_of_sight: '2'; legal: 0 or 1"),
        ("1,a,b,10,20", "links.csv:3: mcs: None; legal: a whole number"),
        ("1", "links.csv:3: source: None; legal: the name of a radio"),
    ],
)
def test_a_damaged_line_is_named(tmp_path: Path, line: str, what: str) -> None:
    write_links(tmp_path, [GOOD_LINE, line])
    with pytest.raises(EvalError) as caught:
        read_links(tmp_path)
    assert what in str(caught.value)


def test_other_columns_and_other_bytes_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "links.csv"
    path.write_text("t,source\n0,a\n")
    with pytest.raises(EvalError, match=r"links.csv:1: no column destination, distance, snr_db"):
        read_links(tmp_path)
    path.write_bytes(HEADER.encode() + b"\n\xff\n")
    with pytest.raises(EvalError, match=r"links.csv: .*; legal: a readable links.csv"):
        read_links(tmp_path)
    path.unlink()
    path.mkdir()
    with pytest.raises(EvalError, match=r"links.csv: Is a directory"):
        read_links(tmp_path)


def test_entries_of_rules_are_read() -> None:
    (flow,) = read_relay({"relay": [entry(DETECTIONS, "uav1", "usv1", offered=70, thinned=4)]}, "r")
    assert (flow.rule, flow.source, flow.destination) == (DETECTIONS, "uav1", "usv1")
    assert flow.reliable
    assert flow.to_send == 66
    assert read_relay({}, "r") == []


@pytest.mark.parametrize(
    ("change", "what"),
    [
        ({"rule": ""}, "run.json: relay[1].rule: ''; legal: a text that is not empty"),
        ({"reliable": 1}, "run.json: relay[1].reliable: 1; legal: true or false"),
        ({"offered": 1.5}, "run.json: relay[1].offered: 1.5; legal: a whole number, at least 0"),
        ({"offered": True}, "run.json: relay[1].offered: True; legal: a whole number"),
        ({"delivered": -1}, "run.json: relay[1].delivered: -1; legal: a whole number"),
        ({"deadline_s": "3"}, "run.json: relay[1].deadline_s: '3'; legal: a number, at least 0"),
        ({"delay_max_s": float("nan")}, "run.json: relay[1].delay_max_s: nan; legal: a number"),
        ({"thinned": 61}, "run.json: relay[1].thinned: 61; legal: at most offered, 60"),
    ],
)
def test_a_damaged_entry_is_named(change: dict[str, Any], what: str) -> None:
    good = entry(DETECTIONS, "uav1", "usv1")
    with pytest.raises(EvalError) as caught:
        judge_links({"relay": [good, good | change]})
    assert what in str(caught.value)


@pytest.mark.parametrize(
    ("relay", "what"),
    [
        ({}, "run.json: relay: {}; legal: a list of objects"),
        ([3], "run.json: relay[0]: 3; legal: an object"),
        ([{"rule": "a"}], "run.json: relay[0].reliable: missing; legal: true or false"),
    ],
)
def test_what_is_no_list_of_entries_is_refused(relay: Any, what: str) -> None:
    with pytest.raises(EvalError) as caught:
        judge_links({"relay": relay})
    assert what in str(caught.value)


def test_each_destination_has_its_share_and_its_delays() -> None:
    lost = entry(DETECTIONS, "uav1", "gcs", offered=64, thinned=4, delivered=15)
    rows, reasons = judge_links({"relay": [lost, entry(DETECTIONS, "uav1", "usv1")]})
    assert reasons == []
    assert [(row["destination"], row["offered"], row["share"]) for row in rows] == [
        ("gcs", 60, 0.25),
        ("usv1", 60, 1.0),
    ]
    assert rows[1]["delay_mean_s"] == 0.0012
    assert rows[1]["delay_max_s"] == 0.004
    assert all(row["satisfied"] for row in rows)


def test_a_broadcast_is_held_against_what_was_sent_once() -> None:
    relay = [broadcast(offered=330, thinned=30), heard("ugv1", 150), heard("usv1", 300)]
    rows, reasons = judge_links({"relay": relay})
    assert reasons == []
    shares = [(row["destination"], row["offered"], row["share"]) for row in rows]
    assert shares == [("ugv1", 300, 0.5), ("usv1", 300, 1.0)]


@pytest.mark.parametrize(
    "relay",
    [
        [broadcast(offered=330, thinned=30)],
        [broadcast(offered=300), heard("ugv1", 0)],
        [
            entry(ODOMETRY, "uav1", "ugv1", offered=300, delivered=0),
            entry(ODOMETRY, "uav1", "usv1", offered=310, thinned=10, delivered=0),
        ],
    ],
)
def test_a_rule_of_which_nothing_arrives_fails_the_run(relay: list[dict[str, Any]]) -> None:
    rows, reasons = judge_links({"relay": [*relay, entry(DETECTIONS, "uav1", "usv1")]})
    assert reasons == ["rule 1 (odometry): nothing of 300 messages of uav1 has arrived"]
    assert [row["satisfied"] for row in rows] == [False] * (len(rows) - 1) + [True]
    assert rows[0]["delay_max_s"] is None


@pytest.mark.parametrize(("first_s", "is_reason"), [(59.98, False), (59.1, False), (58.9, True)])
def test_what_was_sent_at_the_very_end_may_still_be_on_its_path(
    first_s: float, is_reason: bool
) -> None:
    single = entry(DETECTIONS, "uav1", "usv1", offered=1, delivered=0, first_s=first_s)
    rows, reasons = judge_links({"sim_s": 60.0, "relay": [single]})
    assert bool(reasons) == is_reason
    assert rows[0]["satisfied"] != is_reason
    assert rows[0]["share"] == 0.0


ARM = "rule 3 (arm)"


def test_calls_are_judged_by_their_answers() -> None:
    some = call_entry(ARM, "usv1", "uav1", called=6, failed=1)  # one is in progress
    none = call_entry(ARM, "ugv1", "uav1", called=3, answered=0, expired=1, failed=1)
    begun = call_entry(ARM, "gcs", "uav1", called=1, answered=0)
    rows, reasons = judge_calls({"calls": [some, none, begun]})
    assert reasons == ["rule 3 (arm): none of 2 calls of uav1 by ugv1 was answered"]
    assert [row["satisfied"] for row in rows] == [True, False, True]
    assert rows[0]["delay_max_s"] == 0.0041
    assert rows[1]["delay_max_s"] is None


def test_a_damaged_call_is_named() -> None:
    with pytest.raises(EvalError) as caught:
        judge_calls({"calls": [call_entry(ARM, "usv1", "uav1") | {"server": ""}]})
    assert "run.json: calls[0].server: ''; legal: a text that is not empty" in str(caught.value)


def test_calls_have_rows_of_their_own() -> None:
    rows, _ = judge_calls({"calls": [call_entry(ARM, "usv1", "uav1", called=5, expired=1)]})
    (row,) = [row for row in verdict_rows({"calls": rows}) if "usv1" in row.label]
    assert row == Row(
        "arm usv1 -> uav1",
        "4 of 5 calls answered, delay 3.2 ms, at most 4.1 ms",
        "delay at most 5 s",
        True,
    )


def test_each_source_of_a_rule_is_judged_apart() -> None:
    relay = [
        entry(DETECTIONS, "uav1", "usv1", offered=1, delivered=0),
        entry(DETECTIONS, "uav2", "usv1"),
        entry(DETECTIONS, "uav3", "usv1", offered=7, thinned=7, delivered=0),
    ]
    rows, reasons = judge_links({"relay": relay})
    assert reasons == ["rule 2 (detections): nothing of 1 message of uav1 has arrived"]
    assert rows[2]["share"] is None
    assert rows[2]["satisfied"], "nothing was to be sent"


@pytest.mark.parametrize(
    ("deadline_s", "delay_s", "is_late"),
    [(0.5, 0.5, False), (0.5, 0.5 + 1e-10, False), (0.5, 0.501, True), (0.0, 99.0, False)],
)
@pytest.mark.parametrize("is_reliable", [True, False])
def test_a_message_after_its_deadline_fails_the_run(
    deadline_s: float, delay_s: float, is_late: bool, is_reliable: bool
) -> None:
    times = {"deadline_s": deadline_s, "delay_max_s": delay_s, "reliable": is_reliable}
    rows, reasons = judge_links({"relay": [entry(DETECTIONS, "uav1", "usv1", **times)]})
    late = "rule 2 (detections): a message of uav1 reached usv1 after 0.501 s, deadline 0.5 s"
    assert reasons == ([late] if is_late else [])
    assert rows[0]["satisfied"] is not is_late


def test_rows_for_people_are_short(tmp_path: Path) -> None:
    slow = {"deadline_s": 0.0, "delay_mean_s": 0.25, "delay_max_s": 2.345}
    relay = [
        entry(DETECTIONS, "uav1", "usv1"),
        entry("no topic", "usv1", "uav1", **slow),
        entry(ODOMETRY, "ugv1", "uav1", deadline_s=0.0, delivered=0),
    ]
    add_relay(tmp_path, relay)
    verdict = Verdict({"vehicles": []})
    add_links(verdict, tmp_path)
    assert verdict_rows(verdict.to_json())[1:] == [
        Row(
            "detections uav1 -> usv1",
            "60 of 60, delay 1.2 ms, at most 4.0 ms",
            "delay at most 30 s",
            True,
        ),
        Row("no topic usv1 -> uav1", "60 of 60, delay 250.0 ms, at most 2.35 s"),
        Row("odometry ugv1 -> uav1", "0 of 60", "", False),
    ]
    assert "detections uav1 -> usv1  60 of 60, delay 1.2 ms" in table(verdict.to_json())


def test_a_run_without_rules_has_the_verdict_that_it_had(planned_run: Run) -> None:
    verdict = Verdict({"vehicles": []})
    add_links(verdict, planned_run.folder)
    assert verdict.numbers == {"vehicles": []}
    assert verdict.passed


def test_a_damaged_entry_is_a_reason_against_the_run(tmp_path: Path) -> None:
    add_relay(tmp_path, [{"rule": "a"}])
    verdict = Verdict({"vehicles": []})
    add_links(verdict, tmp_path)
    assert verdict.reasons == [
        f"{tmp_path}/run.json: relay[0].reliable: missing; legal: true or false"
    ]


def judged(folder: Path, *words: str) -> tuple[int, dict[str, Any]]:
    code = main(["verdict", str(folder), *words])
    return code, json.loads((folder / "verdict.json").read_text())


@pytest.mark.parametrize("delivered", [60, 0])
def test_a_formation_with_radios(planned_run: Run, delivered: int) -> None:
    add_relay(planned_run.folder, [entry(DETECTIONS, "UAV1", "UAV2", delivered=delivered)])
    code, verdict = judged(planned_run.folder, "--no-pictures")
    assert code == (0 if delivered else 1)
    assert verdict["mode"] == "time"
    assert verdict["relay"][0]["share"] == delivered / 60


@pytest.mark.parametrize("delivered", [60, 0])
def test_a_world_alone_with_radios(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], delivered: int
) -> None:
    (tmp_path / "states.csv").write_text("t,name,x,y,z\n")
    (tmp_path / "run.json").write_text(json.dumps({"steps": 500}))
    add_relay(tmp_path, [entry(DETECTIONS, "gcs", "mast", delivered=delivered)])
    write_links(tmp_path, three_radios())
    code, verdict = judged(tmp_path)
    assert code == (0 if delivered else 1)
    assert len(verdict["relay"]) == 1
    page = (tmp_path / "report.html").read_text()
    assert f"detections gcs -&gt; mast<td>{delivered} of 60" in page
    assert "links.png" in page
    assert (tmp_path / "links.png").is_file()
    assert f"detections gcs -> mast  {delivered} of 60" in capsys.readouterr().out


def test_a_mission_with_radios(tmp_path: Path) -> None:
    mission = {"kind": "ugv", "waypoints": [[1, 0]], "reach": 0.5, "tracking_limit": 0.3}
    given = {"r1": {"mission": mission | {"start": [0.0, 0.0, 0.0, 0.0]}}}
    (tmp_path / "params.json").write_text(json.dumps({"parameters": given}))
    states = ["t,name,x,y,z", *(f"{0.1 * n:.1f},r1,{0.1 * n:.1f},0,0" for n in range(11))]
    (tmp_path / "states.csv").write_text("\n".join(states) + "\n")
    add_relay(tmp_path, [entry(DETECTIONS, "r1", "gcs")])
    write_links(tmp_path, three_radios())
    code, verdict = judged(tmp_path)
    assert code == 0
    assert verdict["mode"] == "missions"
    assert verdict["relay"][0]["destination"] == "gcs"
    page = (tmp_path / "report.html").read_text()
    assert "messages delivered per second" in page
    assert main(["report", str(tmp_path), "--out", str(tmp_path / "again")]) == 0
    assert (tmp_path / "again" / "links.png").read_bytes() == (tmp_path / "links.png").read_bytes()


def test_damaged_links_cost_the_page_but_not_the_verdict(
    planned_run: Run, capsys: pytest.CaptureFixture[str]
) -> None:
    write_links(planned_run.folder, ["x"])
    assert judged(planned_run.folder)[0] == 0
    assert "links.csv:2: source: None" in capsys.readouterr().err
