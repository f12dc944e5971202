# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Whether vehicles did what a client asked of them by MAVLink: what they said, and where they were.

The client leaves RECORD in the folder of the run; the truth is in the simulator's `states.csv`.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from trident_eval.core.errors import EvalError
from trident_eval.core.missions import Mission, follow
from trident_eval.core.rows import Row, value_text
from trident_eval.core.tracks import Tracks
from trident_eval.core.verdict import Verdict, run_numbers, take_over

RECORD = "mavlink_demo.json"
#: What an estimate of the vehicle's may be off, beyond the radius of a place [m].
ESTIMATE_SLACK_M = 1.5
_AXES = {"uav": 3, "ugv": 2, "usv": 2}
_ENDS = {"land": "landed", "return": "back and held", "hold": "held"}
_NEEDED = {"kind", "radius", "end", "places_wanted", "start", "places", "armed", "uploaded"} | {
    "downloaded_equal",
    "reached",
    "ended",
    "refusals",
    "texts",
    "problem",
}


def read_client_record(folder: Path) -> dict[str, dict[str, Any]]:
    """What the client wrote of each vehicle; empty without one.

    Raises:
        EvalError: it is not what the client writes.
    """
    path = folder / RECORD
    if not path.is_file():
        return {}
    try:
        vehicles = json.loads(path.read_text(encoding="utf-8"))["vehicles"]
        for name, entry in vehicles.items():
            if missing := sorted(_NEEDED - entry.keys()):
                raise EvalError(f"{path}: vehicles.{name}: no {', '.join(missing)}")
            if entry["kind"] not in _AXES or entry["end"] not in _ENDS:
                raise EvalError(f"{path}: vehicles.{name}: kind or end is not known")
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise EvalError(f"{path}: {error}; legal: what mavlink_demo.py writes") from error
    return dict(vehicles)


def missions_of(record: dict[str, dict[str, Any]]) -> list[Mission]:
    """The places that were flown to, for pictures and distances; of vehicles that had some."""
    return [
        Mission(
            name,
            entry["kind"],
            np.array(entry["start"], dtype=np.float64),
            np.array(entry["places"], dtype=np.float64)[:, : _AXES[entry["kind"]]],
            float(entry["radius"]) + ESTIMATE_SLACK_M,
            math.nan,
        )
        for name, entry in record.items()
        if entry["places"]
    ]


def judge_client_flights(
    tracks: Tracks, record: dict[str, dict[str, Any]], run: dict[str, Any]
) -> Verdict:
    """Judge a run that a client has commanded.

    Args:
        tracks: where everything was.
        record: what the client wrote.
        run: the simulator's run.json; may be empty.
    """
    numbers: dict[str, Any] = {"mode": "mavlink", "vehicles": list(record), "commanded": {}}
    verdict = Verdict(numbers | run_numbers(run))
    passed = {one.name: follow(tracks, one).reached for one in missions_of(record)}
    for name, entry in record.items():
        row = _numbers(entry, passed.get(name, 0))
        reasons = _reasons(entry, row)
        verdict.numbers["commanded"][name] = row | {"satisfied": not reasons}
        verdict.reasons += [f"{name}: {reason}" for reason in reasons]
    take_over(run, verdict)
    return verdict


def judge_piloted(tracks: Tracks, names: list[str], run: dict[str, Any]) -> Verdict:
    """Judge a run whose client has left no record: were all vehicles there to its end?

    Args:
        tracks: where everything was.
        names: of the vehicles.
        run: the simulator's run.json; may be empty.
    """
    numbers: dict[str, Any] = {"mode": "mavlink", "vehicles": names}
    verdict = Verdict(numbers | run_numbers(run))
    present = np.isfinite(tracks.select(names).position).all(axis=2)
    verdict.reasons = [
        f"{name}: no finite state at the end"
        for name, there in zip(names, present[-1], strict=True)
        if not there
    ]
    take_over(run, verdict)
    return verdict


def _numbers(entry: dict[str, Any], passed: int) -> dict[str, Any]:
    wanted = int(entry["places_wanted"])
    home = int(entry["uploaded"]) - wanted  # ArduPilot's item 0 is home
    reached = len([index for index in entry["reached"] if index >= home])
    return {
        "kind": entry["kind"],
        "armed": bool(entry["armed"]),
        "mission_equal": bool(entry["downloaded_equal"]),
        "items": wanted,
        "items_reported": min(reached, wanted),
        "items_passed": passed,
        "radius_m": float(entry["radius"]) + ESTIMATE_SLACK_M,
        "end": _ENDS[entry["end"]] if entry["ended"] else f"not {_ENDS[entry['end']]}",
        "ended": bool(entry["ended"]),
        "refusals": int(entry["refusals"]),
    }


def _reasons(entry: dict[str, Any], row: dict[str, Any]) -> list[str]:
    reasons = [str(entry["problem"])] if entry["problem"] else []
    if not row["armed"]:
        reasons.append("not armed")
    if not row["mission_equal"]:
        reasons.append("its mission did not come back as it was sent")
    for key, what in (("items_reported", "reported as reached"), ("items_passed", "passed")):
        if row[key] < row["items"]:
            reasons.append(f"{row[key]} of {row['items']} items {what}")
    if not row["ended"]:
        reasons.append(str(row["end"]))
    if row["refusals"]:
        said = f", the last of its texts: {entry['texts'][-1]}" if entry["texts"] else ""
        reasons.append(f"{row['refusals']} refusals{said}")
    return reasons


def client_rows(verdict: dict[str, Any]) -> list[Row]:
    """What each vehicle did that a client has commanded."""
    commanded: dict[str, dict[str, Any]] = verdict.get("commanded") or {}
    return [_commanded_row(name, numbers) for name, numbers in commanded.items()]


def _commanded_row(name: str, numbers: dict[str, Any]) -> Row:
    items, passed, reported = (numbers[f"items{key}"] for key in ("", "_passed", "_reported"))
    armed = "armed" if numbers["armed"] else "not armed"
    refusals = f"{numbers['refusals']} refusal{'s' * (numbers['refusals'] != 1)}"
    value = (
        f"{armed}, {passed} of {items} items ({reported} reported), {numbers['end']}, {refusals}"
    )
    limit = f"all, within {value_text(numbers['radius_m'], 'm')}"
    return Row(name, value, limit, numbers["satisfied"])
