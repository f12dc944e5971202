# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The program fusion_benchmark, which prints a line of JSON for each run of a filter."""

from __future__ import annotations

import json
import subprocess
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import program

_LIMIT_S = 7200.0  # wall time


def runs(suite: str, seeds: int) -> list[dict[str, Any]]:
    """The lines that fusion_benchmark prints about the first seeds.

    Raises:
        EvalError: it is not built, failed, or printed something else; with what it said.
    """
    command = [program("trident_estimation", "fusion_benchmark"), suite, "0", str(seeds)]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, check=False, timeout=_LIMIT_S
        )
    except subprocess.TimeoutExpired as error:
        raise EvalError(f"fusion_benchmark: not ended after {_LIMIT_S:g} s") from error
    if done.returncode != 0:
        raise EvalError(
            f"fusion_benchmark: exit code {done.returncode}: {done.stderr.strip()[-200:]}"
        )
    try:
        return [json.loads(line) for line in done.stdout.splitlines()]
    except ValueError as error:
        raise EvalError(f"fusion_benchmark: a line is not JSON: {error}") from error
