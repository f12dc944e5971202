# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The program ``trident_slam/pose_graph``."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import program


@cache
def executable() -> str:
    """Path of the program.

    Raises:
        EvalError: it is not built.
    """
    return program("trident_slam", "pose_graph")


def optimize(file: Path, options: Sequence[str], prefix: Sequence[str] = ()) -> dict[str, Any]:
    """Optimises a g2o file; ``prefix`` stands before the command. Returns what the program prints.

    Its warnings go to stderr.

    Raises:
        EvalError: it refuses the file or an option; the message is its own.
    """
    command = [*prefix, executable(), str(file), *options]
    # It may quote a file that is no text.
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines()
        raise EvalError(lines[-1] if lines else f"{command[0]} ended with {done.returncode}")
    print(done.stderr, end="", file=sys.stderr)
    result: dict[str, Any] = json.loads(done.stdout)
    return result
