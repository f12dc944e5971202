# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Programs of others that tests of the bridges talk to: pynmea2, pymodbus, MAVProxy, MAVSDK."""

from __future__ import annotations

import os
import shutil
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
    raise _given_up(f"{module} is not installed: {_COMMAND}")


def client_program(name: str) -> Path:
    """A program of a Debian package, for a test that starts it.

    Without it the test is skipped with the command that installs it; where CI is true it fails.

    Args:
        name: of the executable, e.g. "gpsd".
    """
    # Daemons are in sbin, which not every user's path has.
    found = shutil.which(name) or shutil.which(name, path="/usr/sbin:/usr/local/sbin")
    if found:
        return Path(found)
    raise _given_up(f"{name} is not installed: ./trident setup")


def _given_up(reason: str) -> Exception:
    if os.environ.get("CI", "").lower() == "true":
        pytest.fail(reason)
    pytest.skip(f"SKIPPED: {reason}")
