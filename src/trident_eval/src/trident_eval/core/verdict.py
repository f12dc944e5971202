# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Whether a run did what it should: numbers, limits, reasons."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from trident_fleet.core.separation import min_separation, pair_separations

from trident_eval.core.flight_records import Command, Refusal
from trident_eval.core.metrics import closest_approach, rigid_residuals, rms
from trident_eval.core.tracks import Array, Tracks

FORMATION_RMS_LIMIT_M = {"time": 0.05, "gate": 0.08, "follow": 0.08}
# Followers learn a period late what their leader does.
SEPARATION_SLACK_M = {"time": 0.1, "gate": 0.1, "follow": 0.2}
ARRIVAL_RADIUS_M = 0.1
# A planned row may be passed this much early or late [s].
ROW_WINDOW_S = 0.5
STEADY_AVERAGE_S = 1.0
LOWEST_Z_M = -0.05
_TEXT_ROUNDING_M = 1e-3
_RUN_KEYS = ("rtf", "state_hash", "sim_s", "wall_s", "end_reason", "seed", "steps")


@dataclass(frozen=True)
class FormationScore:
    """Numbers of a formation flight, counted from the first row that all have reached.

    Attributes:
        start_s: when all had reached the first row [s]; None: never.
        end_s: when the last row was (to be) reached [s].
        rows_flown: rows that all vehicles reached.
        steady_offset: hover error [m, world], shape (N, 3).
        formation_rms_m: error of the shape.
        tracking_rms_m: distance to the command.
        min_separation_m: between any two vehicles, also between states.
    """

    start_s: float | None
    end_s: float
    rows_flown: int
    steady_offset: Array
    formation_rms_m: float | None = None
    tracking_rms_m: float | None = None
    min_separation_m: float | None = None


@dataclass
class Verdict:
    """Result of a run; `numbers` is what goes into verdict.json."""

    numbers: dict[str, Any]
    reasons: list[str] = field(default_factory=list)

    @property
    def passed(self) -> bool:
        """No reason against it."""
        return not self.reasons

    def to_json(self) -> dict[str, Any]:
        """Everything, with null where a number is not known."""
        return self.numbers | {"pass": self.passed, "reasons": self.reasons}


def run_numbers(run: dict[str, Any]) -> dict[str, Any]:
    """What each verdict has of a run.json, which may be empty; None: it is not there."""
    return {key: run.get(key) for key in _RUN_KEYS}


def take_over(run: dict[str, Any], verdict: Verdict) -> None:
    """What the simulator itself says of the run: an error, and what would not come again.

    Args:
        run: its run.json; may be empty.
        verdict: gets `repeatable` and `not_repeatable` (who, t, why), and the error as its first
            reason.
    """
    if "repeatable" in run:
        verdict.numbers["repeatable"] = run["repeatable"]
        verdict.numbers["not_repeatable"] = run.get("not_repeatable", [])
    if run.get("error"):
        verdict.reasons.insert(0, str(run["error"]))


def judge(tracks: Tracks, command: Command | Refusal | None, run: dict[str, Any]) -> Verdict:
    """Judge a run.

    Args:
        tracks: where the vehicles were.
        command: what they were commanded, if it is known.
        run: the simulator's run.json; may be empty.

    Returns:
        All numbers that can be computed, and the reasons against the run.
    """
    names = command.names if command else tracks.names
    numbers: dict[str, Any] = {
        "mode": None,
        "vehicles": names,
        "formation_file": None,
        "formation_rms_m": None,
        "formation_rms_limit_m": None,
        "tracking_rms_m": None,
        "min_separation_m": None,
        "min_separation_limit_m": None,
        "file_min_separation_m": None,
        "rows_flown": None,
        "rows": None,
        "steady_offset_m": None,
    }
    verdict = Verdict(numbers | run_numbers(run), _faults_of_states(tracks.select(names)))
    if command:
        verdict.reasons += command.errors
    if isinstance(command, Command):
        _judge_formation(tracks.select(command.names), command, verdict)
    take_over(run, verdict)
    return verdict


def score(tracks: Tracks, command: Command) -> FormationScore:
    """Compare a flight with its command; vehicles in the same order in both."""
    offset = steady_offset(tracks, command)
    start = _first_arrival(tracks, command, offset)
    rows_flown = _rows_flown(tracks, command, offset) if start is not None else 0
    end = float(command.arrival_s[-1]) if len(command.arrival_s) else float(tracks.time[-1])
    counted = tracks.between(np.inf if start is None else start, end)
    if not len(counted.time):
        return FormationScore(None, end, rows_flown, offset)
    commanded = command.position(counted.time)
    return FormationScore(
        start_s=start,
        end_s=end,
        rows_flown=rows_flown,
        steady_offset=offset,
        formation_rms_m=_known(rms(rigid_residuals(counted.position, commanded))),
        tracking_rms_m=_known(rms(counted.position - commanded)),
        min_separation_m=_known(min_separation(counted.position)),
    )


