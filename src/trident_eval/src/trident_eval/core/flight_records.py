# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a run's vehicles were commanded: reads flight records (trident_base.flight_record)."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from trident_base.flight_record import FOLLOW, GATE, PATTERN
from trident_fleet.core.quintic import QuinticPath

from trident_eval.core.errors import EvalError
from trident_eval.core.tracks import Array


@dataclass(frozen=True)
class Command:
    """The command to a whole formation.

    Attributes:
        names: of the vehicles, in the order of the formation.
        mode: `time`, `gate` or `follow`; in the last, the leader's measured motion and the places
            around it are what was commanded.
        file: the formation file.
        rows: p_world of each row and vehicle [m], shape (T, N, 3).
        paths: planned motion of each vehicle, in simulated time [s]: of the whole flight in mode
            `time`, since all have joined in mode `follow`, of the take-off in mode `gate`.
        hover_s: when the hover at the first row begins and ends [s].
        command_s: when each row is commanded [s], shape (rows commanded,).
        arrival_s: when each row is (to be) reached [s], shape (rows reached,).
        steady_offset: hover error that was subtracted [m], shape (N, 3); None in mode `time`.
        errors: what went wrong, as the nodes report it.
    """

    names: list[str]
    mode: str
    file: str
    rows: Array
    paths: list[QuinticPath]
    hover_s: tuple[float, float]
    command_s: Array
    arrival_s: Array
    steady_offset: Array | None
    errors: list[str]

    def position(self, time: Array) -> Array:
        """Commanded p_world [m] at simulated times [s], shape (M,) -> (M, N, 3)."""
        planned = np.stack([path.derivative(time, 0)[:, 0] for path in self.paths], axis=1)
        if self.mode != GATE or not len(self.command_s):
            return planned
        row = np.searchsorted(self.command_s, time + 1e-9, side="right") - 1
        return np.where(row[:, None, None] >= 0, self.rows[np.maximum(row, 0)], planned)


@dataclass(frozen=True)
class Refusal:
    """A formation that was not flown at all, and why."""

    names: list[str]
    errors: list[str]


def read_command(folder: Path) -> Command | Refusal | None:
    """Read all records of a run.

    Args:
        folder: of the run.

    Returns:
        The command; a refusal if a vehicle has not been commanded; None without any record.

    Raises:
        EvalError: a record that is unreadable, incomplete, or at odds with the others.
    """
    records = _read_records(folder)
    if not records:
        return None
    names, errors = _vehicles(records), _errors(records)
    by_name = {record["vehicle"]: record for record in records}
    if any("rows" not in by_name.get(name, {}) for name in names):
        return _refusal(names, by_name, errors)
    try:
        return _combine(names, [by_name[name] for name in names], errors)
    except (KeyError, TypeError, ValueError, IndexError) as error:
        raise EvalError(
            f"{folder}/{PATTERN}: not what a formation node writes"
            f" ({type(error).__name__}: {error}); legal: records of one run"
        ) from error


def _read_records(folder: Path) -> list[dict[str, Any]]:
    """Those that count: commands to a leader itself are not what its followers are judged by."""
    records = [_read_record(path) for path in sorted(folder.glob(PATTERN))]
    return [record for record in records if record.get("mode") == FOLLOW] or records


def _vehicles(records: list[dict[str, Any]]) -> list[str]:
    """All vehicles once, in their order; a refusing node may know of none but its own."""
    named = [name for record in records for name in (*record["vehicles"], record["vehicle"])]
    return list(dict.fromkeys(named))


def _errors(records: list[dict[str, Any]]) -> list[str]:
    return list(dict.fromkeys(record["error"] for record in records if record.get("error")))


def _refusal(names: list[str], by_name: dict[str, Any], errors: list[str]) -> Refusal:
    silent = [name for name in names if name not in by_name]
    missing = [f"no record of {', '.join(silent)}"] if silent else []
    return Refusal(names, errors + missing)


def _read_record(path: Path) -> dict[str, Any]:
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise EvalError(f"{path}: {error}; legal: a record of a formation node") from error
    if not isinstance(record, dict) or not {"vehicle", "vehicles"} <= record.keys():
        raise EvalError(f"{path}: no `vehicle` or `vehicles`; legal: a record of a formation node")
    return record


def _gate_times(records: list[dict[str, Any]], start: float) -> tuple[Array, Array]:
    """When rows were commanded, and when reached, in simulated time [s]."""
    command = start + np.array(records[0]["command_time_s"], dtype=np.float64)
    # All processes decide alike; a record written earlier than the others knows less.
    reached = min(len(record["arrival_time_s"]) for record in records)
    return command, start + np.array(records[0]["arrival_time_s"][:reached], dtype=np.float64)


def _combine(names: list[str], records: list[dict[str, Any]], errors: list[str]) -> Command:
    first = records[0]
    start = float(first["start_time_s"])
    rows = np.stack([np.array(record["rows"], dtype=np.float64) for record in records], axis=1)
    offset: Array | None = None
    if first["mode"] == GATE:
        command, arrival = _gate_times(records, start)
        offset = np.array([record["steady_offset_m"] for record in records], dtype=np.float64)
        hover_end = float(arrival[0]) if len(arrival) else np.inf
    else:
        command = arrival = start + np.array(first["row_time_s"], dtype=np.float64)
        hover_end = float(arrival[0])
    if first["mode"] == FOLLOW:
        # Nobody hovers: places move on from the beginning.
        offset = np.zeros((len(records), 3))
        hover_end = start + float(first["hover_end_s"])
    return Command(
        names=names,
        mode=first["mode"],
        file=str(first["source"]["file"]),
        rows=rows,
        paths=[_path(record["knots"], start) for record in records],
        hover_s=(start + float(first["first_row_s"]), hover_end),
        command_s=command,
        arrival_s=arrival,
        steady_offset=offset,
        errors=errors,
    )


def _path(knots: dict[str, Any], start: float) -> QuinticPath:
    position, velocity, acceleration = (
        np.array(knots[name], dtype=np.float64)[:, None]
        for name in ("position", "velocity", "acceleration")
    )
    time = start + np.array(knots["time_s"], dtype=np.float64)
    return QuinticPath(time, position, velocity, acceleration)
