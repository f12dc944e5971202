# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Where things are in a clone of the repository; how commands are run and errors reported."""

from __future__ import annotations

import os
import shlex
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from trident_tool.processes import run_supervised


class TridentError(Exception):
    """A failure that the user can act on; its text is the whole message."""


@dataclass(frozen=True)
class Workspace:
    """Paths of one clone. Nothing outside ``root`` is written, except the clang-tidy cache."""

    root: Path

    @property
    def build(self) -> Path:
        """The build folder; also where caches and logs of the tools go."""
        return self.root / "build"

    @property
    def devel(self) -> Path:
        """Catkin's devel space."""
        return self.build / "devel"

    @property
    def venv(self) -> Path:
        """The Python environment with the pinned packages."""
        return self.root / ".venv"

    @property
    def venv_python(self) -> Path:
        """Python of the environment."""
        return self.venv / "bin" / "python"

    @property
    def clients_venv(self) -> Path:
        """The Python environment with programs of others that the bridges are tested with."""
        return self.root / ".venv-clients"

    @property
    def out(self) -> Path:
        """Where runs leave their results."""
        return self.root / "out"

    @property
    def launch(self) -> Path:
        """The workspace's own launch files."""
        return self.root / "launch"

    @staticmethod
    def of_this_file() -> Workspace:
        """The clone that this file belongs to."""
        return Workspace(Path(__file__).resolve().parents[2])


def hide_from_crawlers(directory: Path) -> None:
    """Keeps catkin and rospack from searching ``directory`` (created if needed) for packages."""
    directory.mkdir(parents=True, exist_ok=True)
    for marker in ("CATKIN_IGNORE", "rospack_nosubdirs"):
        (directory / marker).touch()


def say(text: str) -> None:
    """One line of progress, on stderr, so that stdout stays the command's own."""
    print(f"trident: {text}", file=sys.stderr, flush=True)


@dataclass(frozen=True)
class Runner:
    """Runs commands, or in a dry run prints them instead."""

    dry_run: bool = False

    def run(
        self,
        command: Sequence[str | Path],
        *,
        cwd: Path | None = None,
        env: Mapping[str, str] | None = None,
        stdout: IO[str] | None = None,
        at_terminal: bool = False,
    ) -> int:
        """Runs ``command`` in the foreground and returns its exit code (0 in a dry run).

        Whatever ends this process ends the command, and all that it has started. What reads from
        the terminal itself, as sudo and shells do, is ``at_terminal``.
        """
        words = [str(word) for word in command]
        if self.dry_run:
            print(f"would run: {shlex.join(words)}", flush=True)
            return 0
        return run_supervised(words, env, at_terminal=at_terminal, cwd=cwd, stdout=stdout)

    def check(
        self,
        command: Sequence[str | Path],
        *,
        what: str,
        cwd: Path | None = None,
        env: Mapping[str, str] | None = None,
        stdout: IO[str] | None = None,
        at_terminal: bool = False,
    ) -> None:
        """Runs ``command``.

        Raises:
            TridentError: it failed; names ``what`` was being done and the command.
        """
        code = self.run(command, cwd=cwd, env=env, stdout=stdout, at_terminal=at_terminal)
        if code != 0:
            line = shlex.join([str(word) for word in command])
            raise TridentError(f"{what} failed (exit code {code}): {line}")


def base_environment() -> dict[str, str]:
    """The caller's environment with /usr/bin first on PATH and without another Python's settings.

    Debian's ROS is built for /usr/bin/python3: another python3 earlier on PATH breaks catkin and
    pluginlib.
    """
    env = dict(os.environ)
    path = [entry for entry in env.get("PATH", "").split(os.pathsep) if entry]
    first = ["/usr/bin", "/bin"]
    env["PATH"] = os.pathsep.join(first + [entry for entry in path if entry not in first])
    for name in ("PYTHONHOME", "VIRTUAL_ENV", "__PYVENV_LAUNCHER__"):
        env.pop(name, None)
    return env
