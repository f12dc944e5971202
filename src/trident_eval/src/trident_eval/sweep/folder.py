# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The folder of a sweep: whose it is, and that one command at a time works in it."""

from __future__ import annotations

import contextlib
import fcntl
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.core.sweep.rows import remove_parts
from trident_eval.core.sweep.tables import replace_file

_FACTS = "sweep.json"


@contextlib.contextmanager
def opened(folder: Path) -> Iterator[None]:
    """Makes the folder, and keeps others out of it.

    Raises:
        EvalError: another sweep is at work in it, or it cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "CATKIN_IGNORE").touch()
        lock = (folder / "lock").open("w")
    except OSError as error:
        raise EvalError(f"{folder}: {error.strerror}; legal: a folder to write to") from error
    with lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise EvalError(f"{folder}: another sweep is at work in it") from None
        remove_parts(folder)
        yield


def note_of_change(folder: Path, code: str, rows: int) -> str:
    """What to say where the code is not that of the last time; "" where it is.

    Args:
        folder: of the sweep.
        code: that is run now.
        rows: of any code that are there.
    """
    try:
        before = json.loads((folder / _FACTS).read_text(encoding="utf-8"))["code"]
    except (OSError, ValueError, KeyError, TypeError):
        return ""
    if before == code or not rows:
        return ""
    return f"the code has changed, so this is a new sweep: {before} before, {code} now"


def write_facts(folder: Path, facts: dict[str, Any]) -> None:
    """Writes sweep.json."""
    replace_file(folder / _FACTS, json.dumps(facts, indent=2).encode() + b"\n")
