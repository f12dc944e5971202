# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Python modules of the workspace as subcommands."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from trident_tool.building import build
from trident_tool.environment import ros_environment
from trident_tool.quiet_interrupt import BLOCKED_PYTHON
from trident_tool.workspace import Runner, Workspace

_LAUNCHER = Path(__file__).with_name("quiet_interrupt.py")


def run_module(workspace: Workspace, runner: Runner, module: str, words: Sequence[str]) -> int:
    """Builds what is missing and runs a module with these words; returns its exit code."""
    build(workspace, runner)
    if runner.dry_run:
        return runner.run(["/usr/bin/python3", "-m", module, *words])
    return runner.run(module_command(module, *words), env=ros_environment(workspace))


def module_command(module: str, *words: str) -> list[str]:
    """The call of a module of the workspace."""
    return [*BLOCKED_PYTHON, str(_LAUNCHER), module, *words]
