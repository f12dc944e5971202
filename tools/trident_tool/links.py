# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The ``links`` subcommand: what the radios of a running simulation carry."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Sequence

from trident_tool.building import build
from trident_tool.environment import ros_environment
from trident_tool.formation import Handler
from trident_tool.modules import module_command
from trident_tool.shell import master_answers, running_master
from trident_tool.workspace import Runner, TridentError, Workspace

_MODULE = "trident_viewer.links"


def add_links_command(add: Callable[[str, Handler, str], argparse.ArgumentParser]) -> None:
    """Adds ``links`` to the command line."""
    add(
        "links",
        _cmd_links,
        "the radios of a running simulation: links, topics and services, and who reads past them",
    )


def _cmd_links(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    del options
    if runner.dry_run:
        return runner.run(["/usr/bin/python3", "-m", _MODULE])
    return run_at_master(workspace, runner, _MODULE, [])


def run_at_master(workspace: Workspace, runner: Runner, module: str, words: Sequence[str]) -> int:
    """Builds what is missing and runs a module next to a running system; its exit code.

    Raises:
        TridentError: no roscore is reachable.
    """
    uri = _reachable_master(workspace)
    build(workspace, runner)
    env = ros_environment(workspace) | {"ROS_MASTER_URI": uri}
    env.setdefault("ROS_HOSTNAME", "localhost")
    return runner.run(module_command(module, *words), env=env)


def _reachable_master(workspace: Workspace) -> str:
    """ROS_MASTER_URI of the newest run if it is still in progress, else that of the environment.

    Raises:
        TridentError: neither has a roscore.
    """
    uri = running_master(workspace)
    if uri is not None:
        return uri
    uri = os.environ.get("ROS_MASTER_URI") or "http://localhost:11311"
    if not master_answers(uri):
        raise TridentError(
            f"no roscore is reachable: there is no ./trident run in progress, nor one at {uri}"
        )
    return uri
