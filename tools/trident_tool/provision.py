# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Installs what is missing: Debian packages and the pinned Python environment."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

from trident_tool.workspace import Runner, TridentError, Workspace, hide_from_crawlers, say

_STAMP = ".trident-stamp"
_LINK = "trident.pth"


def parse_package_list(text: str, source: str = "apt-packages.txt") -> list[str]:
    """Package names of a list with one name per line, ``#`` comments and blank lines.

    Raises:
        TridentError: a line holds more than one word, or a name twice; names file and line.
    """
    names: list[str] = []
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.split("#", 1)[0].split()
        if not words:
            continue
        if len(words) > 1:
            raise TridentError(
                f"{source}:{number}: one package name per line, found {line.strip()!r}"
            )
        if words[0] in names:
            raise TridentError(f"{source}:{number}: {words[0]!r} is listed twice")
        names.append(words[0])
    return names


def parse_dpkg_status(text: str) -> set[str]:
    """Names of the installed packages in the output of ``dpkg-query -W`` (name, tab, status)."""
    rows = (line.split("\t") for line in text.splitlines())
    return {row[0] for row in rows if len(row) == 2 and row[1].startswith("ii")}


def installed_packages() -> set[str]:
    """Debian packages that are installed now.

    Raises:
        TridentError: this is not a Debian system.
    """
    if shutil.which("dpkg-query") is None:
        raise TridentError("dpkg-query not found: Trident runs on Debian 12, which packages ROS 1")
    output = subprocess.run(
        ["dpkg-query", "-W", "-f", "${Package}\\t${db:Status-Abbrev}\\n"],
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    return parse_dpkg_status(output)


def missing_packages(wanted: Iterable[str], installed: set[str]) -> list[str]:
    """Those of ``wanted`` that are not in ``installed``, in the order of ``wanted``."""
    return [name for name in wanted if name not in installed]


def apt_get(arguments: list[str]) -> list[str]:
    """An apt-get call that asks nothing, with sudo unless this is root.

    Raises:
        TridentError: neither root nor sudo; says what root has to run.
    """
    # env, because sudo drops the caller's variables.
    command = [
        "env",
        "DEBIAN_FRONTEND=noninteractive",
        "apt-get",
        "-o",
        "Dpkg::Use-Pty=0",
        *arguments,
    ]
    if os.geteuid() == 0:
        return command
    if shutil.which("sudo") is None:
        line = " ".join(["apt-get", *arguments])
        raise TridentError(f"neither root nor sudo here; as root, run once: {line}")
    return ["sudo", *command]


def install_apt(workspace: Workspace, runner: Runner) -> None:
    """Installs the packages of tools/apt-packages.txt that are missing."""
    listing = workspace.root / "tools" / "apt-packages.txt"
    wanted = parse_package_list(listing.read_text(encoding="utf-8"), str(listing))
    missing = missing_packages(wanted, installed_packages())
    if not missing:
        return
    say(f"installing {len(missing)} Debian packages: {' '.join(missing)}")
    install = apt_get(["install", "-y", "--no-install-recommends", *missing])
    # sudo asks for a password at the terminal.
    runner.check(apt_get(["update"]), what="reading the package lists", at_terminal=True)
    runner.check(install, what="installing the Debian packages", at_terminal=True)


def venv_key(workspace: Workspace, requirements: str, interpreter: str) -> str:
    """What the Python environment is made from: equal keys mean nothing has to be done.

    The path is part of it because the scripts in a venv hold absolute paths.
    """
    parts = (str(workspace.venv), interpreter, requirements)
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()


def install_venv(workspace: Workspace, runner: Runner) -> None:
    """Makes .venv with the pinned packages of tools/requirements.txt, on top of Debian's own."""
    requirements = workspace.root / "tools" / "requirements.txt"
    interpreter = f"{sys.version_info.major}.{sys.version_info.minor}.{sys.version_info.micro}"
    key = venv_key(workspace, requirements.read_text(encoding="utf-8"), interpreter)
    stamp = workspace.venv / _STAMP
    if stamp.is_file() and stamp.read_text(encoding="utf-8") == key:
        return
    say("preparing the Python environment in .venv")
    runner.check(
        ["/usr/bin/python3", "-m", "venv", "--system-site-packages", workspace.venv],
        what="creating .venv",
    )
    pip: list[str | Path] = [
        workspace.venv_python,
        "-m",
        "pip",
        "--disable-pip-version-check",
        "install",
    ]
    runner.check([*pip, "-r", requirements], what="installing the Python packages")
    if not runner.dry_run:
        hide_from_crawlers(workspace.venv)
        stamp.write_text(key, encoding="utf-8")


def link_workspace(workspace: Workspace) -> None:
    """Has the Python of .venv find the workspace's packages without a sourced shell.

    What is on PYTHONPATH, such as an overlay, comes first. Typed packages are found where their
    sources are: type checkers cannot look through the modules that catkin puts in the devel space.
    """
    typed = sorted({path.parents[1] for path in workspace.root.glob("src/*/src/*/py.typed")})
    folders = [*typed, workspace.devel / "lib" / "python3" / "dist-packages"]
    text = "".join(f"{folder}\n" for folder in folders)
    for site in workspace.venv.glob("lib/python3.*/site-packages"):
        link = site / _LINK
        if not link.is_file() or link.read_text(encoding="utf-8") != text:
            link.write_text(text, encoding="utf-8")


def provision(workspace: Workspace, runner: Runner) -> None:
    """Brings the machine and the clone to the state that building needs."""
    install_apt(workspace, runner)
    install_venv(workspace, runner)
    if not runner.dry_run:
        link_workspace(workspace)
        hide_from_crawlers(workspace.build)
        hide_from_crawlers(workspace.out)


def pinned_requirements(path: Path) -> list[str]:
    """Lines of a requirements file that pin a package, comments removed."""
    lines = (
        line.split("#", 1)[0].strip() for line in path.read_text(encoding="utf-8").splitlines()
    )
    return [line for line in lines if line]
