# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that died during a run, as `./trident run` has noted them in faults.json."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.core.verdict import Verdict

FAULTS_FILE = "faults.json"


@dataclass(frozen=True)
class Fault:
    """One of them.

    Attributes:
        node: its name.
        cause: what ended it, in words.
        is_fatal: whether the run could not do without it.
    """

    node: str
    cause: str
    is_fatal: bool


def read_faults(folder: Path) -> list[Fault]:
    """Those of a run, in the order of their deaths.

    Raises:
        EvalError: the file is not what `./trident run` writes.
    """
    path = folder / FAULTS_FILE
    if not path.is_file():
        return []
    try:
        found: list[dict[str, Any]] = json.loads(path.read_text(encoding="utf-8"))
        return [Fault(str(f["node"]), str(f["cause"]), bool(f["is_fatal"])) for f in found]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise EvalError(f"{path}: {error}; legal: a list of node, cause, is_fatal") from error


def add_faults(verdict: Verdict, faults: list[Fault], notes: list[str]) -> None:
    """Put them into a verdict: the first cause before all other reasons.

    Args:
        verdict: of the run, so far.
        faults: that happened.
        notes: what else is to be reported, and no reason against the run.
    """
    reasons = [f"{fault.node} {fault.cause}" for fault in faults if fault.is_fatal]
    verdict.reasons[:0] = reasons
    survived = [f"{fault.node} {fault.cause}" for fault in faults if not fault.is_fatal]
    verdict.numbers["notes"] = [*verdict.numbers.get("notes", []), *survived, *notes]
