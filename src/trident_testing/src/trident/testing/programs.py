# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Built programs, and processes that leave nothing behind."""

from __future__ import annotations

import os
import re
import shlex
import signal
import subprocess
import uuid
from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import cache
from pathlib import Path

from trident.testing.waiting import LIMIT_S, eventually

_PROBLEM = re.compile(r"\[ ?(WARN|ERROR|FATAL)\]|Traceback \(most recent call last\)")


@cache
def package(name: str) -> Path:
    """Source folder of a package.

    Raises:
        AssertionError: it is not on ROS_PACKAGE_PATH.
    """
    found = subprocess.run(["rospack", "find", name], capture_output=True, text=True, check=False)
    assert found.returncode == 0, f"there is no package {name}: {found.stderr.strip()}"
    return Path(found.stdout.strip())


def program(package_name: str, name: str) -> str:
    """Path of a built executable.

    Raises:
        AssertionError: it is not in the devel or install space of any sourced workspace.
    """
    for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep):
        path = Path(prefix) / "lib" / package_name / name
        if path.is_file():
            return str(path)
    raise AssertionError(f"{package_name}/{name} is not built, or the workspace is not sourced")


class Process:
    """A started program, in a session of its own, and its log.

    Attributes:
        command: program and arguments, as one line.
        log_file: stdout and stderr.
        popen: the process itself.
    """

    def __init__(self, command: Sequence[str], env: Mapping[str, str], log: Path) -> None:
        """Start it.

        Args:
            command: program and arguments.
            env: the whole environment.
            log: file that is made for its output.
        """
        self.command = shlex.join(command)
        self.log_file = log
        # Inherited by all that it starts. Process ids are reused, so that what is left over is not
        # to be found by a number remembered.
        self._mark = f"TRIDENT_TEST_PROCESS={uuid.uuid4()}"
        name, value = self._mark.split("=")
        with log.open("w", encoding="utf-8") as output:
            self.popen = subprocess.Popen(
                list(command),
                env={**env, name: value},
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
                text=True,
            )

    @property
    def log(self) -> str:
        """What it has written so far."""
        return self.log_file.read_text(encoding="utf-8", errors="replace")

    @property
    def running(self) -> bool:
        """Whether it has not ended."""
        return self.popen.poll() is None

    def send(self, number: int) -> None:
        """Send a signal to this process only, not to its children."""
        self.popen.send_signal(number)

    def wait(self, limit_s: float = LIMIT_S) -> int:
        """Wait until it has ended by itself; its exit code."""
        eventually(lambda: not self.running, f"the end of {self.command}", limit_s)
        return self.popen.returncode

    def stop(self, number: int = signal.SIGINT, limit_s: float = 20.0) -> int:
        """End it by a signal; what is left after `limit_s`, or of its children, is killed.

        Returns:
            Its exit code.
        """
        if self.running:
            self.send(number)
            with suppress(subprocess.TimeoutExpired):
                self.popen.wait(limit_s)
        for pid in self.family():
            with suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        return self.popen.wait()

    def family(self) -> list[int]:
        """Process ids of what runs of it and of all that it started."""
        mark = self._mark.encode()
        found = []
        for folder in Path("/proc").glob("[0-9]*"):
            with suppress(OSError):
                if mark in (folder / "environ").read_bytes():
                    found.append(int(folder.name))
        return found

    def eventually_logs(self, text: str, limit_s: float = LIMIT_S) -> None:
        """Return when `text` is in the log."""
        eventually(lambda: text in self.log, f"'{text}' in the log of {self.command}", limit_s)


def logged_problems(log: str) -> list[str]:
    """Warnings, errors and tracebacks of a log, one line each."""
    return [line for line in log.splitlines() if _PROBLEM.search(line)]
