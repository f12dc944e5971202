# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Formation files of a launch file are checked before anything is started."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

from trident_tool.workspace import TridentError, say

_MODULE = "trident_fleet.cli.check_launch"
# What a launch file with a formation node has in it, or in a file of ours that it includes.
_MAY_FLY = re.compile(rb"formation|trident|uav\.launch")


def check_formations(launch_file: Path, words: Sequence[str], env: Mapping[str, str]) -> None:
    """Reads the formations that a launch file flies, and says what is worth knowing about them.

    Args:
        launch_file: the file.
        words: its arguments, ``name:=value``.
        env: environment with the workspace sourced.

    Raises:
        TridentError: a formation cannot be flown; says why.
    """
    if not _MAY_FLY.search(launch_file.read_bytes()):
        return
    done = subprocess.run(
        ["/usr/bin/python3", "-m", _MODULE, str(launch_file), *words],
        env=dict(env),
        capture_output=True,
        text=True,
        check=False,
    )
    for line in done.stdout.splitlines():
        say(line)
    if done.returncode != 0:
        raise TridentError(done.stderr.strip() or f"{_MODULE}: exit code {done.returncode}")
