# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Processes of a measurement end with it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from trident.testing.waiting import eventually
from trident_benchmarks.processes import Processes, last_lines
from trident_eval.core.errors import EvalError

_LIMIT_S = 20.0


def _gone(pid):
    try:
        stat = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8")
        return stat.rsplit(")", 1)[1].split()[0] == "Z"
    except (FileNotFoundError, ProcessLookupError):
        return True


def _wait_gone(pid):
    eventually(lambda: _gone(pid), f"the end of process {pid}")


def _read_pid(processes, name):
    processes.wait_until(
        lambda: processes.log(name).read_text().endswith("\n"), "the pid", _LIMIT_S
    )
    return int(processes.log(name).read_text())


def test_everything_ends_with_the_measurement_also_after_an_error():
    processes = Processes()
    pids = []

    def measure():
        with processes:
            pids.extend(processes.start(f"p{i}", ["sleep", "1000"]).pid for i in range(2))
            raise RuntimeError("boom")

    with pytest.raises(RuntimeError, match="boom"):
        measure()
    assert len(pids) == 2
    assert all(_gone(pid) for pid in pids)
    assert not processes.folder.exists()


def test_children_in_sessions_of_their_own_end_when_their_parent_ignores_the_interrupt(monkeypatch):
    monkeypatch.setattr("trident_benchmarks.processes._STOP_LIMIT_S", 0.2)
    script = (
        "import signal, subprocess, time\n"
        "signal.signal(signal.SIGINT, signal.SIG_IGN)\n"
        "child = subprocess.Popen(['sleep', '1000'], start_new_session=True)\n"
        "print(child.pid, flush=True)\n"
        "time.sleep(1000)\n"
    )
    with Processes() as processes:
        processes.start("stubborn", [sys.executable, "-c", script])
        child = _read_pid(processes, "stubborn")
    _wait_gone(child)


def test_processes_end_when_the_benchmark_is_killed(tmp_path):
    script = (
        "import time\n"
        "from trident_benchmarks.processes import Processes\n"
        "print(Processes().start('a', ['sleep', '1000']).pid, flush=True)\n"
        "time.sleep(1000)\n"
    )
    command = [sys.executable, "-c", script]
    env = {**os.environ, "TMPDIR": str(tmp_path)}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=env) as bench:
        pid = int(bench.stdout.readline())
        command_line = Path(f"/proc/{pid}/cmdline")
        # setpriv asks for the signal just before it becomes the program
        eventually(lambda: command_line.read_bytes().startswith(b"sleep"), "the program")
        bench.kill()
    _wait_gone(pid)


def test_a_failed_process_is_named_with_its_last_words():
    with Processes() as processes:
        process = processes.start("spawner", ["sh", "-c", "echo no such model; exit 3"])
        with pytest.raises(EvalError, match=r"spawner has ended with exit code 3\n  no such model"):
            processes.finish("spawner", process, _LIMIT_S)


def test_a_process_that_takes_too_long_is_named():
    with Processes() as processes:
        process = processes.start("slow", ["sleep", "1000"])
        with pytest.raises(EvalError, match="the end of slow did not happen"):
            processes.finish("slow", process, 0.05)


def test_the_failure_of_another_process_ends_the_wait():
    with Processes() as processes:
        processes.start("gazebo", ["sh", "-c", "echo no world; exit 1"])
        spawner = processes.start("spawner", ["sleep", "1000"])
        with pytest.raises(EvalError, match=r"gazebo has ended with exit code 1\n  no world"):
            processes.finish("spawner", spawner, _LIMIT_S)


def test_what_did_not_happen_is_named():
    with Processes() as processes, pytest.raises(EvalError, match="an answer did not happen"):
        processes.wait_until(lambda: False, "an answer", 0.02)


def test_every_measurement_has_a_master_of_its_own():
    with Processes() as one, Processes() as other:
        assert one.env["ROS_MASTER_URI"] != other.env["ROS_MASTER_URI"]


def test_last_lines_of_a_log(tmp_path):
    log = tmp_path / "log"
    assert last_lines(log) == ""
    log.write_text("a\nb\nc\n")
    assert last_lines(log, 2) == "  b\n  c"
