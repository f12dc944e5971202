# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The environment of a built workspace, as sourcing build/devel/setup.bash gives it."""

from __future__ import annotations

import os
import subprocess

from trident_tool.workspace import TridentError, Workspace, base_environment


def parse_environment(block: bytes) -> dict[str, str]:
    """Variables of the output of ``env -0``."""
    entries = (
        entry.partition("=") for entry in block.decode("utf-8", "surrogateescape").split("\0")
    )
    return {name: value for name, equals, value in entries if equals}


def is_sourced(env: dict[str, str], workspace: Workspace) -> bool:
    """Whether ``env`` already holds this workspace, possibly below an overlay of the user's."""
    return str(workspace.devel) in env.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)


def ros_environment(workspace: Workspace) -> dict[str, str]:
    """The caller's environment plus the workspace's devel space and its environment hooks.

    A workspace that was overlaid on this one and sourced by the caller stays in effect.

    Raises:
        TridentError: the workspace is not built.
    """
    env = base_environment()
    if is_sourced(env, workspace):
        return env
    setup = workspace.devel / "setup.sh"
    if not setup.is_file():
        raise TridentError(f"{setup} does not exist: run ./trident build")
    result = subprocess.run(
        ["/bin/sh", "-c", '. "$0" && exec env -0', str(setup)],
        env=env,
        capture_output=True,
        check=False,
    )
    if result.returncode != 0:
        raise TridentError(
            f"sourcing {setup} failed: {result.stderr.decode(errors='replace').strip()}"
        )
    return parse_environment(result.stdout)
