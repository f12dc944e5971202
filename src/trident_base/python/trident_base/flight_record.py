# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The file format of flight records: what one vehicle was commanded, `formation_<vehicle>.json`.

A record is a JSON object with the keys of `FlightRecord`. trident_fleet writes one for each
vehicle, trident_eval judges a run by them. One without `rows` is of a vehicle that did not fly.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, TypedDict

FORMAT = 1
TIME, GATE, FOLLOW = "time", "gate", "follow"
"""Modes: planned in time; row by row; the records of a leader and its followers."""
PATTERN = "formation_*.json"
"""Names of the files in the folder of a run."""


class Knots(TypedDict):
    """A path of quintic polynomials between knots, relative to `start_time_s`.

    Attributes:
        time_s: of the knots [s], T values.
        position: p_world [m], T x 3.
        velocity: v_world [m/s], T x 3.
        acceleration: a_world [m/s^2], T x 3.
    """

    time_s: list[float]
    position: list[list[float]]
    velocity: list[list[float]]
    acceleration: list[list[float]]


class FlightRecord(TypedDict, total=False):
    """Keys of a record.

    Attributes:
        format: `FORMAT`.
        vehicle: whose record it is.
        vehicles: all of the formation, in its order.
        mode: `TIME`, `GATE` or `FOLLOW`.
        start_time_s: simulated time of the start [s]; the other times count from it.
        end_time_s: simulated time of the end [s]; mode `TIME`.
        source: where the rows come from: `file`, and the reader's other arguments.
        settings: of the flight.
        rows: p_world of the vehicle in each row [m], R x 3.
        first_row_s: when the first row is reached.
        row_time_s: when each row is reached; modes `TIME` and `FOLLOW`.
        command_time_s: when each row was commanded, as far as it has come; mode `GATE`.
        arrival_time_s: when each row was reached, as far as it has come; mode `GATE`.
        hover_end_s: when all have joined; mode `FOLLOW`.
        steady_offset_m: hover error that was subtracted [m]; mode `GATE`.
        knots: planned motion; in mode `GATE` that of the take-off.
        finished: whether all rows were reached; mode `GATE`.
        error: what went wrong, if something did.
    """

    format: int
    vehicle: str
    vehicles: list[str]
    mode: str
    start_time_s: float
    end_time_s: float
    source: dict[str, Any]
    settings: dict[str, Any]
    rows: list[list[float]]
    first_row_s: float
    row_time_s: list[float]
    command_time_s: list[float]
    arrival_time_s: list[float]
    hover_end_s: float
    steady_offset_m: list[float]
    knots: Knots
    finished: bool
    error: str | None


def record_path(folder: Path, vehicle: str) -> Path:
    """Where the record of a vehicle lies."""
    return folder / f"formation_{vehicle}.json"
