# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a run came from: the files that `./trident run` keeps next to its results."""

from __future__ import annotations

import json
import shlex
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError


@dataclass(frozen=True)
class Provenance:
    """Facts about a run; each may be empty, e.g. of a run that a plain roslaunch has started.

    Attributes:
        launch: `launch.json`: command, launch file, arguments, commit, versions, machine.
        run: `run.json`: what the simulator writes at its end: seed, steps, state hash.
        parameters: all of the parameter server, nested.
        files: SHA-256 of every file that went in, by its path.
    """

    launch: dict[str, Any] = field(default_factory=dict)
    run: dict[str, Any] = field(default_factory=dict)
    parameters: dict[str, Any] = field(default_factory=dict)
    files: dict[str, str] = field(default_factory=dict)

    def repeat_commands(self) -> list[str]:
        """Lines for a shell that repeat the run; empty where it is not known how."""
        launch = self.launch
        if not launch.get("command"):
            return []
        lines = [f"cd {shlex.quote(launch['workspace'])}"] if launch.get("workspace") else []
        if launch.get("commit"):
            lines.append(f"git checkout {launch['commit']}")
        if launch.get("is_changed"):
            lines.append("git apply changes.patch  # of the folder of this run")
        folder = launch.get("working_directory")
        if folder and folder != launch.get("workspace"):
            lines.append(f"cd {shlex.quote(folder)}")
        return [*lines, shlex.join(map(str, launch["command"]))]

    def flat_parameters(self) -> list[tuple[str, str]]:
        """Full name and value of every parameter, in the order of their names."""
        return sorted(_flat(self.parameters, ""))


def read_provenance(folder: Path) -> Provenance:
    """Read what is there of launch.json, params.json and run.json.

    Raises:
        EvalError: one of them is not a JSON object.
    """
    launch = read_object(folder / "launch.json")
    parameters = read_object(folder / "params.json")
    files = {**launch.get("inputs", {}), **parameters.get("files", {})}
    return Provenance(
        launch, read_object(folder / "run.json"), parameters.get("parameters", {}), files
    )


def read_object(path: Path) -> dict[str, Any]:
    """A JSON object; empty if the file does not exist.

    Raises:
        EvalError: the file is unreadable, or holds something else.
    """
    if not path.exists():
        return {}
    try:
        value = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise EvalError(f"{path}: {error}; legal: what a run writes") from error
    if not isinstance(value, dict):
        raise EvalError(f"{path}: not an object; legal: what a run writes")
    return value


def _flat(value: Any, name: str) -> list[tuple[str, str]]:
    if isinstance(value, dict) and value:
        return [pair for key, item in value.items() for pair in _flat(item, f"{name}/{key}")]
    return [(name or "/", value if isinstance(value, str) else json.dumps(value))]
