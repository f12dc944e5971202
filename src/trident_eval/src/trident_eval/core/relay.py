# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What crossed between robots by rules: `relay` and `calls` of `run.json`."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, TypeVar

from trident_eval.core.errors import EvalError
from trident_eval.core.provenance import read_object
from trident_eval.core.verdict import Verdict

#: As a destination: a broadcast as it was sent; what arrived is in the entries of its receivers.
ALL = "all"
_ROUNDING_S = 1e-9
#: What was sent so shortly before the end may still be on its path.
_ON_ITS_PATH_S = 1.0


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
        first_s: simulated time at which the first was to be sent [s]; 0: none was.
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
    first_s: float
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


@dataclass(frozen=True)
class CallFlow:
    """What became of the calls of a service by one robot of another.

    Attributes:
        rule: its number and service, as in "rule 3 (arm)".
        deadline_s: after it a call is an error [s].
        caller: robot.
        server: robot.
        called: calls in all; what is in none of the next ones was in progress at the end.
        answered: by the server.
        failed: there was no server, or it reported an error.
        refused: too large, or too many at once.
        expired: no answer had come by the deadline.
        aborted: ended for another reason.
        delay_mean_s: from a call to its answer [s]; 0: none was answered.
        delay_max_s: the same, the greatest.
    """

    rule: str
    deadline_s: float
    caller: str
    server: str
    called: int
    answered: int
    failed: int
    refused: int
    expired: int
    aborted: int
    delay_mean_s: float
    delay_max_s: float


_Flow = TypeVar("_Flow", RelayFlow, CallFlow)


def read_relay(run: dict[str, Any], where: str) -> list[RelayFlow]:
    """What crossed of topics.

    Args:
        run: run.json; may be empty.
        where: its path, for messages.

    Returns:
        An entry for each rule, source and destination; none of a world without rules.

    Raises:
        EvalError: an entry is not what the simulator writes.
    """
    flows = _read(RelayFlow, run, "relay", where)
    for index, flow in enumerate(flows):
        if flow.thinned > flow.offered:
            raise EvalError(
                f"{where}: relay[{index}].thinned: {flow.thinned}; "
                f"legal: at most offered, {flow.offered}"
            )
    return flows


def read_calls(run: dict[str, Any], where: str) -> list[CallFlow]:
    """What was called by radio.

    Args:
        run: run.json; may be empty.
        where: its path, for messages.

    Returns:
        An entry for each rule, caller and server; none of a world without rules of services.

    Raises:
        EvalError: an entry is not what the simulator writes.
    """
    return _read(CallFlow, run, "calls", where)


def _read(kind: type[_Flow], run: dict[str, Any], key: str, where: str) -> list[_Flow]:
    found = run.get(key, [])
    if not isinstance(found, list):
        raise EvalError(f"{where}: {key}: {found!r}; legal: a list of objects")
    return [_flow(kind, f"{where}: {key}[{index}]", entry) for index, entry in enumerate(found)]


def _flow(kind: type[_Flow], where: str, entry: Any) -> _Flow:
    if not isinstance(entry, dict):
        raise EvalError(f"{where}: {entry!r}; legal: an object")
    values = {}
    for field in fields(kind):
        if field.name not in entry:
            raise EvalError(f"{where}.{field.name}: missing; legal: {_LEGAL[str(field.type)]}")
        value = entry[field.name]
        if not _is_of(str(field.type), value):
            raise EvalError(f"{where}.{field.name}: {value!r}; legal: {_LEGAL[str(field.type)]}")
        values[field.name] = value
    return kind(**values)


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
        nothing = not any(flow.delivered for flow in flows) and _had_time(flows, run)
        found = _rows_of_source(flows, nothing)
        rows += found
        reasons += _reasons(flows, max(row["offered"] for row in found), nothing)
    return rows, reasons


def _had_time(flows: list[RelayFlow], run: dict[str, Any]) -> bool:
    """Whether something of one rule and source was sent so early that it would have arrived."""
    end_s = run.get("sim_s")
    last_s = end_s - _ON_ITS_PATH_S if isinstance(end_s, int | float) else math.inf
    return any(flow.to_send and flow.first_s <= last_s for flow in flows)


def _rows_of_source(flows: list[RelayFlow], nothing: bool) -> list[dict[str, Any]]:
    """Rows of one rule and source. `nothing`: there was time, and nothing has arrived."""
    broadcast = sum(flow.to_send for flow in flows if flow.destination == ALL)
    rows = []
    for flow in [flow for flow in flows if flow.destination != ALL] or flows:
        own = 0 if flow.destination == ALL else flow.to_send
        rows.append(_row(flow, own + broadcast, nothing))
    return rows


def _row(flow: RelayFlow, offered: int, nothing: bool) -> dict[str, Any]:
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
        "satisfied": not (nothing and offered) and not flow.is_late,
    }


def _reasons(flows: list[RelayFlow], offered: int, nothing: bool) -> list[str]:
    """Against one rule and source."""
    rule, source = flows[0].rule, flows[0].source
    if nothing and offered:
        count = f"{offered} message{'s' * (offered != 1)}"
        return [f"{rule}: nothing of {count} of {source} has arrived"]
    return [
        f"{rule}: a message of {source} reached {flow.destination} after {flow.delay_max_s:.6g} s,"
        f" deadline {flow.deadline_s:g} s"
        for flow in flows
        if flow.is_late
    ]


def judge_calls(
    run: dict[str, Any], where: str = "run.json"
) -> tuple[list[dict[str, Any]], list[str]]:
    """Judge what was called by radio.

    Args:
        run: run.json; may be empty.
        where: its path, for messages.

    Returns:
        A row for each rule, caller and server, and the reasons against the run: none of the calls
        that have ended was answered. A single one may fail, as its caller knows.

    Raises:
        EvalError: `calls` is not what the simulator writes.
    """
    rows: list[dict[str, Any]] = []
    reasons: list[str] = []
    for flow in read_calls(run, where):
        ended = flow.answered + flow.failed + flow.refused + flow.expired + flow.aborted
        is_satisfied = flow.answered > 0 or ended == 0
        rows.append(
            {
                "rule": flow.rule,
                "caller": flow.caller,
                "server": flow.server,
                "deadline_s": flow.deadline_s,
                "called": flow.called,
                "answered": flow.answered,
                "delay_mean_s": flow.delay_mean_s if flow.answered else None,
                "delay_max_s": flow.delay_max_s if flow.answered else None,
                "satisfied": is_satisfied,
            }
        )
        if not is_satisfied:
            count = f"{ended} call{'s' * (ended != 1)}"
            reasons.append(
                f"{flow.rule}: none of {count} of {flow.server} by {flow.caller} was answered"
            )
    return rows, reasons


def add_links(verdict: Verdict, folder: Path) -> None:
    """Put what crossed by rules into a verdict, as `relay` and `calls`; nothing without rules.

    Args:
        verdict: of the run, so far.
        folder: of the run.
    """
    path = folder / "run.json"
    try:
        run = read_object(path)
        judged = {"relay": judge_links(run, str(path)), "calls": judge_calls(run, str(path))}
    except EvalError as error:
        verdict.reasons.append(str(error))
        return
    for key, (rows, reasons) in judged.items():
        if rows:
            verdict.numbers[key] = rows
        verdict.reasons += reasons
