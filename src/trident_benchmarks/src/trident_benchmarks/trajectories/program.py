# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The trial program, which prints a line of JSON for each plan."""

from __future__ import annotations

import json
import subprocess
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import program

_LIMIT_S = 7200.0  # wall time


def trials(what: str, *numbers: int) -> list[dict[str, Any]]:
    """The lines that trajectory_trial prints.

    Raises:
        EvalError: it is not built, failed, or printed something else; with what it said.
    """
    command = [program("trident_benchmarks", "trajectory_trial"), what, *map(str, numbers)]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, check=False, timeout=_LIMIT_S
        )
    except subprocess.TimeoutExpired as error:
        raise EvalError(f"trajectory_trial: not ended after {_LIMIT_S:g} s") from error
    if done.returncode != 0:
        raise EvalError(
            f"trajectory_trial: exit code {done.returncode}: {done.stderr.strip()[-200:]}"
        )
    try:
        return [json.loads(line) for line in done.stdout.splitlines()]
    except ValueError as error:
        raise EvalError(f"trajectory_trial: a line is not JSON: {error}") from error
