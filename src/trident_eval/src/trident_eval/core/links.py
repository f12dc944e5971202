# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What radios carried during a run: `links.csv`, and `relay` of `run.json`."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from trident_eval.core.errors import EvalError
from trident_eval.core.provenance import read_object
from trident_eval.core.tracks import Array, whole_lines
from trident_eval.core.verdict import Verdict

LINKS_FILE = "links.csv"
#: As a destination: a broadcast as it was sent; what arrived is in the entries of its receivers.
ALL = "all"
_ROUNDING_S = 1e-9


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


@dataclass(frozen=True)
class RelayFlow:
    """What became of the messages of a rule from one robot to another.

    Attributes:
        rule: its number and topic, as in "rule 2 (detections)".
        reliable: whether messages are acknowledged and sent again.
        deadline_s: greatest age of a message [s]; 0: any.
        source: robot.
        destination: robot, or ALL.
        offered: messages that the topic had.
        thinned: of these, left out because the rule limits their rate.
        superseded: dropped for newer ones.
        expired: too old, at either end.
        refused: did not fit into the radio's queue.
        delivered: whole, each once.
        doubles: datagrams that had arrived before.
        datagrams: that were sent.
        resent: of these, those that were sent before.
        delay_mean_s: age at the delivery [s]; 0: nothing was delivered.
        delay_max_s: the same, the greatest.
    """

    rule: str
    reliable: bool
    deadline_s: float
    source: str
    destination: str
    offered: int
    thinned: int
    superseded: int
    expired: int
    refused: int
    delivered: int
    doubles: int
    datagrams: int
    resent: int
    delay_mean_s: float
    delay_max_s: float

    @property
    def to_send(self) -> int:
        """Messages that were to cross."""
        return self.offered - self.thinned

    @property
    def is_late(self) -> bool:
        """Whether a message was delivered after its deadline."""
        return self.deadline_s > 0.0 and self.delay_max_s > self.deadline_s + _ROUNDING_S


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
    return _arranged(pairs, np.array(cells)) if cells else None


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


def read_relay(run: dict[str, Any], where: str) -> list[RelayFlow]:
    """What crossed by rules.

    Args:
        run: run.json; may be empty.
        where: its path, for messages.

    Returns:
        An entry for each rule, source and destination; none of a world without rules.

    Raises:
        EvalError: an entry is not what the simulator writes.
    """
    found = run.get("relay", [])
    if not isinstance(found, list):
        raise EvalError(f"{where}: relay: {found!r}; legal: a list of objects")
    return [_flow(f"{where}: relay[{index}]", entry) for index, entry in enumerate(found)]


def _flow(where: str, entry: Any) -> RelayFlow:
    if not isinstance(entry, dict):
        raise EvalError(f"{where}: {entry!r}; legal: an object")
    values = {}
    for field in fields(RelayFlow):
        if field.name not in entry:
            raise EvalError(f"{where}.{field.name}: missing; legal: {_LEGAL[str(field.type)]}")
        value = entry[field.name]
        if not _is_of(str(field.type), value):
            raise EvalError(f"{where}.{field.name}: {value!r}; legal: {_LEGAL[str(field.type)]}")
        values[field.name] = value
    flow = RelayFlow(**values)
    if flow.thinned > flow.offered:
        raise EvalError(f"{where}.thinned: {flow.thinned}; legal: at most offered, {flow.offered}")
    return flow


_LEGAL = {
    "str": "a text that is not empty",
    "bool": "true or false",
    "int": "a whole number, at least 0",
    "float": "a number, at least 0",
}


def _is_of(kind: str, value: Any) -> bool:
    if kind == "str":
        return isinstance(value, str) and value != ""
    if kind == "bool" or isinstance(value, bool):
        return kind == "bool" and isinstance(value, bool)
    if kind == "int":
        return isinstance(value, int) and value >= 0
    return isinstance(value, int | float) and 0.0 <= value < math.inf


def judge_links(
    run: dict[str, Any], where: str = "run.json"
) -> tuple[list[dict[str, Any]], list[str]]:
    """Judge what crossed by rules.

    Args:
        run: run.json; may be empty.
        where: its path, for messages.

    Returns:
        A row for each rule, source and destination (a broadcast's are the robots that heard it,
        or ALL if nothing arrived), and the reasons against the run.

    Raises:
        EvalError: `relay` is not what the simulator writes.
    """
    groups: dict[tuple[str, str], list[RelayFlow]] = {}
    for flow in read_relay(run, where):
        groups.setdefault((flow.rule, flow.source), []).append(flow)
    rows: list[dict[str, Any]] = []
    reasons: list[str] = []
    for flows in groups.values():
        found = _rows_of_source(flows)
        rows += found
        reasons += _reasons(flows, max(row["offered"] for row in found))
    return rows, reasons


def _rows_of_source(flows: list[RelayFlow]) -> list[dict[str, Any]]:
    """Rows of one rule and source."""
    broadcast = sum(flow.to_send for flow in flows if flow.destination == ALL)
    has_arrived = any(flow.delivered for flow in flows)
    rows = []
    for flow in [flow for flow in flows if flow.destination != ALL] or flows:
        own = 0 if flow.destination == ALL else flow.to_send
        rows.append(_row(flow, own + broadcast, has_arrived))
    return rows


def _row(flow: RelayFlow, offered: int, has_arrived: bool) -> dict[str, Any]:
    return {
        "rule": flow.rule,
        "source": flow.source,
        "destination": flow.destination,
        "reliable": flow.reliable,
        "deadline_s": flow.deadline_s,
        "offered": offered,
        "delivered": flow.delivered,
        "share": flow.delivered / offered if offered else None,
        "delay_mean_s": flow.delay_mean_s if flow.delivered else None,
        "delay_max_s": flow.delay_max_s if flow.delivered else None,
        "satisfied": (has_arrived or not offered) and not flow.is_late,
    }


def _reasons(flows: list[RelayFlow], offered: int) -> list[str]:
    """Against one rule and source."""
    rule, source = flows[0].rule, flows[0].source
    if offered and not any(flow.delivered for flow in flows):
        count = f"{offered} message{'s' * (offered != 1)}"
        return [f"{rule}: nothing of {count} of {source} has arrived"]
    return [
        f"{rule}: a message of {source} reached {flow.destination} after {flow.delay_max_s:.6g} s,"
        f" deadline {flow.deadline_s:g} s"
        for flow in flows
        if flow.is_late
    ]


def add_links(verdict: Verdict, folder: Path) -> None:
    """Put what crossed by rules into a verdict, as `relay`; nothing of a world without rules.

    Args:
        verdict: of the run, so far.
        folder: of the run.
    """
    path = folder / "run.json"
    try:
        rows, reasons = judge_links(read_object(path), str(path))
    except EvalError as error:
        rows, reasons = [], [str(error)]
    if rows:
        verdict.numbers["relay"] = rows
    verdict.reasons += reasons
