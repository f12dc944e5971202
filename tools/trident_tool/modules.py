# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Python modules of the workspace as subcommands."""

from __future__ import annotations

from collections.abc import Sequence

from trident_tool.building import build
from trident_tool.environment import ros_environment
from trident_tool.workspace import Runner, Workspace


def run_module(workspace: Workspace, runner: Runner, module: str, words: Sequence[str]) -> int:
    """Builds what is missing and runs a module with these words; returns its exit code."""
    build(workspace, runner)
    env = None if runner.dry_run else ros_environment(workspace)
    return runner.run(["/usr/bin/python3", "-m", module, *words], env=env)
