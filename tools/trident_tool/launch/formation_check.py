# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Formation files of a launch file are checked before anything is started."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Mapping

from trident_tool.launch.launch_plan import LaunchPlan
from trident_tool.workspace import TridentError, say

_MODULE = "trident_fleet.cli.check_launch"
_PACKAGE = "trident_fleet"


def check_formations(plan: LaunchPlan, env: Mapping[str, str]) -> None:
    """Reads the formations that a launch file flies, and says what is worth knowing about them.

    Args:
        plan: what the launch file would start.
        env: environment with the workspace sourced.

    Raises:
        TridentError: a formation cannot be flown; says why.
    """
    nodes = _formation_nodes(plan)
    if not nodes:
        return
    done = subprocess.run(
        ["/usr/bin/python3", "-m", _MODULE],
        input=json.dumps(
            {"nodes": nodes, "params": dict(plan.params), "lowest_spawn_m": plan.lowest_spawn_m}
        ),
        env=dict(env),
        capture_output=True,
        text=True,
        check=False,
    )
    for line in done.stdout.splitlines():
        say(line)
    if done.returncode != 0:
        raise TridentError(done.stderr.strip() or f"{_MODULE}: exit code {done.returncode}")


def _formation_nodes(plan: LaunchPlan) -> list[dict[str, str]]:
    return [
        {"name": node.name, "package": node.package, "type": node.type}
        for node in plan.nodes
        if node.package == _PACKAGE
    ]
