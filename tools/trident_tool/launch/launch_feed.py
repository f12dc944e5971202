# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a launch file starts, as far as a viewer has to know."""

from __future__ import annotations

import subprocess
import time
import xmlrpc.client
from collections.abc import Mapping, Sequence

from trident_tool.workspace import TridentError

DESCRIPTION = "/robot_description"
STATE_PUBLISHER = ["rosrun", "robot_state_publisher", "robot_state_publisher"]
_PARAM_LIMIT_S = 300.0  # it is not waited for when roslaunch has ended
_POLL_S = 0.1


def nodes_of(launch: Sequence[str], env: Mapping[str, str]) -> list[str]:
    """Names of the nodes that a call of roslaunch starts.

    Raises:
        TridentError: roslaunch does not take it; says why.
    """
    return [line for line in _asked("--nodes", launch, env) if line.startswith("/")]


def lacks_state_publisher(
    launch: Sequence[str], nodes: Sequence[str], env: Mapping[str, str]
) -> bool:
    """Whether it describes a robot whose links nobody places, as the TurtleBot3's worlds do.

    Raises:
        TridentError: roslaunch does not take it; says why.
    """
    if any(name.endswith("robot_state_publisher") for name in nodes):
        return False
    params = _asked("--dump-params", launch, env)
    return any(line.startswith(f"{DESCRIPTION}:") for line in params)


def wait_for_param(uri: str, name: str, launch: subprocess.Popen[bytes]) -> bool:
    """Whether a parameter comes before roslaunch ends, or it takes too long."""
    master = xmlrpc.client.ServerProxy(uri)
    deadline = time.monotonic() + _PARAM_LIMIT_S
    while launch.poll() is None and time.monotonic() < deadline:
        answer: list[int | str] = list(master.hasParam("/trident_view", name))  # type: ignore[arg-type]
        if answer[2]:
            return True
        time.sleep(_POLL_S)
    return False


def _asked(question: str, launch: Sequence[str], env: Mapping[str, str]) -> list[str]:
    command = ["roslaunch", question, *(word for word in launch[1:] if word != "--disable-title")]
    done = subprocess.run(command, env=dict(env), capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise TridentError(f"{' '.join(command)}: {done.stderr.strip()}")
    return done.stdout.splitlines()
