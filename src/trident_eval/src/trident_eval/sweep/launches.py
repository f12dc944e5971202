# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A launch file as a run: `./trident run` in the run's folder, and numbers of its verdict.json."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError

LAUNCH = "launch "  # before the words of a job's subject
_SEED = "seed"


def run_launch(words: Sequence[str]) -> Callable[[Mapping[str, Any], int, Path], dict[str, float]]:
    """The function of a launch file: parameters are its arguments, the seed is `seed:=`.

    Args:
        words: behind `./trident run`.
    """

    def run(parameters: Mapping[str, Any], seed: int, folder: Path) -> dict[str, float]:
        arguments = [f"{name}:={_text(value)}" for name, value in parameters.items()]
        program = os.environ.get("TRIDENT_PROGRAM", "")
        if not program:
            raise EvalError("a launch file is run by ./trident sweep; TRIDENT_PROGRAM is not set")
        command = [program, "run", *words, *arguments, f"{_SEED}:={seed}"]
        env = {**os.environ, "TRIDENT_RUNS": str(folder)}
        code = subprocess.run(command, env=env, check=False).returncode
        return _numbers(_verdict(folder, code))

    return run


def _text(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _verdict(folder: Path, code: int) -> Any:
    found = sorted(folder.glob("*/verdict.json"))
    if not found:
        raise EvalError(f"no verdict: ./trident run has ended with {code}; see output.txt")
    return json.loads(found[-1].read_text(encoding="utf-8"))


def _numbers(value: Any, name: str = "") -> dict[str, float]:
    """All numbers of nested objects, by their paths with dots; true is 1."""
    if isinstance(value, bool | int | float):
        return {name: float(value)}
    if not isinstance(value, dict):
        return {}
    found: dict[str, float] = {}
    for key, inner in value.items():
        found |= _numbers(inner, f"{name}.{key}" if name else str(key))
    return found
