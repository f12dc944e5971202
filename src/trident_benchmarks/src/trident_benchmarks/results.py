# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What benchmarks say and write: lines on stderr, rows of cases, a JSON file."""

from __future__ import annotations

import argparse
import json
import shlex
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from datetime import datetime
from pathlib import Path
from types import ModuleType
from typing import Any

from trident_eval.core.errors import EvalError

from trident_benchmarks.machine import describe_commit, describe_machine

MEASURED, FAILED, UNUSABLE = 0, 1, 2


def say(text: str) -> None:
    """One line on stderr: stdout is the result's."""
    print(text, file=sys.stderr, flush=True)


def measure_cases(
    bench: ModuleType, cases: Sequence[Any], options: argparse.Namespace, document: dict[str, Any]
) -> None:
    """A row per case of ``coast`` or ``sensors``; what has been measured is kept in any case."""
    for number, case in enumerate(cases, 1):
        row = measure_case(bench, case, options)
        document["rows"].append(row)
        say(f"[{number}/{len(cases)}] {bench.line(row)}")
        write_document(options.out, document | bench.headline(document["rows"]))


def measure_case(bench: ModuleType, case: Any, options: argparse.Namespace) -> dict[str, Any]:
    """The row of a case; one with the reason if it cannot be measured."""
    runs = options.runs or (1 if options.quick else 3)
    row: dict[str, Any]
    try:
        row = bench.measure(case, runs, options.quick)
    except EvalError as error:
        say(str(error))
        row = bench.failed(case, str(error).splitlines()[0])
    return row


def keep_rows(
    rows: Iterable[dict[str, Any]],
    line: Callable[[dict[str, Any]], str],
    out: Path | None,
    document: dict[str, Any],
) -> None:
    """Print each row as it is measured, and write the document with it.

    Args:
        rows: that are measured one by one.
        line: a row as text.
        out: file of the document; None: nothing is written.
        document: that the rows go into.
    """
    for row in rows:
        print(line(row), flush=True)
        document["rows"].append(row)
        write_document(out, document)


def keeps(figures: Mapping[str, float], limits: Mapping[str, float]) -> bool:
    """Whether no figure is above its limit."""
    return all(figures[name] <= limit for name, limit in limits.items())


def limits_code(document: dict[str, Any]) -> int:
    """The exit code: whether all rows keep their limits."""
    return MEASURED if all(row["passed"] for row in document["rows"]) else FAILED


def errors_code(document: dict[str, Any]) -> int:
    """The exit code: whether all rows could be measured."""
    return FAILED if any("error" in row for row in document["rows"]) else MEASURED


def check_folder(out: Path | None) -> None:
    """Refuse a file whose folder is not there, before anything is measured.

    Raises:
        EvalError: it is not.
    """
    if out and not out.parent.is_dir():
        raise EvalError(f"--out {out}: its folder does not exist")


def new_document() -> dict[str, Any]:
    """What was measured, when and on what."""
    return {
        "command": shlex.join(["./trident", "bench", *sys.argv[1:]]),
        "started": datetime.now().astimezone().isoformat(timespec="seconds"),
        "commit": describe_commit(Path(__file__).resolve().parent),
        "machine": describe_machine(),
    }


def write_document(path: Path | None, document: dict[str, Any]) -> None:
    """Write the file; a reader sees the old one or the new one. None: nothing is written."""
    if path is None:
        return
    text = json.dumps(document, indent=2, allow_nan=False) + "\n"
    temporary = path.with_name(f".{path.name}.part")
    temporary.write_text(text, encoding="utf-8")
    temporary.replace(path)
