# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What went through the registers of a vessel's PLC during a run: `plc.csv` and `plc.json`.

`plc.csv` has a row for each value that was said, with where: by the pilot, who commands a client of
the PLC; on the vessel's topics; on the client's topics. A command must arrive at the vessel, one
that is not legal must not, and when the pilot is silent the PLC must stop the propellers.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from trident_eval.core.errors import EvalError
from trident_eval.core.metrics import lengths
from trident_eval.core.provenance import read_object
from trident_eval.core.rows import Row, value_text
from trident_eval.core.tracks import Array, Tracks, whole_lines
from trident_eval.core.verdict import Verdict, run_numbers, take_over

PLC_FILE = "plc.csv"
PROPELLERS = ("left", "right")
DELAY_LIMIT_S = 0.5  # of a command
SAFE_SLACK_S = 0.3  # beyond the PLC's timeout
LEAST_DISTANCE_M = 5.0  # that the commands move the vessel
COMMAND_STEP = 0.006  # half a step of the register, and rounding [rad/s]
THRUST_STEP_N = 0.06  # the same of a measured thrust
_LOOK_BACK_S = 1.0  # a register was measured at most so long before it is published
_ENDS = ("pilot", "vessel", "client")


@dataclass(frozen=True)
class Series:
    """Values that were said on one topic.

    Attributes:
        time: simulated time of each [s], shape (M,).
        value: shape (M,).
    """

    time: Array
    value: Array

    def first_near(self, value: float, after_s: float, tolerance: float) -> float | None:
        """When a value was said first from a time on; None: never."""
        found = (self.time >= after_s) & (np.abs(self.value - value) <= tolerance)
        return float(self.time[np.argmax(found)]) if found.any() else None


@dataclass(frozen=True)
class PlcLog:
    """A run's record.

    Attributes:
        vessel: its model.
        timeout_s: after which the PLC makes speeds safe.
        limits: legal speeds [rad/s].
        series: by end (pilot, vessel, client) and what.
    """

    vessel: str
    timeout_s: float
    limits: tuple[float, float]
    series: dict[tuple[str, str], Series]

    def of(self, end: str, what: str) -> Series:
        """One topic's values; empty when nothing was said."""
        return self.series.get((end, what), Series(np.zeros(0), np.zeros(0)))

    def is_legal(self, value: Array) -> Array:
        """Whether speeds are within the limits."""
        return np.asarray((value >= self.limits[0]) & (value <= self.limits[1]))


def read_plc(folder: Path) -> PlcLog | None:
    """The record of a run; None where it has none.

    Raises:
        EvalError: it is not what plc_pilot.py writes.
    """
    path = folder / PLC_FILE
    if not path.is_file():
        return None
    about = read_object(path.with_suffix(".json"))
    rows: dict[tuple[str, str], list[tuple[float, float]]] = {}
    try:
        with path.open(newline="", encoding="utf-8") as stream:
            for row in csv.DictReader(whole_lines(stream)):
                if row["end"] not in _ENDS:
                    raise ValueError(f"end {row['end']!r}")
                key = (row["end"], row["what"])
                rows.setdefault(key, []).append((float(row["t"]), float(row["value"])))
        low, high = (float(value) for value in about["limits"])
        series = {key: Series(*np.array(values).T) for key, values in rows.items()}
        return PlcLog(str(about["vessel"]), float(about["timeout"]), (low, high), series)
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise EvalError(f"{path}: {error}; legal: what plc_pilot.py writes") from error


def command_delays(log: PlcLog, propeller: str) -> list[float | None]:
    """How long each change of a legal command took to the vessel [s]; None: it did not arrive."""
    said, heard = log.of("pilot", f"{propeller}_command"), log.of("vessel", f"{propeller}_command")
    delays: list[float | None] = []
    before = None
    for time, value in zip(said.time, said.value, strict=True):
        if value != before and log.is_legal(np.array(value)):
            # Who hears of both may hear of the arrival first.
            arrived = heard.first_near(float(value), float(time) - 0.1, COMMAND_STEP)
            delays.append(None if arrived is None else max(0.0, arrived - float(time)))
        before = value
    return delays


def silences(log: PlcLog, propeller: str, end_s: float) -> list[float | None]:
    """After how long each silence of the pilot had stopped the propeller [s]; None: it had not.

    What is not legal is silence, too. One that the run's end cuts short does not count.
    """
    said, heard = log.of("pilot", f"{propeller}_command"), log.of("vessel", f"{propeller}_command")
    times = said.time[log.is_legal(said.value)]
    result: list[float | None] = []
    for last, following in zip(times, [*times[1:], end_s], strict=True):
        if following - last < log.timeout_s + SAFE_SLACK_S:
            continue
        stopped = heard.first_near(0.0, float(last), COMMAND_STEP)
        is_meant = stopped is not None and stopped < following + SAFE_SLACK_S
        result.append(stopped - float(last) if is_meant and stopped is not None else None)
    return result


def register_errors(log: PlcLog, propeller: str) -> Array:
    """How far each thrust that the client read is from the nearest one that was measured [N]."""
    thrust = f"{propeller}_thrust"
    read, measured = log.of("client", thrust), log.of("vessel", thrust)
    errors = []
    for time, value in zip(read.time, read.value, strict=True):
        near = (measured.time >= time - _LOOK_BACK_S) & (measured.time <= time + 0.1)
        if near.any():
            errors.append(float(np.abs(measured.value[near] - value).min()))
    return np.array(errors)


def _known(values: list[float | None]) -> list[float]:
    return [value for value in values if value is not None]


