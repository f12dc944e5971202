# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs a launch file to its end under a ROS master of its own, and judges the result."""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from types import FrameType

from trident_tool.environment import ros_environment
from trident_tool.launch_facts import save_launch, save_parameters
from trident_tool.launchfile import check_args, declared_args, find_launch_file, parse_request
from trident_tool.progress import ProgressView, last_complaints, required_node_failed
from trident_tool.workspace import Runner, Workspace, base_environment, hide_from_crawlers, say

_RTF_ARG = "real_time_factor"
_POLL_S = 0.2
_INTERRUPTED = 130  # what a shell reports for a command that ended by Ctrl-C


@dataclass(frozen=True)
class Run:
    """One run: its folder, what was asked for, its launch file, and how roslaunch is called."""

    folder: Path
    words: tuple[str, ...]
    launch_file: Path
    args: dict[str, str]
    port: int
    env: dict[str, str]

    @property
    def command(self) -> list[str]:
        """The roslaunch call."""
        words = [f"{name}:={value}" for name, value in self.args.items()]
        return ["roslaunch", "--disable-title", "-p", str(self.port), str(self.launch_file), *words]


def free_port() -> int:
    """A TCP port that nobody listens on now."""
    with socket.socket() as probe:
        probe.bind(("", 0))
        return int(probe.getsockname()[1])


def new_run_folder(out: Path, name: str, now: datetime) -> Path:
    """Path of a folder that does not exist yet, ``<time>-<name>`` below ``out``."""
    stem = f"{now:%Y%m%d-%H%M%S}-{name}"
    folder = out / stem
    number = 2
    while folder.exists():
        folder = out / f"{stem}-{number}"
        number += 1
    return folder


def run_environment(
    env: Mapping[str, str], folder: Path, port: int, real_time_factor: str
) -> dict[str, str]:
    """Environment of a run: its own master, its own logs, headless."""
    result = dict(env)
    result |= {
        "TRIDENT_OUT": str(folder),
        "TRIDENT_REAL_TIME_FACTOR": real_time_factor,
        "TRIDENT_HEADLESS": "1",
        # Who lives is waited for, also in a run that keeps to a pace, as one that is recorded does.
        "TRIDENT_LOCKSTEP_POLICY": env.get("TRIDENT_LOCKSTEP_POLICY", "wait"),
        "TRIDENT_END": "1",  # the launch ends with the job, where a plain roslaunch goes on
        "ROS_MASTER_URI": f"http://localhost:{port}",
        "ROS_LOG_DIR": str(folder / "log"),
        "ROS_HOME": str(folder / "ros_home"),
        "PYTHONUNBUFFERED": "1",  # so that the nodes' output is in roslaunch.log when it is written
    }
    if "ROS_IP" not in result:
        # A machine whose own name does not resolve is common in containers.
        result.setdefault("ROS_HOSTNAME", "localhost")
    return result


def plan_run(workspace: Workspace, words: Sequence[str], env: Mapping[str, str]) -> Run:
    """Finds and checks all that a run needs, and starts nothing.

    Raises:
        TridentError: the launch file or an argument is wrong.
    """
    request = parse_request(words)
    launch_file = find_launch_file(workspace, request, env)
    declared = declared_args(launch_file)
    args = dict(request.args)
    real_time_factor = args.get(_RTF_ARG, "0")
    if _RTF_ARG not in declared.settable:
        args.pop(_RTF_ARG, None)  # the simulator reads it from the environment
    check_args(launch_file, declared, args)
    folder = new_run_folder(workspace.out, launch_file.stem, datetime.now())
    port = free_port()
    run_env = run_environment(env, folder, port, real_time_factor)
    return Run(folder, tuple(words), launch_file, args, port, run_env)


