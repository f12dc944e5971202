# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What radios carried during a run: `links.csv`."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from trident_eval.core.errors import EvalError
from trident_eval.core.tracks import Array, whole_lines

LINKS_FILE = "links.csv"


@dataclass(frozen=True)
class LinkLog:
    """P links, each from one radio to another, at M common instants.

    Arrays have the shape (M, P), and NaN where there was no such link.

    Attributes:
        time: simulated time [s], increasing, shape (M,).
        pairs: source and destination of each link, in alphabetical order.
        distance: from antenna to antenna [m].
        snr_db: signal over noise at the destination; -inf: they do not hear each other.
        mcs: modulation and coding scheme that frames had.
        delivered: messages since the radios were reset, as are the next three.
        lost: given up after all tries.
        expired: too old before they could be sent.
        refused: the queue was full.
        line_of_sight: 1: nothing was in the path; 0: something was.
        relayed: messages that crossed by rules, broadcasts among them.
        offered: messages that rules had for that robot alone.
    """

    time: Array
    pairs: list[tuple[str, str]]
    distance: Array
    snr_db: Array
    mcs: Array
    delivered: Array
    lost: Array
    expired: Array
    refused: Array
    line_of_sight: Array
    relayed: Array
    offered: Array


def _is_whole(value: float) -> bool:
    return math.isfinite(value) and value == int(value)


_Legal = tuple[str, Callable[[float], bool]]
_COUNT: _Legal = ("a whole number, at least 0", lambda value: _is_whole(value) and value >= 0.0)
_CELLS: dict[str, _Legal] = {
    "t": ("seconds, at most 1e9", lambda value: abs(value) <= 1e9),
    "distance": ("meters, at least 0", lambda value: 0.0 <= value < math.inf),
    "snr_db": ("dB, or -inf", lambda value: value < math.inf),
    "mcs": ("a whole number", _is_whole),
    "delivered": _COUNT,
    "lost": _COUNT,
    "expired": _COUNT,
    "refused": _COUNT,
    "line_of_sight": ("0 or 1", lambda value: value in (0.0, 1.0)),
    "relayed": _COUNT,
    "offered": _COUNT,
}
_VALUES = tuple(_CELLS)[1:]
_COLUMNS = ("t", "source", "destination", *_VALUES)


def read_links(folder: Path) -> LinkLog | None:
    """Read the `links.csv` of a run.

    A last line without its end is left out: a simulator that was killed has torn it.

    Returns:
        The links; None: the world had no radios, or there was no time to record any link.

    Raises:
        EvalError: unreadable file, a missing column, a cell that is not legal.
    """
    path = folder / LINKS_FILE
    if not path.exists():
        return None
    pairs, cells = _read_rows(path)
    return _arranged(pairs, np.array(cells)) if cells else None


def _read_rows(path: Path) -> tuple[list[tuple[str, str]], list[list[float]]]:
    """Source and destination, and the numbers, of each row."""
    pairs: list[tuple[str, str]] = []
    cells: list[list[float]] = []
    try:
        with path.open(newline="", encoding="utf-8") as stream:
            reader = csv.DictReader(whole_lines(stream))
            _check_columns(path, reader.fieldnames)
            for row in reader:
                where = f"{path}:{reader.line_num}"
                pairs.append((_name(row, "source", where), _name(row, "destination", where)))
                cells.append([_cell(row, name, where) for name in _CELLS])
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or error
        raise EvalError(f"{path}: {reason}; legal: a readable {LINKS_FILE}") from error
    return pairs, cells


def _check_columns(path: Path, found: Iterable[str] | None) -> None:
    """An empty file is one that was not flushed."""
    missing = [name for name in _COLUMNS if found is not None and name not in found]
    if missing:
        raise EvalError(f"{path}:1: no column {', '.join(missing)}; legal: {','.join(_COLUMNS)}")


def _name(row: dict[str, str], column: str, where: str) -> str:
    if not row[column]:
        raise EvalError(f"{where}: {column}: {row[column]!r}; legal: the name of a radio")
    return row[column]


def _cell(row: dict[str, str], column: str, where: str) -> float:
    legal, is_legal = _CELLS[column]
    try:
        value = float(row[column])
    except (TypeError, ValueError) as error:
        raise EvalError(f"{where}: {column}: {row[column]!r}; legal: {legal}") from error
    if not is_legal(value):
        raise EvalError(f"{where}: {column}: {row[column]!r}; legal: {legal}")
    return value


def _arranged(pairs: list[tuple[str, str]], cells: Array) -> LinkLog:
    """Lines in any order as common instants; of two lines about the same the last counts."""
    columns = {pair: index for index, pair in enumerate(sorted(set(pairs)))}
    # Microseconds: finer than any step, coarser than the rounding of text.
    instants, row = np.unique(np.round(cells[:, 0] * 1e6).astype(np.int64), return_inverse=True)
    values = np.full((len(_VALUES), len(instants), len(columns)), np.nan)
    values[:, row, [columns[pair] for pair in pairs]] = cells[:, 1:].T
    return LinkLog(instants / 1e6, list(columns), **dict(zip(_VALUES, values, strict=True)))
