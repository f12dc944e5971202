# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The programs of this package, for its Python modules."""

from __future__ import annotations

import os
from pathlib import Path

from trident_nav.core.errors import NavError


def find_program(name: str) -> Path:
    """A program of this package in the sourced workspace.

    Raises:
        NavError: no sourced workspace has it.
    """
    prefixes = os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)
    for prefix in prefixes:
        program = Path(prefix) / "lib" / "trident_nav" / name
        if prefix and program.is_file():
            return program
    raise NavError(f"{name} is not built, or its workspace is not sourced: ./trident build {name}")
