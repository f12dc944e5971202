# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The ``shell`` subcommand: a shell in which the workspace is sourced."""

from __future__ import annotations

import json
import os
import socket
import subprocess
import time
import xmlrpc.client
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from trident_tool.environment import ros_environment
from trident_tool.launch.launch_facts import LAUNCH_FILE
from trident_tool.workspace import Runner, TridentError, Workspace, say

_MASTER_LIMIT_S = 300.0  # the end of roscore is noticed at once

# An interactive bash reads the user's own settings first: they must not undo the order of PATH.
_RC = """\
[ -f ~/.bashrc ] && . ~/.bashrc
. '{devel}/setup.bash'
export PATH=/usr/bin:/bin:"$PATH"
PS1="(trident) $PS1"
"""


def master_answers(uri: str) -> bool:
    """Whether something listens at ``uri``."""
    parts = urlsplit(uri)
    try:
        with socket.create_connection((parts.hostname or "localhost", parts.port or 11311), 1.0):
            return True
    except OSError:
        return False


def wait_for_master(uri: str, process: subprocess.Popen[bytes]) -> None:
    """Return when a master answers.

    Raises:
        TridentError: its process has ended, or it takes too long.
    """
    deadline = time.monotonic() + _MASTER_LIMIT_S
    while not master_answers(uri):
        if process.poll() is not None or time.monotonic() > deadline:
            raise TridentError("roscore did not start")
        time.sleep(0.1)


def running_master(workspace: Workspace) -> str | None:
    """ROS_MASTER_URI of the newest run if that run is still going."""
    facts = workspace.out / "latest" / LAUNCH_FILE
    try:
        uri = str(json.loads(facts.read_text(encoding="utf-8"))["ros_master_uri"])
    except (OSError, ValueError, KeyError):
        return None
    return uri if master_answers(uri) else None


def simulator_master() -> str | None:
    """ROS_MASTER_URI of the environment if a simulator is registered with that master."""
    uri = os.environ.get("ROS_MASTER_URI") or "http://localhost:11311"
    if not master_answers(uri):
        return None
    master: Any = xmlrpc.client.ServerProxy(uri)
    try:
        code, _, _ = master.lookupService("/trident", "/gazebo/get_world_properties")
    except (OSError, xmlrpc.client.Error):
        return None
    return uri if code == 1 else None


def shell(workspace: Workspace, runner: Runner, command: str | None = None) -> int:
    """Runs ``command``, or an interactive shell without one; returns its exit code."""
    if runner.dry_run:
        return runner.run(["bash", *(["-c", command] if command else ["-i"])])
    env = ros_environment(workspace)
    uri = running_master(workspace)
    if uri is not None:
        env["ROS_MASTER_URI"] = uri
        env.setdefault("ROS_HOSTNAME", "localhost")
        say(f"ROS_MASTER_URI is that of the run in progress, {uri}")
    if command is not None:
        return runner.run(["bash", "-c", command], env=env, at_terminal=True)
    rc: Path = workspace.build / "shell.rc"
    keep = f"export ROS_MASTER_URI='{uri}'\n" if uri else ""
    rc.write_text(_RC.format(devel=workspace.devel) + keep, encoding="utf-8")
    return runner.run(["bash", "--rcfile", rc, "-i"], env=env, at_terminal=True)
