# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Programs of others that tests of the bridges talk to: pynmea2, pymodbus, MAVProxy, MAVSDK."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

_COMMAND = "./trident setup --clients"


def clients_python(module: str) -> Path:
    """Python of .venv-clients, for a test that starts a program of it.

    Without it the test is skipped with the command that installs it; where CI is true it fails.

    Args:
        module: what the program imports, e.g. "pynmea2".
    """
    for folder in Path(__file__).resolve().parents:
        venv = folder / ".venv-clients"
        if any(venv.glob(f"lib/python3.*/site-packages/{module}")):
            return venv / "bin" / "python"
    reason = f"{module} is not installed: {_COMMAND}"
    if os.environ.get("CI", "").lower() == "true":
        pytest.fail(reason)
    pytest.skip(f"SKIPPED: {reason}")
