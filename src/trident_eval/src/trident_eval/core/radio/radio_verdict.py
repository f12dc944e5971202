# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What crossed between robots by rules, in a verdict."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.core.provenance import read_object
from trident_eval.core.radio.calls import judge_calls
from trident_eval.core.radio.relay import judge_links
from trident_eval.core.rows import Row
from trident_eval.core.verdict import Verdict

_NAME_OF_RULE = re.compile(r"\((.+)\)$")


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


def radio_rows(verdict: dict[str, Any]) -> list[Row]:
    """What crossed by each rule, and how many calls were answered by radio."""
    rows = [_relay_row(numbers) for numbers in verdict.get("relay") or []]
    return rows + [_call_row(numbers) for numbers in verdict.get("calls") or []]


def _relay_row(numbers: dict[str, Any]) -> Row:
    """What arrived of one robot's topic at another robot by radio."""
    value = f"{numbers['delivered']} of {numbers['offered']}"
    return _radio_row(numbers, numbers["source"], numbers["destination"], value)


def _call_row(numbers: dict[str, Any]) -> Row:
    """How many calls of a robot's service by another one were answered by radio."""
    value = f"{numbers['answered']} of {numbers['called']} calls answered"
    return _radio_row(numbers, numbers["caller"], numbers["server"], value)


def _radio_row(numbers: dict[str, Any], source: str, destination: str, value: str) -> Row:
    """By a rule, with its delays, if there is any."""
    named = _NAME_OF_RULE.search(numbers["rule"])
    name = named[1] if named else numbers["rule"]
    if numbers["delay_max_s"] is not None:
        mean, longest = numbers["delay_mean_s"], numbers["delay_max_s"]
        value += f", delay {_delay_text(mean)}, at most {_delay_text(longest)}"
    deadline_s, is_satisfied = numbers["deadline_s"], numbers["satisfied"]
    limit = f"delay at most {deadline_s:g} s" if deadline_s else ""
    has_limit = bool(limit) or not is_satisfied
    label = f"{name} {source} -> {destination}"
    return Row(label, value, limit, is_satisfied if has_limit else None)


def _delay_text(delay_s: float) -> str:
    return f"{1e3 * delay_s:.1f} ms" if delay_s < 1.0 else f"{delay_s:.2f} s"
