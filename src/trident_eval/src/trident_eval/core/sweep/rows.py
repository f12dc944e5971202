# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a run has given: one file for each, written whole or not at all."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError

DONE, FAILED = "done", "failed"
ROWS = "rows"  # folder of the rows in that of the sweep
_TEMPORARY = ".part"


@dataclass(frozen=True)
class RunRow:
    """The outcome of one run.

    Attributes:
        key: of the job.
        point: index of its point.
        seed: of the run.
        parameters: of the run.
        status: `done` or `failed`.
        reason: why it has failed; "" if it has not.
        metrics: by name; empty if it has failed.
        started: wall-clock time in ISO 8601.
        elapsed_s: wall-clock time that it took.
        cpu_s: of the process and its children.
        memory_mb: resident, at most.
        worker: host and process.
    """

    key: str
    point: int
    seed: int
    parameters: Mapping[str, Any]
    status: str
    reason: str
    metrics: Mapping[str, float]
    started: str
    elapsed_s: float
    cpu_s: float
    memory_mb: float
    worker: str

    def to_json(self) -> dict[str, Any]:
        """For a file."""
        return asdict(self)


def checked_metrics(result: Any, names: tuple[str, ...]) -> dict[str, float]:
    """The metrics of a run's result.

    Args:
        result: what the run has given.
        names: of the numbers that are wanted.

    Raises:
        EvalError: no mapping, a number that is missing, or none that is finite.
    """
    if not isinstance(result, Mapping):
        raise EvalError(f"the result is a {type(result).__name__}; legal: {{metric: number}}")
    return {name: _checked_metric(result, name) for name in names}


def _checked_metric(result: Mapping[str, Any], name: str) -> float:
    if name not in result:
        known = ", ".join(map(str, list(result)[:20]))
        raise EvalError(f"{name}: not in the result, which has {known or 'nothing'}")
    value = result[name]
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise EvalError(f"{name}: {value!r}; legal: a finite number") from None
    if not math.isfinite(number):
        raise EvalError(f"{name}: {number}; legal: a finite number")
    return number


def row_path(folder: Path, key: str) -> Path:
    """The file of a run in the folder of a sweep."""
    return folder / ROWS / key[:2] / f"{key}.json"


def write_row(folder: Path, row: RunRow) -> None:
    """Writes a row so that it is there whole or not at all, also if the machine loses its power."""
    path = row_path(folder, row.key)
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_suffix(f"{_TEMPORARY}{os.getpid()}")
    text = json.dumps(row.to_json(), sort_keys=True, allow_nan=False)
    try:
        with temporary.open("w", encoding="utf-8") as stream:
            stream.write(text + "\n")
            stream.flush()
            os.fsync(stream.fileno())
        temporary.replace(path)
    except OSError:
        temporary.unlink(missing_ok=True)
        raise


def read_row(folder: Path, key: str) -> RunRow | None:
    """The row of a run; None if it is missing, or not whole."""
    try:
        return _parse(row_path(folder, key).read_bytes())
    except FileNotFoundError:
        return None


def all_rows(folder: Path) -> Iterator[RunRow]:
    """All rows in the folder of a sweep, those of other code too."""
    for path in sorted((folder / ROWS).glob("*/*.json")):
        row = _parse(path.read_bytes())
        if row is not None:
            yield row


def _parse(data: bytes) -> RunRow | None:
    try:
        return RunRow(**json.loads(data))
    except (ValueError, TypeError):
        return None  # of another program, or half lost with a disk: the run is made once more


def remove_parts(folder: Path) -> None:
    """Removes what writers that were killed have left."""
    for path in (folder / ROWS).glob(f"*/*{_TEMPORARY}*"):
        path.unlink(missing_ok=True)
