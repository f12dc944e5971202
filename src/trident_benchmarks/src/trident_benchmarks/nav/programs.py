# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Benchmark programs of trident_nav that print a line of JSON per row."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Sequence
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import program

_LIMIT_S = 1800.0  # wall time


def rows_of(name: str, words: Sequence[str] = ()) -> list[dict[str, Any]]:
    """The rows that a program prints.

    Raises:
        EvalError: it is not built, failed, or printed something else; with what it said.
    """
    command = [program("trident_nav", name), *words]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, check=False, timeout=_LIMIT_S
        )
    except subprocess.TimeoutExpired as error:
        raise EvalError(f"{name}: not ended after {_LIMIT_S:g} s") from error
    if done.returncode != 0:
        raise EvalError(f"{name}: exit code {done.returncode}: {done.stderr.strip()[-200:]}")
    try:
        return [json.loads(line) for line in done.stdout.splitlines()]
    except ValueError as error:
        raise EvalError(f"{name}: a line is not JSON: {error}") from error