def judge_plc(tracks: Tracks, log: PlcLog, run: dict[str, Any]) -> Verdict:
    """Judge a run that was driven through a PLC.

    Args:
        tracks: where everything was.
        log: what was said.
        run: the simulator's run.json; may be empty.
    """
    end_s = float(tracks.time[-1]) if len(tracks.time) else 0.0
    track = tracks.select([log.vessel]).position[:, 0]
    track = track[np.isfinite(track).all(axis=1)]
    shone, seen = log.of("vessel", "lights"), log.of("client", "lights")
    numbers: dict[str, Any] = {
        **_command_numbers(log),
        **_silence_numbers(log, end_s),
        **_register_numbers(log),
        "lights": bool(len(shone.time) and seen.value.any()),
        "distance_m": float(lengths(np.diff(track[:, :2], axis=0)).sum()),
    }
    checks = _checks(numbers)
    numbers["satisfied"] = {
        group: all(is_satisfied for one, is_satisfied, _ in checks if one == group)
        for group, *_ in checks
    }
    reasons = [f"PLC: {reason}" for _, is_satisfied, reason in checks if not is_satisfied]
    verdict = Verdict({"mode": "plc", "vehicles": [log.vessel], "plc": numbers}, reasons)
    verdict.numbers |= run_numbers(run)
    take_over(run, verdict)
    return verdict


def _command_numbers(log: PlcLog) -> dict[str, Any]:
    delays = [delay for side in PROPELLERS for delay in command_delays(log, side)]
    spoken = [log.of("pilot", f"{side}_command").value for side in PROPELLERS]
    heard = np.concatenate([log.of("vessel", f"{side}_command").value for side in PROPELLERS])
    return {
        "commands": len(delays),
        "commands_arrived": len(_known(delays)),
        "delay_max_s": max(_known(delays), default=None),
        "delay_limit_s": DELAY_LIMIT_S,
        "illegal_commands": int(sum((~log.is_legal(values)).sum() for values in spoken)),
        "illegal_arrived": int((~log.is_legal(heard)).sum()),
    }


def _silence_numbers(log: PlcLog, end_s: float) -> dict[str, Any]:
    stops = [stop for side in PROPELLERS for stop in silences(log, side, end_s)]
    return {
        "silences": len(stops),
        "stopped": len(_known(stops)),
        "stopped_after_max_s": max(_known(stops), default=None),
        "stopped_limit_s": log.timeout_s + SAFE_SLACK_S,
    }


def _register_numbers(log: PlcLog) -> dict[str, Any]:
    errors = np.concatenate([register_errors(log, side) for side in PROPELLERS])
    return {
        "registers_read": len(errors),
        "register_error_max_n": float(errors.max()) if len(errors) else None,
    }


def _checks(numbers: dict[str, Any]) -> tuple[tuple[str, bool, str], ...]:
    """What is judged: a group, whether it is as it must be, and what speaks against the run."""
    return (
        ("commands", numbers["commands"] > 0, "no legal command was given"),
        (
            "commands",
            numbers["commands_arrived"] == numbers["commands"],
            f"{numbers['commands_arrived']} of {numbers['commands']} commands arrived",
        ),
        (
            "commands",
            (numbers["delay_max_s"] or 0.0) <= DELAY_LIMIT_S,
            f"a command took {numbers['delay_max_s'] or 0.0:.3f} s, limit {DELAY_LIMIT_S:g} s",
        ),
        (
            "limits",
            numbers["illegal_arrived"] == 0,
            f"{numbers['illegal_arrived']} commands beyond the limits arrived",
        ),
        (
            "silences",
            numbers["silences"] > 0 and numbers["stopped"] == numbers["silences"],
            f"{numbers['stopped']} of {numbers['silences']} silences stopped a propeller",
        ),
        (
            "silences",
            (numbers["stopped_after_max_s"] or 0.0) <= numbers["stopped_limit_s"],
            f"a propeller stopped {numbers['stopped_after_max_s'] or 0.0:.3f} s after its last "
            f"command, limit {numbers['stopped_limit_s']:g} s",
        ),
        ("registers", numbers["registers_read"] > 0, "no thrust was read from the registers"),
        (
            "registers",
            (numbers["register_error_max_n"] or 0.0) <= THRUST_STEP_N,
            f"a register is {numbers['register_error_max_n'] or 0.0:.3f} N off, limit "
            f"{THRUST_STEP_N:g} N",
        ),
        ("lights", numbers["lights"], "the lights were not switched on, or not read back"),
        (
            "distance",
            numbers["distance_m"] >= LEAST_DISTANCE_M,
            f"the vessel moved {numbers['distance_m']:.1f} m, at least {LEAST_DISTANCE_M:g} m",
        ),
    )


def plc_rows(verdict: dict[str, Any]) -> list[Row]:
    """What went through a PLC's registers; nothing of a run without one."""
    numbers: dict[str, Any] = verdict.get("plc") or {}
    if not numbers:
        return []

    satisfied = numbers["satisfied"]

    def row(label: str, counts: tuple[str, str], worst: str, limit: float) -> Row:
        value, most = f"{numbers[counts[0]]} of {numbers[counts[1]]}", numbers[worst]
        if most is not None:
            value += f", within {value_text(most, 's')}"
        return Row(label, value, f"all, within {value_text(limit, 's')}", satisfied[counts[1]])

    arrived, stopped = ("commands_arrived", "commands"), ("stopped", "silences")
    return [
        row("commands arrived", arrived, "delay_max_s", numbers["delay_limit_s"]),
        row("stopped in silence", stopped, "stopped_after_max_s", numbers["stopped_limit_s"]),
        Row(
            "commands beyond limits",
            f"{numbers['illegal_arrived']} of {numbers['illegal_commands']} arrived",
            "none",
            satisfied["limits"],
        ),
    ]
