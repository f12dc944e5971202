# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Packages that only learners need."""

from __future__ import annotations

import importlib
import sys

_PINS = {"gymnasium": "gymnasium==1.4.0", "pettingzoo": "pettingzoo==1.27.0"}


def require(package: str) -> None:
    """See to it that an optional package is there.

    Raises:
        ImportError: it is not; the text is the line that installs it.
    """
    try:
        importlib.import_module(package)
    except ImportError as error:
        raise ImportError(
            f"trident_sim.envs needs {package}: {sys.executable} -m pip install {_PINS[package]}"
        ) from error
