# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Programs of packages that measure, and print a line of JSON per row."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Sequence
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import program


def rows_of(
    package: str, name: str, words: Sequence[str] = (), limit_s: float = 7200.0
) -> list[dict[str, Any]]:
    """The rows that a program prints.

    Args:
        package: it belongs to.
        name: of it.
        words: of its command line.
        limit_s: wall time that it may take [s].

    Raises:
        EvalError: it is not built, failed, or printed something else; with what it said.
    """
    command = [program(package, name), *words]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=limit_s)
    except subprocess.TimeoutExpired as error:
        raise EvalError(f"{name}: not ended after {limit_s:g} s") from error
    if done.returncode != 0:
        raise EvalError(f"{name}: exit code {done.returncode}: {done.stderr.strip()[-200:]}")
    try:
        return [json.loads(line) for line in done.stdout.splitlines()]
    except ValueError as error:
        raise EvalError(f"{name}: a line is not JSON: {error}") from error
