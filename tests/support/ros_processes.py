# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A ROS master of a test's own, and the processes that the test starts under it."""

from __future__ import annotations

import os
import socket
import subprocess
import time
import xmlrpc.client
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest

PYTHON = "/usr/bin/python3"  # the interpreter that Debian's rospy is built for
TIMEOUT_S = 20.0
_POLL_S = 0.02


def wait_until(condition: Callable[[], bool], what: str, timeout_s: float = TIMEOUT_S) -> None:
    """Polls ``condition``; fails the test with ``what`` after ``timeout_s`` of wall time."""
    deadline = time.monotonic() + timeout_s
    while not condition():
        assert time.monotonic() < deadline, f"{what} did not happen within {timeout_s} s"
        time.sleep(_POLL_S)


def built_program(package: str, name: str) -> str:
    """Path of a built executable; skips the test when there is none."""
    found = subprocess.run(
        ["catkin_find", "--first-only", "--libexec", package, name],
        capture_output=True,
        text=True,
        check=False,
    ).stdout.strip()
    if not found:
        pytest.skip(f"{package}/{name} is not built, or this shell has not sourced the workspace")
    return found


class RosProcesses:
    """Starts a master on a free port; :meth:`close` ends everything."""

    def __init__(self, folder: Path) -> None:
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        uri = f"http://127.0.0.1:{port}"
        self.env = {**os.environ, "ROS_MASTER_URI": uri, "ROS_IP": "127.0.0.1"}
        self.env["ROS_HOME"] = str(folder / "ros_home")
        self.master: Any = xmlrpc.client.ServerProxy(uri)
        self._processes: list[subprocess.Popen[str]] = []
        self.master_process = self.start(["rosmaster", "--core", "-p", str(port)])
        wait_until(self._master_answers, "an answer of the master")

    def _master_answers(self) -> bool:
        try:
            return bool(self.master.getPid("/test"))
        except OSError:
            return False

    def set_param(self, name: str, value: Any) -> None:
        """Sets a parameter on the master."""
        self.master.setParam("/test", name, value)

    def start(self, command: Sequence[str], **options: Any) -> subprocess.Popen[str]:
        """Starts a process; ``env`` adds to the environment, output goes to one pipe by default."""
        options = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, **options}
        env = {**self.env, **options.pop("env", {})}
        process = subprocess.Popen(list(command), env=env, text=True, **options)
        self._processes.append(process)
        return process

    def start_node(
        self, name: str, command: Sequence[str], **options: Any
    ) -> subprocess.Popen[str]:
        """Starts a node under the full ``name`` and returns once the master knows it."""
        process = self.start([*command, f"__name:={name.rsplit('/', 1)[-1]}"], **options)
        wait_until(lambda: self.master.lookupNode("/test", name)[0] == 1, f"registration of {name}")
        return process

    def run(self, command: Sequence[str], **options: Any) -> tuple[int, str]:
        """Runs a process to its end; returns its exit code and output."""
        process = self.start(command, **options)
        output, _ = process.communicate(timeout=TIMEOUT_S)
        return process.returncode, output

    def close(self) -> None:
        """Ends what still runs, the master last."""
        for process in reversed(self._processes):
            if process.poll() is None:
                process.terminate()
        for process in self._processes:
            try:
                process.wait(5.0)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            if process.stdout:
                process.stdout.close()
