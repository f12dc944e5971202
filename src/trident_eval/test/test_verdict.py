# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from runs import NAMES, OFFSET, START_S, Run
from trident_eval.core.errors import EvalError
from trident_eval.core.flight_records import Command, Refusal, read_command
from trident_eval.core.report import table
from trident_eval.core.tracks import Tracks, read_states
from trident_eval.core.verdict import Verdict, judge, take_over
from trident_fleet.core.separation import min_separation


def verdict_of(run: Run) -> Verdict:
    run.write()
    return judge(read_states(run.folder / "states.csv"), read_command(run.folder), {})


def flying(run: Run) -> slice:
    """States in the middle of the rows."""
    record = json.loads((run.folder / "formation_UAV1.json").read_text())
    begin, end = START_S + record["row_time_s"][4], START_S + record["row_time_s"][7]
    return slice(int(begin / 0.05) + 1, int(end / 0.05))


def test_a_perfect_flight_passes_with_the_numbers_that_were_put_in(planned_run: Run) -> None:
    verdict = verdict_of(planned_run)
    assert verdict.reasons == []
    numbers = verdict.to_json()
    assert numbers["pass"] is True
    assert numbers["mode"] == "time"
    assert numbers["rows_flown"] == numbers["rows"] == 12
    assert numbers["formation_rms_m"] < 1e-5
    assert numbers["tracking_rms_m"] == pytest.approx(0.04, abs=1e-5)
    assert numbers["file_min_separation_m"] == pytest.approx(min_separation(planned_run.rows))
    assert numbers["min_separation_m"] == pytest.approx(numbers["file_min_separation_m"], abs=0.02)
    np.testing.assert_allclose(numbers["steady_offset_m"], OFFSET, atol=1e-5)


def test_the_take_off_is_not_counted(planned_run: Run) -> None:
    # Until the hover they are all over the place.
    before = planned_run.time < START_S + 3.0
    planned_run.position[before, :, 0] += np.array([0.5, -0.5, 0.2])
    assert verdict_of(planned_run).reasons == []


def test_a_bent_formation_fails(planned_run: Run) -> None:
    planned_run.position[:, 1, 0] += 0.2 * np.clip(planned_run.time - 9.0, 0.0, 1.0)
    verdict = verdict_of(planned_run)
    assert any(reason.startswith("formation RMS 0.") for reason in verdict.reasons)
    assert not verdict.passed


def test_a_formation_that_is_turned_and_shifted_keeps_its_shape(planned_run: Run) -> None:
    planned_run.position += [0.05, 0.03, 0.0]
    numbers = verdict_of(planned_run).to_json()
    assert numbers["formation_rms_m"] < 1e-5
    assert numbers["tracking_rms_m"] > 0.06


def test_coming_too_close_names_the_pair(planned_run: Run) -> None:
    middle = flying(planned_run)
    planned_run.position[middle, 2] = planned_run.position[middle, 1] + [0.3, 0.0, 0.0]
    reasons = verdict_of(planned_run).reasons
    assert any(r.startswith("minimum separation 0.3") and "UAV2 and UAV3" in r for r in reasons)


def test_rows_that_were_missed_are_counted(planned_run: Run) -> None:
    middle = flying(planned_run)
    planned_run.position[middle, 0, 2] += 0.5
    verdict = verdict_of(planned_run)
    assert verdict.numbers["rows_flown"] < 12
    assert any("of 12 rows flown by all vehicles" in reason for reason in verdict.reasons)


def test_a_run_that_ends_early_has_not_flown_the_last_rows(planned_run: Run) -> None:
    end = flying(planned_run).stop
    planned_run.time, planned_run.position = planned_run.time[:end], planned_run.position[:end]
    verdict = verdict_of(planned_run)
    assert 5 <= verdict.numbers["rows_flown"] <= 8
    assert not verdict.passed


def test_who_never_takes_off_has_flown_nothing(planned_run: Run) -> None:
    planned_run.position[:] = [[0.0, 2.0, 0.1], [0.0, 0.0, 0.1], [0.0, -2.0, 0.1]]
    verdict = verdict_of(planned_run)
    assert verdict.numbers["rows_flown"] == 0
    assert verdict.numbers["formation_rms_m"] is None
    assert "formation RMS unknown, limit 0.05 m" in verdict.reasons


def test_a_vehicle_that_is_lost_is_named(planned_run: Run) -> None:
    planned_run.position[flying(planned_run).start :, 2] = np.nan
    reasons = verdict_of(planned_run).reasons
    assert any(reason.startswith("UAV3: no finite state after") for reason in reasons)


def test_below_the_ground_is_named(planned_run: Run) -> None:
    planned_run.position[3, 0, 2] = -0.4
    assert "UAV1: below the ground (z -0.40 m)" in verdict_of(planned_run).reasons


def test_a_gated_flight_passes(gated_run: Run) -> None:
    verdict = verdict_of(gated_run)
    assert verdict.reasons == []
    assert verdict.numbers["mode"] == "gate"
    assert verdict.numbers["rows_flown"] == 12
    assert 0.0 < verdict.numbers["formation_rms_m"] < 0.08


def test_a_gate_that_timed_out_says_so(gated_run: Run) -> None:
    record = json.loads((gated_run.folder / "formation_UAV1.json").read_text())
    for name in NAMES:
        gated_run.edit_record(
            name,
            arrival_time_s=record["arrival_time_s"][:7],
            command_time_s=record["command_time_s"][:8],
            error="row 8 of 12 not reached within 10 s by UAV2 (0.40 m away)",
        )
    verdict = verdict_of(gated_run)
    assert verdict.numbers["rows_flown"] == 7
    assert verdict.reasons[0] == "row 8 of 12 not reached within 10 s by UAV2 (0.40 m away)"
    assert verdict.reasons.count(verdict.reasons[0]) == 1


