# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Programs of others that the bridges are tested with, in a Python environment of their own."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

from trident_tool.formation import Handler
from trident_tool.provision import venv_key
from trident_tool.workspace import Runner, TridentError, Workspace, hide_from_crawlers, say

_STAMP = ".trident-stamp"
COMMAND = "./trident setup --clients"


def install_clients(workspace: Workspace, runner: Runner) -> None:
    """Makes .venv-clients with the pinned packages of tools/requirements-clients.txt.

    Raises:
        TridentError: it cannot be made, e.g. without a network.
    """
    requirements = workspace.root / "tools" / "requirements-clients.txt"
    interpreter = ".".join(str(part) for part in sys.version_info[:3])
    key = venv_key(workspace, requirements.read_text(encoding="utf-8"), interpreter)
    stamp = workspace.clients_venv / _STAMP
    if stamp.is_file() and stamp.read_text(encoding="utf-8") == key:
        return
    say("preparing the clients of the bridges' tests in .venv-clients")
    venv: list[str | Path] = ["/usr/bin/python3", "-m", "venv", workspace.clients_venv]
    runner.check(venv, what="creating .venv-clients")
    python = workspace.clients_venv / "bin" / "python"
    pip: list[str | Path] = [
        python,
        "-m",
        "pip",
        "--disable-pip-version-check",
        "install",
        "--no-deps",
    ]
    runner.check([*pip, "-r", requirements], what="installing the clients")
    if not runner.dry_run:
        hide_from_crawlers(workspace.clients_venv)
        stamp.write_text(key, encoding="utf-8")


def provide_clients(
    workspace: Workspace, runner: Runner, env: Mapping[str, str] = os.environ
) -> None:
    """As install_clients(), but without them tests are skipped, unless CI is set to true.

    Raises:
        TridentError: it cannot be made, and CI is true.
    """
    try:
        install_clients(workspace, runner)
    except TridentError as error:
        if env.get("CI", "").lower() == "true":
            raise
        say(f"{error}; tests that need the clients are skipped. Later: {COMMAND}")


def _cmd_setup(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    # The rest has been done before any command.
    if options.clients:
        install_clients(workspace, runner)
    return 0


def add_setup_command(add: Callable[[str, Handler, str], argparse.ArgumentParser]) -> None:
    """Adds ``setup``."""
    sub = add("setup", _cmd_setup, "install the Debian and Python packages that are missing")
    sub.add_argument(
        "--clients",
        action="store_true",
        help="also the programs of others that the bridges are tested with, in .venv-clients",
    )
