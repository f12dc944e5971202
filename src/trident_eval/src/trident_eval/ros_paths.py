# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Where packages and programs of the sourced workspace are."""

from __future__ import annotations

import subprocess
from functools import cache
from pathlib import Path

from trident_eval.core.errors import EvalError


@cache
def package_folder(package: str) -> Path:
    """Folder of a ROS package.

    Raises:
        EvalError: it does not exist; the workspace is not sourced.
    """
    found = subprocess.run(
        ["rospack", "find", package], capture_output=True, text=True, check=False
    )
    if found.returncode != 0:
        raise EvalError(f"package {package} is not found; legal: a shell that has sourced a build")
    return Path(found.stdout.strip())


@cache
def program(package: str, name: str) -> str:
    """Path of a built program of a package.

    Raises:
        EvalError: it is not built.
    """
    command = ["catkin_find", "--first-only", "--libexec", package, name]
    found = subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()
    if not found:
        raise EvalError(f"{package}/{name} is not built; run ./trident build")
    return found
