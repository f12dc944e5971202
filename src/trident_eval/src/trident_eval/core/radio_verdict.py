# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What crossed between robots by rules, in a verdict."""

from __future__ import annotations

from pathlib import Path

from trident_eval.core.calls import judge_calls
from trident_eval.core.errors import EvalError
from trident_eval.core.provenance import read_object
from trident_eval.core.relay import judge_links
from trident_eval.core.verdict import Verdict


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