def test_the_command_of_a_gate_is_the_row_of_that_instant(gated_run: Run) -> None:
    command = read_command(gated_run.folder)
    assert isinstance(command, Command)
    changes = command.command_s[3:5]
    got = command.position(np.array([changes[0], changes[1] - 1e-3, changes[1]]))
    np.testing.assert_allclose(got, gated_run.rows[[3, 3, 4]])
    np.testing.assert_allclose(command.position(np.zeros(1))[0, :, 2], 0.1)


def test_a_refused_formation_fails_with_the_reason(planned_run: Run) -> None:
    for name in NAMES:
        record = {"vehicle": name, "vehicles": [name], "error": "f.txt:3: 2 columns"}
        (planned_run.folder / f"formation_{name}.json").write_text(json.dumps(record))
    command = read_command(planned_run.folder)
    assert isinstance(command, Refusal)
    assert command.names == NAMES
    verdict = verdict_of(planned_run)
    assert "f.txt:3: 2 columns" in verdict.reasons
    assert verdict.numbers["rows_flown"] is None


def test_a_missing_record_is_named(planned_run: Run) -> None:
    (planned_run.folder / "formation_UAV2.json").unlink()
    assert "no record of UAV2" in verdict_of(planned_run).reasons


def test_without_a_formation_it_is_enough_to_stay_alive(planned_run: Run) -> None:
    for name in NAMES:
        (planned_run.folder / f"formation_{name}.json").unlink()
    verdict = verdict_of(planned_run)
    assert verdict.passed
    for key in ("formation_rms_m", "tracking_rms_m", "min_separation_m", "rows_flown", "mode"):
        assert verdict.to_json()[key] is None


@pytest.mark.parametrize(
    ("content", "what"),
    [
        ("{", "formation_UAV1.json: "),
        ("[]", "no .vehicle. or .vehicles."),
        ('{"vehicle": "UAV1"}', "no .vehicle. or .vehicles."),
        (
            '{"vehicle": "UAV1", "vehicles": ["UAV1"], "rows": [[1, 2]]}',
            "not what a formation node",
        ),
    ],
)
def test_a_damaged_record_is_refused(planned_run: Run, content: str, what: str) -> None:
    for name in NAMES[1:]:
        (planned_run.folder / f"formation_{name}.json").unlink()
    (planned_run.folder / "formation_UAV1.json").write_text(content)
    with pytest.raises(EvalError, match=what):
        read_command(planned_run.folder)


@pytest.mark.parametrize(
    ("content", "what"),
    [
        ("", "no column t, name, x, y, z"),
        ("t,name,x,y\n", "no column z"),
        ("t,name,x,y,z\n", "no states"),
        ("t,name,x,y,z\n0,UAV1,1,two,3\n", ":2: y: 'two'; legal: a number"),
        ("t,name,x,y,z\n0,UAV1,1,2\n", ":2: z: None; legal: a number"),
        ("t,name,x,y,z\nnan,UAV1,1,2,3\n", ":2: t: nan; legal: seconds"),
        ("t,name,x,y,z\n\xff\n", "states.csv: "),
    ],
)
def test_damaged_states_are_refused(tmp_path: Path, content: str, what: str) -> None:
    path = tmp_path / "states.csv"
    path.write_bytes(content.encode("latin-1"))
    with pytest.raises(EvalError, match=what):
        read_states(path)


def test_states_of_different_vehicles_are_matched_in_time(tmp_path: Path) -> None:
    path = tmp_path / "states.csv"
    path.write_text("t,name,x,y,z\n0.05,B,4,5,6\n0.0,A,1,2,3\n0.050000,A,7,8,9\n0.0,B,0,0,nan\n")
    tracks = read_states(path)
    assert tracks.names == ["A", "B"]
    np.testing.assert_array_equal(tracks.time, [0.0, 0.05])
    np.testing.assert_array_equal(tracks.position[1], [[7, 8, 9], [4, 5, 6]])
    swapped = tracks.select(["B", "C"])
    np.testing.assert_array_equal(swapped.position[1, 0], [4, 5, 6])
    assert np.isnan(swapped.position[:, 1]).all()
    assert len(Tracks.between(tracks, 0.01, 0.05).time) == 1


def test_what_is_not_repeatable_is_said_by_the_verdict_and_does_not_fail_it() -> None:
    verdict = Verdict({"vehicles": ["UAV1"], "state_hash": "38d26b"})
    note = {"who": "the controller of UAV4", "t": 12.3, "why": "has not answered in time"}
    take_over({"repeatable": False, "not_repeatable": [note]}, verdict)
    assert verdict.passed
    lines = table(verdict.to_json()).splitlines()
    assert any("state hash" in line and "38d26b (not repeatable)" in line for line in lines)
    found = [line for line in lines if "the controller of UAV4, t = 12.30 s" in line]
    assert found, lines
    assert "has not answered in time" in found[0]


def test_a_repeatable_run_says_nothing_of_it_and_an_error_is_the_first_reason() -> None:
    verdict = Verdict({"vehicles": [], "state_hash": "b9fead"}, ["below the ground"])
    take_over({"repeatable": True, "error": "the controller of UAV1 has died"}, verdict)
    assert verdict.reasons == ["the controller of UAV1 has died", "below the ground"]
    assert "not repeatable" not in table(verdict.to_json())
    old = Verdict({"vehicles": []})
    take_over({}, old)
    assert "repeatable" not in old.numbers
