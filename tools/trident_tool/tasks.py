# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The ``task`` subcommand: what a running team shall do, and how far it is."""

from __future__ import annotations

import argparse
from collections.abc import Callable

from trident_tool.formation import Handler
from trident_tool.links import run_at_master
from trident_tool.workspace import Runner, Workspace

_MODULE = "trident_fleet.cli.tasks"


def add_task_command(add: Callable[[str, Handler, str], argparse.ArgumentParser]) -> None:
    """Adds ``task`` to the command line."""
    sub = add("task", _cmd_task, "ask a running team for a task, cancel one, or list them")
    sub.add_argument(
        "words",
        nargs="+",
        metavar="add|cancel|list …",
        help="add ID X Y Z [--kind, --requirements, --duration, --deadline, --value, --after, "
        "--robots, --repeatable]; cancel ID; list",
    )
    sub.set_defaults(passes_on=True)


def _cmd_task(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    words = [word for word in options.argv if word != "--dry-run"][1:]
    if runner.dry_run:
        return runner.run(["/usr/bin/python3", "-m", _MODULE, *words])
    return run_at_master(workspace, runner, _MODULE, words)
