# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Topics that crossed between robots by rules: `relay` of `run.json`."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.core.run_entries import read_entries

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
    flows = read_entries(RelayFlow, run, "relay", where)
    for index, flow in enumerate(flows):
        if flow.thinned > flow.offered:
            raise EvalError(
                f"{where}: relay[{index}].thinned: {flow.thinned}; "
                f"legal: at most offered, {flow.offered}"
            )
    return flows


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
