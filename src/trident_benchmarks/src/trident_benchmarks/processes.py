# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Processes of one measurement, under a ROS master of its own; none outlives it."""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
import subprocess
import tempfile
import time
import xmlrpc.client
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any

from trident_base.ports import free_port
from trident_eval.core.errors import EvalError

from trident_benchmarks.procfs import process_tree

_POLL_S = 0.005
_START_LIMIT_S = 60.0
_STOP_LIMIT_S = 30.0
_SHOWN_LINES = 8
_SHOWN_LOGS = 4
_CALLER = "/trident_bench"


def last_lines(path: Path, count: int = _SHOWN_LINES) -> str:
    """The last lines of a log, or "" if the log does not exist."""
    try:
        lines = path.read_text(encoding="utf-8", errors="replace").strip().splitlines()
    except OSError:
        return ""
    return "\n".join(f"  {line}" for line in lines[-count:])


class Processes:
    """A folder, a free port for a master, and the processes started; use it in ``with``."""

    def __init__(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="trident_bench_"))
        self.port = free_port()
        self.env = {
            **os.environ,
            "ROS_MASTER_URI": f"http://localhost:{self.port}",
            "ROS_HOSTNAME": "localhost",
            "ROS_HOME": str(self.folder / "ros_home"),
            "ROS_LOG_DIR": str(self.folder / "log"),
            "PYTHONUNBUFFERED": "1",
        }
        for name in ("ROS_IP", "ROSCONSOLE_FORMAT"):  # the output is read
            self.env.pop(name, None)
        self._running: list[tuple[str, subprocess.Popen[bytes]]] = []

    def __enter__(self) -> Processes:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.stop_all()
        shutil.rmtree(self.folder, ignore_errors=True)

    def log(self, name: str) -> Path:
        """Where the output of process ``name`` goes."""
        return self.folder / f"{name}.out"

    def start(
        self, name: str, command: Sequence[str], env: Mapping[str, str] | None = None
    ) -> subprocess.Popen[bytes]:
        """Starts a process; it gets SIGTERM from the system should this one be killed."""
        with self.log(name).open("wb") as output:
            process = subprocess.Popen(
                ["setpriv", "--pdeathsig", "TERM", *command],
                cwd=self.folder,
                env={**self.env, **(env or {})},
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,  # a Ctrl-C is handled here, once, and in order
            )
        self._running.append((name, process))
        return process

    def finish(self, name: str, process: subprocess.Popen[bytes], limit_s: float) -> None:
        """Waits for the end of a process.

        Raises:
            EvalError: it takes longer than ``limit_s`` of wall time, or it or another one fails.
        """
        self.wait_until(lambda: process.poll() is not None, f"the end of {name}", limit_s)
        self.check_running()

    def check_running(self) -> None:
        """Nothing can come of a measurement one of whose processes has failed.

        Raises:
            EvalError: a process has ended with another exit code than 0.
        """
        for name, process in self._running:
            if process.poll() not in (None, 0):
                raise EvalError(
                    f"{name} has ended with exit code {process.returncode}\n"
                    f"{last_lines(self.log(name))}"
                )

    def wait_until(
        self, condition: Callable[[], bool], what: str, limit_s: float = _START_LIMIT_S
    ) -> None:
        """Polls ``condition``.

        Raises:
            EvalError: ``what`` takes longer than ``limit_s`` of wall time, or a process fails.
        """
        deadline = time.monotonic() + limit_s
        while not condition():
            self.check_running()
            if time.monotonic() > deadline:
                raise EvalError(f"{what} did not happen within {limit_s:.0f} s\n{self.tails()}")
            time.sleep(_POLL_S)

    def tails(self) -> str:
        """The last lines of the processes that wrote last."""
        logs = [self.log(name) for name, _ in self._running]
        newest = sorted(logs, key=lambda log: log.stat().st_mtime)[-_SHOWN_LOGS:]
        tails = ((log.stem, last_lines(log, 3)) for log in newest)
        return "\n".join(f"{name}:\n{text}" for name, text in tails if text)

    def start_master(self) -> tuple[subprocess.Popen[bytes], Master]:
        """Starts roscore; returns its process, and the master when it answers."""
        process = self.start("roscore", ["roscore", "-p", str(self.port)])
        master = Master(self.env["ROS_MASTER_URI"])
        self.wait_until(master.has_rosout, "an answer of roscore")
        return process, master

    def stop_all(self) -> None:
        """Ends everything that was started, the last first: by SIGINT, then by force."""
        # A second Ctrl-C must not leave processes behind.
        before = signal.signal(signal.SIGINT, signal.SIG_IGN)
        try:
            for _, process in reversed(self._running):
                self.stop(process)
            self._running.clear()
        finally:
            signal.signal(signal.SIGINT, before)

    def stop_started(self, names: Sequence[str]) -> None:
        """Ends those of these names, the last first; a process that was not started is no error."""
        for name, process in reversed(self._running):
            if name in names:
                self.stop(process)

    @staticmethod
    def stop(process: subprocess.Popen[bytes]) -> None:
        """Ends one process and its descendants."""
        if process.poll() is not None:
            return
        tree = process_tree(process.pid)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGINT)  # as a terminal does on Ctrl-C
        try:
            process.wait(_STOP_LIMIT_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            for pid in tree:  # roscore's and roslaunch's children are in sessions of their own
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)


class Master:
    """The part of the master's XML-RPC interface that is needed here."""

    def __init__(self, uri: str) -> None:
        self._proxy: Any = xmlrpc.client.ServerProxy(uri)

    def has_rosout(self) -> bool:
        """Whether the master answers and roscore's other node is there."""
        try:
            return bool(self._proxy.lookupNode(_CALLER, "/rosout")[0] == 1)
        except OSError:
            return False

    def set_params(self, params: Mapping[str, Any]) -> None:
        """Sets parameters by full name; values may be nested dictionaries."""
        for name, value in params.items():
            self._proxy.setParam(_CALLER, name, value)
