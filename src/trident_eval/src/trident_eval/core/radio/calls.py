# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Services that robots called of each other by radio: `calls` of `run.json`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from trident_eval.core.run_entries import read_entries


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
    return read_entries(CallFlow, run, "calls", where)


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
