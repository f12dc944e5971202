# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters of nodes as launch files set them, without starting anything."""

from __future__ import annotations

import os
import re
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml
from trident_eval.core.errors import EvalError

_LIMIT_S = 60.0
_CAUSE = re.compile("Unable|Exception")


def launch_parameters(
    words: Sequence[str], environment: Mapping[str, str] | None = None
) -> dict[str, Any]:
    """What a launch file sets, by node and then by name.

    Args:
        words: as roslaunch has them: a file, or package and file; then arguments.
        environment: variables in addition to those of this process.

    Raises:
        EvalError: it cannot be read.
    """
    done = subprocess.run(
        ["roslaunch", "--dump-params", *words],
        capture_output=True,
        text=True,
        check=False,
        timeout=_LIMIT_S,
        env=os.environ | dict(environment or {}),
    )
    # It also ends with 0 where a file cannot be read: then parameters are no map.
    parameters = _parsed(done.stdout) if done.returncode == 0 else None
    if not isinstance(parameters, dict):
        raise EvalError(f"roslaunch {' '.join(words)}: {_cause(done)}")
    return nested(parameters)


def _cause(done: subprocess.CompletedProcess[str]) -> str:
    """Why there are no parameters."""
    lines = [line for line in done.stderr.splitlines() + done.stdout.splitlines() if line]
    return next((line for line in lines if _CAUSE.search(line)), "no parameters")


def _parsed(text: str) -> object:
    try:
        return yaml.safe_load(text)
    except yaml.YAMLError:
        return None


def nested(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Parameters by their full names as maps of maps."""
    tree: dict[str, Any] = {}
    for name, value in parameters.items():
        *spaces, key = name.strip("/").split("/")
        here = tree
        for space in spaces:
            here = here.setdefault(space, {})
        here[key] = value
    return tree


def node_parameters(tree: Mapping[str, Any], node: str, file: Path) -> Path:
    """The parameters of one node as a file.

    Args:
        tree: of a launch file.
        node: its name.
        file: is written.

    Returns:
        The file.

    Raises:
        EvalError: it has no parameters.
    """
    if not isinstance(tree.get(node), dict):
        raise EvalError(f"the launch file sets no parameters of {node}")
    file.write_text(yaml.safe_dump(tree[node]), encoding="utf-8")
    return file