def open_run_folder(workspace: Workspace, run: Run) -> None:
    """Makes the run's folder with launch.json, and points out/latest at it."""
    hide_from_crawlers(workspace.out)
    for folder in (run.folder, run.folder / "log", run.folder / "ros_home"):
        folder.mkdir(parents=True)
    save_launch(
        workspace,
        run.folder,
        words=run.words,
        launch_file=run.launch_file,
        args=run.args,
        env=run.env,
    )
    temporary = workspace.out / f".latest.{os.getpid()}"
    temporary.symlink_to(run.folder.name)
    temporary.replace(workspace.out / "latest")


def _stop(process: subprocess.Popen[bytes]) -> None:
    """Ends roslaunch the way Ctrl-C does, and by force if that takes too long.

    roslaunch itself waits up to 15 s for a node that ignores SIGINT. A second Ctrl-C is ignored
    meanwhile: killing roslaunch would leave its nodes behind.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for sign, patience_s in ((signal.SIGINT, 40.0), (signal.SIGTERM, 5.0)):
        process.send_signal(sign)
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(patience_s)
            return
    process.kill()
    process.wait()


def _interrupt(_number: int, _frame: FrameType | None) -> None:
    raise KeyboardInterrupt


def launch(run: Run) -> int:
    """Runs roslaunch to its end, showing progress.

    Returns its exit code, or 130 after Ctrl-C or SIGTERM.
    """
    view = ProgressView(run.folder)
    progress = run.folder / "progress.jsonl"
    signal.signal(signal.SIGTERM, _interrupt)
    with (run.folder / "roslaunch.log").open("wb") as log:
        process = subprocess.Popen(
            run.command,
            env=run.env,
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
            start_new_session=True,  # Ctrl-C reaches this process only, which passes it on once
        )
        try:
            has_parameters = False
            while process.poll() is None:
                view.update()
                if not has_parameters and progress.is_file():  # roslaunch has set all of them
                    has_parameters = save_parameters(run.env["ROS_MASTER_URI"], run.folder)
                time.sleep(_POLL_S)
            return process.returncode
        except KeyboardInterrupt:
            say("stopping")
            _stop(process)
            return _INTERRUPTED
        finally:
            view.close()


def _report_failure(run: Run, reason: str) -> None:
    say(f"{run.launch_file.name} failed: {reason}")
    for line in last_complaints(run.folder):
        print(f"  {line}", file=sys.stderr)
    say(f"the logs are in {run.folder}")


def judge(run: Run, runner: Runner) -> int:
    """Lets the evaluation package judge the run's folder and returns its exit code."""
    command = ["/usr/bin/python3", "-m", "trident_eval", "verdict", str(run.folder)]
    return runner.run(command, env=run.env)


def run_launch_file(workspace: Workspace, runner: Runner, words: Sequence[str]) -> int:
    """The ``run`` subcommand; returns the verdict's exit code, or non-zero if the launch failed."""
    if runner.dry_run:
        env = base_environment()
        with contextlib.suppress(Exception):
            env = ros_environment(workspace)
        run = plan_run(workspace, words, env)
        print(f"would write to {run.folder}")
        runner.run(run.command)
        return judge(run, runner)
    run = plan_run(workspace, words, ros_environment(workspace))
    open_run_folder(workspace, run)
    say(f"{run.launch_file.name} -> {run.folder.relative_to(workspace.root)}")
    say("to look inside while it runs: ./trident shell, then rostopic, rosnode, rosservice …")
    code = launch(run)
    if code == _INTERRUPTED:
        say(f"interrupted; plots: ./trident report {run.folder.relative_to(workspace.root)}")
        return code
    log = (run.folder / "roslaunch.log").read_text(encoding="utf-8", errors="replace")
    failed_node = required_node_failed(log)
    if code != 0 or failed_node is not None:
        _report_failure(
            run, f"{failed_node} died" if failed_node else f"roslaunch exit code {code}"
        )
        if (run.folder / "progress.jsonl").is_file():
            judge(run, runner)
        return code or 1
    return judge(run, runner)
