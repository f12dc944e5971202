# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The file format of base stations' records: where they were to be, and what they did when.

trident_fleet writes one for each base station, trident_eval judges a run by them.
"""

from __future__ import annotations

from pathlib import Path
from typing import TypedDict

STATION_FORMAT = 1
STATION_PATTERN = "base_station_*.json"
"""Names of the files in the folder of a run."""
STANDS, NOT_UP = ("on the ground", "landed"), ("on the ground", "take-off", "land", "landed")
"""Phases in which a base station stands, and in which it is not in its fence."""


class StationPhase(TypedDict):
    """What a base station began to do.

    Attributes:
        time_s: when, simulated time [s].
        phase: what it is called.
        reason: why it began.
        goal: where to, p_world [m].
        found_db: SNR of the worst link at the best place that was found [dB]; None: none yet.
    """

    time_s: float
    phase: str
    reason: str
    goal: list[float]
    found_db: float | None


class StationRecord(TypedDict):
    """Keys of a record.

    Attributes:
        format: `STATION_FORMAT`.
        vehicle: whose record it is.
        links: robots that it is to connect.
        places: of those that stand, p_world [m].
        fence: corners of the polygon [m, world].
        lowest_m: height of the fence [m, world].
        highest_m: height of the fence [m, world].
        phases: in order of time.
        error: what went wrong, if something did.
    """

    format: int
    vehicle: str
    links: list[str]
    places: dict[str, list[float]]
    fence: list[list[float]]
    lowest_m: float
    highest_m: float
    phases: list[StationPhase]
    error: str


def station_record_path(folder: Path, vehicle: str) -> Path:
    """Where the record of a base station lies."""
    return folder / f"base_station_{vehicle}.json"
