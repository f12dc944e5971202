# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a vehicle sent as NMEA 0183 during a run, read apart from what wrote it, and the truth.

`<vehicle>.nmea` is the stream as a client got it, `<vehicle>.nmea.json` says where the antenna and
the world's origin are. A position is compared with that of the antenna at the same UTC.
"""

from __future__ import annotations

import csv
import json
import re
from collections import Counter
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation, Slerp
from trident_fleet.core.station.geodesy import Datum

from trident_eval.core.errors import EvalError
from trident_eval.core.rows import Row, value_text
from trident_eval.core.tracks import Array, whole_lines
from trident_eval.core.verdict import Verdict

POSITION_LIMIT_M = 0.1
LONGEST_LINE = 82  # characters with CR and LF
RTK_FIXED = 4
_SUFFIX = ".nmea"
_LINE = re.compile(r"[$!](?P<body>[^$!*\r\n]*)\*(?P<sum>[0-9A-Fa-f]{2})\r")
_STATE = ("t", "x", "y", "z", "qx", "qy", "qz", "qw")


@dataclass(frozen=True)
class NmeaLog:
    """What came of one vehicle's stream.

    Attributes:
        vehicle: its name.
        sentences: how many came, by type.
        wrong: lines with a wrong checksum or without one.
        longest: characters of the longest line, with its end.
        time: simulated time of the M positions [s], shape (M,).
        quality: of each, as GGA has it, shape (M,).
        p_enu: east, north and up from the world's origin [m], shape (M, 3).
        truth: of the antenna at the same time [m], shape (M, 3); NaN where it is not known.
    """

    vehicle: str
    sentences: dict[str, int]
    wrong: int
    longest: int
    time: Array
    quality: Array
    p_enu: Array
    truth: Array

    @property
    def is_fixed(self) -> Any:
        """Which positions are RTK fixed and can be compared, shape (M,)."""
        return (self.quality == RTK_FIXED) & np.isfinite(self.truth).all(axis=1)

    @property
    def error_m(self) -> Array:
        """Level distance from the truth, shape (M,)."""
        return np.asarray(np.hypot(*(self.p_enu - self.truth)[:, :2].T))


def checksum(body: str) -> int:
    """XOR of the characters between "$" and "*"."""
    value = 0
    for character in body:
        value ^= ord(character)
    return value


def degrees(field: str, letter: str) -> float:
    """Of ddmm.mmmmm or dddmm.mmmmm and N, S, E or W."""
    whole, minutes = divmod(float(field), 100.0)
    return (whole + minutes / 60.0) * (-1.0 if letter in "SW" else 1.0)


class _Stream:
    """Counts sentences, and collects the positions of GGA, whose day is of the last RMC or ZDA."""

    def __init__(self, datum: Datum, start: datetime) -> None:
        self._datum, self._start = datum, start
        self._day: datetime | None = None
        self.rows: list[tuple[float, int, Array]] = []
        self.sentences: Counter[str] = Counter()
        self.wrong = self.longest = 0

    def take(self, line: bytes) -> None:
        """Read and count a line without its end."""
        self.longest = max(self.longest, len(line) + 1)
        found = _LINE.fullmatch(line.decode("latin1"))
        if found is None or checksum(found["body"]) != int(found["sum"], 16):
            self.wrong += 1
            return
        fields = found["body"].split(",")
        try:
            self.add(fields)
        except (IndexError, ValueError):  # a field that is not there, or says nothing
            self.wrong += 1
            return
        self.sentences[fields[0][2:]] += 1

    def arrays(self) -> tuple[Array, Array, Array]:
        """Times, shape (M,), qualities, shape (M,), and places, shape (M, 3), of all positions."""
        time = np.array([row[0] for row in self.rows])
        quality = np.array([row[1] for row in self.rows], float)
        return time, quality, np.array([row[2] for row in self.rows]).reshape(-1, 3)

    def add(self, fields: list[str]) -> None:
        kind = fields[0][2:]
        if kind == "RMC" and fields[9]:
            self._day = datetime.strptime(fields[9], "%d%m%y").replace(tzinfo=UTC)
        elif kind == "ZDA" and fields[2]:
            self._day = datetime(int(fields[4]), int(fields[3]), int(fields[2]), tzinfo=UTC)
        elif kind == "GGA" and fields[2] and self._day:
            seconds = float(fields[1][4:])
            time = timedelta(hours=int(fields[1][:2]), minutes=int(fields[1][2:4]), seconds=seconds)
            at_s = (self._day + time - self._start).total_seconds()
            latitude, longitude = degrees(fields[2], fields[3]), degrees(fields[4], fields[5])
            height = float(fields[9]) + float(fields[11] or 0.0)
            p_enu = self._datum.position(latitude, longitude, height)
            self.rows.append((at_s, int(fields[6]), p_enu))


def _states(path: Path, vehicle: str) -> list[list[float]]:
    """The states of a vehicle: time, position and orientation."""
    rows = []
    try:
        with path.open(newline="", encoding="utf-8") as stream:
            for row in csv.DictReader(whole_lines(stream)):
                if row["name"] == vehicle:
                    rows.append([float(row[column]) for column in _STATE])
    except (OSError, KeyError, ValueError) as error:
        raise EvalError(f"{path}: {error}; legal: the states of a run") from error
    return rows


def _truth(path: Path, vehicle: str, antenna: Array, time: Array) -> Array:
    """Where the antenna was [m], shape (M, 3); NaN outside of what is known."""
    rows = _states(path, vehicle)
    result = np.full((len(time), 3), np.nan)
    if len(rows) < 2:
        return result
    states = np.array(rows)
    states = states[np.unique(states[:, 0], return_index=True)[1]]
    known = (time >= states[0, 0]) & (time <= states[-1, 0])
    at = time[known]
    if not len(at):
        return result
    p = np.column_stack([np.interp(at, states[:, 0], states[:, i]) for i in (1, 2, 3)])
    turned = Slerp(states[:, 0], Rotation.from_quat(states[:, 4:]))(at)
    result[known] = p + turned.apply(antenna)
    return result


def _read(path: Path) -> NmeaLog:
    about_path = path.with_suffix(".nmea.json")
    try:
        about = json.loads(about_path.read_text(encoding="utf-8"))
        latitude, longitude, height = (float(value) for value in about["origin"])
        antenna = np.array([float(value) for value in about["antenna"]])
        start = datetime.fromisoformat(about["utc_start"].replace("Z", "+00:00"))
        blocks = path.read_bytes().split(b"\n")
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise EvalError(f"{about_path}: {error}; legal: what nmea_log.py writes") from error
    stream = _Stream(Datum(latitude, longitude, height), start)
    for block in blocks[:-1]:  # the last one is torn by the end of the run
        stream.take(block)
    time, quality, p_enu = stream.arrays()
    truth = _truth(path.parent / "states.csv", about["vehicle"], antenna, time)
    sentences, wrong = dict(stream.sentences), stream.wrong
    longest = stream.longest
    return NmeaLog(about["vehicle"], sentences, wrong, longest, time, quality, p_enu, truth)


def read_nmea(folder: Path) -> list[NmeaLog]:
    """All streams of a run, by vehicle.

    Raises:
        EvalError: a file is not what nmea_log.py writes.
    """
    return [_read(path) for path in sorted(folder.glob(f"*{_SUFFIX}"))]


def _against(log: NmeaLog, error_m: Array) -> list[str]:
    """What speaks against a stream, whose RTK fixed positions are so far from the truth [m]."""
    reasons = []
    if log.wrong:
        reasons.append(
            f"{log.wrong} lines that are no sentences with a right checksum, legal: none"
        )
    if log.longest > LONGEST_LINE:
        reasons.append(f"a line of {log.longest} characters, legal: {LONGEST_LINE}")
    if not len(error_m):
        reasons.append("no RTK fixed position that can be compared with the truth")
    elif error_m.max() > POSITION_LIMIT_M:
        reasons.append(
            f"an RTK fixed position {error_m.max():.3f} m from the truth,"
            f" legal: {POSITION_LIMIT_M} m"
        )
    return reasons


def judge_nmea(log: NmeaLog) -> tuple[dict[str, Any], list[str]]:
    """Numbers of a stream, and reasons against it."""
    fixed = log.is_fixed
    error = log.error_m[fixed]
    height = np.abs((log.p_enu - log.truth)[fixed, 2])
    has_fixes = bool(fixed.any())
    numbers = {
        "vehicle": log.vehicle,
        "sentences": sum(log.sentences.values()),
        "types": dict(sorted(log.sentences.items())),
        "wrong_lines": log.wrong,
        "longest_line": log.longest,
        "positions": len(log.time),
        "rtk_fixed": int(fixed.sum()),
        "position_rms_m": float(np.sqrt((error**2).mean())) if has_fixes else None,
        "position_max_m": float(error.max()) if has_fixes else None,
        "position_limit_m": POSITION_LIMIT_M,
        "height_max_m": float(height.max()) if has_fixes else None,
    }
    reasons = _against(log, error)
    numbers["satisfied"] = not reasons
    return numbers, [f"{log.vehicle}, NMEA: {reason}" for reason in reasons]


def add_nmea(verdict: Verdict, folder: Path) -> None:
    """Adds what vehicles sent as NMEA 0183 to a verdict, where a run has it."""
    try:
        logs = read_nmea(folder)
    except EvalError as error:
        verdict.reasons.append(str(error))
        return
    judged = [judge_nmea(log) for log in logs]
    if judged:
        verdict.numbers["nmea"] = [numbers for numbers, _ in judged]
        verdict.reasons += [reason for _, reasons in judged for reason in reasons]


def nmea_rows(verdict: dict[str, Any]) -> list[Row]:
    """What vehicles sent as NMEA 0183, and how far their RTK fixed positions were off."""
    return [_nmea_row(numbers) for numbers in verdict.get("nmea") or []]


def _nmea_row(numbers: dict[str, Any]) -> Row:
    value = f"{numbers['sentences']} sentences, {numbers['rtk_fixed']} RTK fixed positions"
    if numbers["position_max_m"] is not None:
        value += f" within {value_text(numbers['position_max_m'], 'm')}"
    limit = f"at most {value_text(numbers['position_limit_m'], 'm')}, no wrong line"
    return Row(f"NMEA of {numbers['vehicle']}", value, limit, numbers["satisfied"])
