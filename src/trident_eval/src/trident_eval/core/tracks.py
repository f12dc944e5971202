# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Where the vehicles of a run were: `states.csv` as arrays."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from trident_eval.core.errors import EvalError

Array = npt.NDArray[np.float64]

_NEEDED = ("t", "name", "x", "y", "z")


class NoStatesError(EvalError):
    """A `states.csv` in which no vehicle ever was."""


@dataclass(frozen=True)
class Tracks:
    """Positions of N vehicles at M common instants.

    Attributes:
        names: of the vehicles, in alphabetical order.
        time: simulated time [s], increasing, shape (M,).
        position: p_world [m], shape (M, N, 3); NaN where a vehicle has no state.
    """

    names: list[str]
    time: Array
    position: Array

    def select(self, names: list[str]) -> Tracks:
        """The same with these vehicles, in this order; all NaN for one that never was there."""
        position = np.full((len(self.time), len(names), 3), np.nan)
        for column, name in enumerate(names):
            if name in self.names:
                position[:, column] = self.position[:, self.names.index(name)]
        return Tracks(names, self.time, position)

    def between(self, start: float, end: float) -> Tracks:
        """The instants from `start` to `end` [s], both included."""
        slack = 1e-6
        inside = (self.time >= start - slack) & (self.time <= end + slack)
        return Tracks(self.names, self.time[inside], self.position[inside])


def whole_lines(stream: Iterable[str]) -> Iterator[str]:
    """The lines without a last one that has no end."""
    return (line for line in stream if line.endswith(("\n", "\r")))


def _reader(path: Path, stream: Iterable[str]) -> csv.DictReader[str]:
    """The rows, whose columns have been checked."""
    reader = csv.DictReader(whole_lines(stream))
    missing = [name for name in _NEEDED if name not in (reader.fieldnames or [])]
    if missing:
        raise EvalError(f"{path}:1: no column {', '.join(missing)}; legal: t,name,x,y,z,...")
    return reader


def read_states(path: Path) -> Tracks:
    """Read a `states.csv`: columns t, name, x, y, z and any others, one line per vehicle and time.

    A last line without its end is left out: a simulator that was killed has torn it.

    Raises:
        NoStatesError: no vehicle was there.
        EvalError: unreadable file, a missing column, a cell that is no number.
    """
    stamps: list[float] = []
    names: list[str] = []
    positions: list[list[float]] = []
    try:
        with path.open(newline="", encoding="utf-8") as stream:
            reader = _reader(path, stream)
            for row in reader:
                stamp, x, y, z = _numbers(row, f"{path}:{reader.line_num}")
                stamps.append(stamp)
                names.append(row["name"])
                positions.append([x, y, z])
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or error
        raise EvalError(f"{path}: {reason}; legal: a readable states.csv") from error
    if not stamps:
        raise NoStatesError(f"{path}: no states; legal: one line per vehicle and time")
    return tracks_of(stamps, names, positions)


def tracks_of(stamps: list[float], names: list[str], positions: list[list[float]]) -> Tracks:
    """Arrange single states, in any order, into common instants."""
    columns = {name: index for index, name in enumerate(sorted(set(names)))}
    # Microseconds: finer than any step, coarser than the rounding of text.
    ticks = np.round(np.array(stamps) * 1e6).astype(np.int64)
    instants, row = np.unique(ticks, return_inverse=True)
    position = np.full((len(instants), len(columns), 3), np.nan)
    position[row, [columns[name] for name in names]] = positions
    return Tracks(list(columns), instants / 1e6, position)


def _numbers(row: dict[str, str], where: str) -> list[float]:
    values = []
    for name in ("t", "x", "y", "z"):
        try:
            values.append(float(row[name]))
        except (TypeError, ValueError) as error:
            raise EvalError(f"{where}: {name}: {row[name]!r}; legal: a number") from error
    if not np.isfinite(values[0]) or abs(values[0]) > 1e9:
        raise EvalError(f"{where}: t: {row['t']}; legal: seconds, at most 1e9")
    return values