def steady_offset(tracks: Tracks, command: Command) -> Array:
    """Hover error at the first row [m], shape (N, 3): the gate's, or a mean over its end."""
    if command.steady_offset is not None:
        return command.steady_offset
    begin, end = command.hover_s
    hover = tracks.between(max(begin, end - STEADY_AVERAGE_S), end)
    if not len(hover.time):
        return np.zeros(command.rows.shape[1:])
    return np.asarray((hover.position - command.rows[0]).mean(axis=0))


def _known(value: float) -> float | None:
    return value if np.isfinite(value) else None


def _first_arrival(tracks: Tracks, command: Command, offset: Array) -> float | None:
    begin, end = command.hover_s
    hover = tracks.between(begin, end)
    distance = np.sqrt(((hover.position - command.rows[0] - offset) ** 2).sum(axis=-1))
    is_there = (distance < ARRIVAL_RADIUS_M).all(axis=1)
    # A hover error of metres is no hover.
    is_near = bool((np.abs(offset) < 3.0 * ARRIVAL_RADIUS_M).all())
    return float(hover.time[np.argmax(is_there)]) if is_near and is_there.any() else None


def _rows_flown(tracks: Tracks, command: Command, offset: Array) -> int:
    margin = 0.0 if command.mode == "gate" else ROW_WINDOW_S
    flown = 0
    for row, (begin, end) in enumerate(zip(command.command_s, command.arrival_s, strict=False)):
        if end > tracks.time[-1] + 1e-6:
            break
        around = tracks.between(begin - margin, end + margin)
        distance = closest_approach(around.position, command.rows[row] + offset)
        flown += bool((distance < ARRIVAL_RADIUS_M + _TEXT_ROUNDING_M).all())
    return flown


def _judge_formation(tracks: Tracks, command: Command, verdict: Verdict) -> None:
    result = score(tracks, command)
    file_separation = _known(min_separation(command.rows))
    least = None if file_separation is None else file_separation - SEPARATION_SLACK_M[command.mode]
    limit = FORMATION_RMS_LIMIT_M[command.mode]
    total = len(command.rows)
    verdict.numbers |= {
        "mode": command.mode,
        "formation_file": command.file,
        "formation_rms_m": result.formation_rms_m,
        "formation_rms_limit_m": limit,
        "tracking_rms_m": result.tracking_rms_m,
        "min_separation_m": result.min_separation_m,
        "min_separation_limit_m": least,
        "file_min_separation_m": file_separation,
        "rows_flown": result.rows_flown,
        "rows": total,
        "steady_offset_m": result.steady_offset.mean(axis=0).tolist(),
        "counted_from_s": result.start_s,
        "counted_to_s": result.end_s,
    }
    if not np.isfinite(result.steady_offset).all():
        verdict.numbers["steady_offset_m"] = None
    if result.rows_flown < total:
        verdict.reasons.append(f"{result.rows_flown} of {total} rows flown by all vehicles")
    if result.formation_rms_m is None or result.formation_rms_m >= limit:
        verdict.reasons.append(f"formation RMS {_text(result.formation_rms_m)}, limit {limit:g} m")
    if least is not None:
        _judge_separation(tracks, result, least, verdict)


def _judge_separation(
    tracks: Tracks, result: FormationScore, least: float, verdict: Verdict
) -> None:
    if result.min_separation_m is not None and result.min_separation_m >= least:
        return
    verdict.reasons.append(
        f"minimum separation {_text(result.min_separation_m)}, limit {least:.3f} m"
        f"{_closest_pair(tracks.between(result.start_s or 0.0, result.end_s))}"
    )


def _closest_pair(tracks: Tracks) -> str:
    if not len(tracks.time) or not np.isfinite(tracks.position).all() or len(tracks.names) < 2:
        return ""
    i, j = np.triu_indices(len(tracks.names), k=1)
    closest = int(np.argmin(pair_separations(tracks.position)))
    return f" ({tracks.names[i[closest]]} and {tracks.names[j[closest]]})"


def _faults_of_states(tracks: Tracks) -> list[str]:
    warnings = []
    for name, position in zip(tracks.names, tracks.position.swapaxes(0, 1), strict=True):
        present = np.isfinite(position).all(axis=1)
        if not present.any():
            warnings.append(f"{name}: no states")
        elif not present[-1]:
            last = tracks.time[present][-1]
            warnings.append(f"{name}: no finite state after {last:.2f} s")
        elif np.nanmin(position[:, 2]) < LOWEST_Z_M:
            lowest = np.nanmin(position[:, 2])
            warnings.append(f"{name}: below the ground (z {lowest:.2f} m)")
    return warnings


def _text(value: float | None) -> str:
    return "unknown" if value is None else f"{value:.3f} m"
