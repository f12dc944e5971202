# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a run was started with, kept next to its results: enough to repeat it, and to explain it."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import platform
import subprocess
import xml.etree.ElementTree as ElementTree
import xmlrpc.client
from collections.abc import Iterable, Iterator, Mapping, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any

from trident_tool.provision import parse_package_list, pinned_requirements
from trident_tool.workspace import Workspace

LAUNCH_FILE = "launch.json"
PARAMETERS_FILE = "params.json"
CHANGES_FILE = "changes.patch"
_CALLER = "/trident_run"
# Robot descriptions are as long as books, and follow from the commit and the arguments.
_LONGEST_VALUE = 4000


def _git(workspace: Workspace, *words: str) -> bytes:
    """Output of a git command; empty without git or outside of a clone."""
    with contextlib.suppress(OSError):
        result = subprocess.run(
            ["git", "-C", str(workspace.root), *words], capture_output=True, check=False
        )
        return result.stdout if result.returncode == 0 else b""
    return b""


def version(workspace: Workspace) -> str:
    """Version of the project, as its packages declare it; empty when they do not."""
    manifest = workspace.root / "src" / "trident_bringup" / "package.xml"
    with contextlib.suppress(OSError, ElementTree.ParseError):
        return (ElementTree.parse(manifest).getroot().findtext("version") or "").strip()
    return ""


def library_versions(workspace: Workspace) -> dict[str, str]:
    """Versions of Debian's packages and Python's that the project asks for, as installed."""
    versions = {"python": platform.python_version()}
    tools = workspace.root / "tools"
    with contextlib.suppress(OSError):
        wanted = parse_package_list((tools / "apt-packages.txt").read_text(encoding="utf-8"))
        output = subprocess.run(
            ["dpkg-query", "-W", "-f", "${Package}\\t${Version}\\n", *wanted],
            capture_output=True,
            text=True,
            check=False,  # it warns about those that are not there
        ).stdout
        versions |= dict(line.split("\t", 1) for line in output.splitlines() if "\t" in line)
    with contextlib.suppress(OSError):
        pins = pinned_requirements(tools / "requirements.txt")
        versions |= dict(pin.split("==", 1) for pin in pins if "==" in pin)
    return versions


def machine() -> dict[str, str]:
    """The machine, in words."""
    facts = {"kernel": platform.release(), "cores": str(len(os.sched_getaffinity(0)))}
    with contextlib.suppress(OSError):
        facts["debian"] = Path("/etc/debian_version").read_text(encoding="utf-8").strip()
    with contextlib.suppress(OSError):
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                facts["cpu"] = line.partition(":")[2].strip()
                break
    return facts


def input_files(paths: Iterable[str]) -> dict[str, str]:
    """SHA-256 of those of ``paths`` that are files."""
    found = {}
    for path in paths:
        with contextlib.suppress(OSError, ValueError):
            if Path(path).is_file():
                found[path] = hashlib.sha256(Path(path).read_bytes()).hexdigest()
    return found


def command_line(workspace: Workspace, words: Sequence[str]) -> list[str]:
    """The call of ./trident that has led here, from the working directory."""
    trident = os.path.relpath(workspace.root / "trident")
    return [trident if os.sep in trident else f"./{trident}", "run", *words]


def save_launch(
    workspace: Workspace,
    folder: Path,
    *,
    words: Sequence[str],
    launch_file: Path,
    args: Mapping[str, str],
    env: Mapping[str, str],
) -> None:
    """Writes launch.json, and what is not committed as a patch, into the folder of a run.

    Args:
        workspace: the clone.
        folder: of the run.
        words: of the command line, behind ``run``.
        launch_file: that was found for them.
        args: handed to roslaunch.
        env: that roslaunch gets.
    """
    commit = _git(workspace, "rev-parse", "HEAD").decode().strip()
    changes = _git(workspace, "diff", "HEAD", "--binary")
    untracked = _git(workspace, "ls-files", "--others", "--exclude-standard").decode().split("\n")
    facts: dict[str, Any] = {
        "command": command_line(workspace, words),
        "workspace": str(workspace.root),
        "working_directory": os.getcwd(),
        "launch_file": str(launch_file),
        "args": dict(args),
        "real_time_factor": env["TRIDENT_REAL_TIME_FACTOR"],
        "ros_master_uri": env["ROS_MASTER_URI"],
        "started": datetime.now().astimezone().isoformat(timespec="seconds"),
        "version": version(workspace),
        "commit": commit,
        "is_changed": bool(changes),
        "untracked": [path for path in untracked if path],
        "ros_package_path": env.get("ROS_PACKAGE_PATH", ""),
        "inputs": input_files([str(launch_file), *args.values()]),
        "machine": machine(),
        "versions": library_versions(workspace),
    }
    if changes:
        (folder / CHANGES_FILE).write_bytes(changes)
    text = json.dumps(facts, indent=2)
    (folder / LAUNCH_FILE).write_text(text + "\n", encoding="utf-8")


def save_parameters(master_uri: str, folder: Path) -> bool:
    """Writes what is on the parameter server now as params.json, with the files that it names.

    Long texts are replaced by their length and SHA-256.

    Returns:
        Whether the master has answered.
    """
    try:
        proxy: Any = xmlrpc.client.ServerProxy(master_uri)
        code, _, parameters = proxy.getParam(_CALLER, "/")
    except (OSError, xmlrpc.client.Error):
        return False
    if code != 1:
        return False
    known = {
        "parameters": shortened(parameters),
        "files": input_files(text for text in texts(parameters) if os.sep in text),
    }
    text = json.dumps(known, indent=2, default=str)
    (folder / PARAMETERS_FILE).write_text(text + "\n", encoding="utf-8")
    return True


def texts(value: Any) -> Iterator[str]:
    """Every text in ``value``, of any depth, that could be a path."""
    if isinstance(value, dict):
        for item in value.values():
            yield from texts(item)
    elif isinstance(value, str) and len(value) <= _LONGEST_VALUE:
        yield value


def shortened(value: Any) -> Any:
    """``value`` of any depth, with long texts replaced by their length and digest."""
    if isinstance(value, dict):
        return {name: shortened(item) for name, item in value.items()}
    if isinstance(value, str) and len(value) > _LONGEST_VALUE:
        digest = hashlib.sha256(value.encode()).hexdigest()
        return f"({len(value)} characters, SHA-256 {digest})"
    return value
