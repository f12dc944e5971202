# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs a launch file to its end under a ROS master of its own, and judges the result."""

from __future__ import annotations

import contextlib
import os
import runpy
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path

from trident_tool.environment import ros_environment
from trident_tool.faults import Fault, FaultWatch, save_faults
from trident_tool.launch.formation_check import check_formations
from trident_tool.launch.launch_facts import save_launch, save_parameters
from trident_tool.launch.launch_plan import (
    LaunchPlan,
    check_plan,
    check_real_time_factor,
    load_plan,
)
from trident_tool.launch.launchfile import (
    check_args,
    declared_args,
    find_launch_file,
    parse_request,
)
from trident_tool.modules import module_command
from trident_tool.processes import Supervised, ends_by_exception, supervised
from trident_tool.progress import ProgressView, last_warnings, required_node_failed
from trident_tool.workspace import (
    Runner,
    TridentError,
    Workspace,
    base_environment,
    hide_from_crawlers,
    say,
)

_RTF_ARG = "real_time_factor"
_STRICT_ARG = "strict"
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
    plan: LaunchPlan = field(default_factory=lambda: LaunchPlan((), {}))

    @property
    def command(self) -> list[str]:
        """The roslaunch call."""
        words = [f"{name}:={value}" for name, value in self.args.items()]
        return ["roslaunch", "--disable-title", "-p", str(self.port), str(self.launch_file), *words]


@dataclass(frozen=True)
class Ending:
    """How a launch has ended: roslaunch's exit code, 130 if asked to, and what had died before."""

    code: int
    faults: list[Fault]


def free_port() -> int:
    """A TCP port for a master, by trident_base.ports, which needs no build.

    Raises:
        OSError: none was found.
    """
    file = Path(__file__).resolve().parents[2] / "src/trident_base/python/trident_base/ports.py"
    return int(runpy.run_path(str(file))["free_port"]())


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
        "TRIDENT_END": "1",  # the launch ends with the job, where a plain roslaunch continues
        "ROS_MASTER_URI": f"http://localhost:{port}",
        "ROS_LOG_DIR": str(folder / "log"),
        "ROS_HOME": str(folder / "ros_home"),
        "PYTHONUNBUFFERED": "1",  # so that the nodes' output is in roslaunch.log when it is written
    }
    if "ROS_IP" not in result:
        # A machine whose own name does not resolve is common in containers.
        result.setdefault("ROS_HOSTNAME", "localhost")
    return result


def _is_strict(text: str) -> bool:
    if text.lower() not in ("true", "false", "1", "0"):
        raise TridentError(f"strict is {text!r}, legal: true or false")
    return text.lower() in ("true", "1")


def plan_run(
    workspace: Workspace, words: Sequence[str], env: Mapping[str, str], is_built: bool = True
) -> Run:
    """Finds and checks all that a run needs, and starts nothing.

    Args:
        workspace: the clone.
        words: of the command line, behind ``run``.
        env: of the workspace.
        is_built: whether ROS and the workspace are there, so that the launch file can be loaded.

    Raises:
        TridentError: the launch file or an argument is wrong.
    """
    request = parse_request(words)
    launch_file = find_launch_file(workspace, request, env)
    declared = declared_args(launch_file)
    args = dict(request.args)
    real_time_factor = args.get(_RTF_ARG, "0")
    check_real_time_factor(real_time_factor)
    if _RTF_ARG not in declared.settable:
        args.pop(_RTF_ARG, None)  # the simulator reads it from the environment
    if _STRICT_ARG in args:
        env = {**env, "TRIDENT_STRICT": "1" if _is_strict(args[_STRICT_ARG]) else "0"}
        if _STRICT_ARG not in declared.settable:
            args.pop(_STRICT_ARG)
    check_args(launch_file, declared, args)
    runs = Path(env.get("TRIDENT_RUNS", workspace.out))  # a sweep has a folder for each run
    folder = new_run_folder(runs, launch_file.stem, datetime.now())
    port = free_port()
    run_env = run_environment(env, folder, port, real_time_factor)
    if not is_built:
        return Run(folder, tuple(words), launch_file, args, port, run_env)
    plan = load_plan(launch_file, args, run_env)
    run_env |= plan.waits(run_env)
    # The folder is not there yet, and is not to be for a run that is refused.
    check_plan(plan, {**run_env, "TRIDENT_OUT": ""})
    return Run(folder, tuple(words), launch_file, args, port, run_env, plan)


def _shown(workspace: Workspace, folder: Path) -> Path:
    """A folder as it is called in the clone."""
    return folder.relative_to(workspace.root) if folder.is_relative_to(workspace.root) else folder


def open_run_folder(workspace: Workspace, run: Run) -> None:
    """Makes the run's folder with launch.json, and points out/latest at it."""
    runs = run.folder.parent
    hide_from_crawlers(runs)
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
    temporary = runs / f".latest.{os.getpid()}"
    temporary.symlink_to(run.folder.name)
    temporary.replace(runs / "latest")


def launch(run: Run) -> Ending:
    """Runs roslaunch to its end, showing progress; nothing that it has started is left then.

    It is ended before by Ctrl-C, SIGTERM or SIGHUP, and when a node dies that it cannot do without.
    """
    view = ProgressView(run.folder)
    watch = FaultWatch(run.folder / "roslaunch.log", run.plan)
    log = (run.folder / "roslaunch.log").open("wb")
    silent = {"stdin": subprocess.DEVNULL, "stdout": log, "stderr": subprocess.STDOUT}
    with log, ends_by_exception(), supervised(run.command, run.env, **silent) as process:
        try:
            _follow(run, process, view, watch)
        except KeyboardInterrupt:
            with contextlib.suppress(OSError):  # of a terminal that has closed
                say("stopping")
            process.end()
            return Ending(_INTERRUPTED, watch.faults)
        with contextlib.suppress(OSError):
            view.close()
        if watch.is_fatal:
            say(f"{watch.faults[0].text}; stopping")
        code = process.end()
    watch.look()
    return Ending(code, watch.faults)


def _follow(run: Run, process: Supervised, view: ProgressView, watch: FaultWatch) -> None:
    """Shows what happens until roslaunch ends, or something has died that is missed."""
    progress = run.folder / "progress.jsonl"
    has_parameters = False
    while process.poll() is None and not watch.is_fatal:
        view.update()
        if not has_parameters and progress.is_file():  # roslaunch has set all of them
            has_parameters = save_parameters(run.env["ROS_MASTER_URI"], run.folder)
        time.sleep(_POLL_S)
        watch.look()


def _report_failure(run: Run, reason: str) -> None:
    say(f"{run.launch_file.name} failed: {reason}")
    for line in last_warnings(run.folder):
        print(f"  {line}", file=sys.stderr)
    say(f"the logs are in {run.folder}")


def judge(run: Run, runner: Runner) -> int:
    """Lets the evaluation package judge the run's folder and returns its exit code."""
    command = module_command("trident_eval", "verdict", str(run.folder))
    return runner.run(command, env=run.env)


def _close_recordings(run: Run, runner: Runner) -> None:
    """Makes readable what a recorder that was killed has left open."""
    if any(run.folder.rglob("*.bag.active")):
        command = module_command("trident_eval", "recover", str(run.folder))
        runner.run(command, env=run.env)


def why_failed(run: Run, ending: Ending) -> str | None:
    """The first cause that has ended the launch before its time, or None."""
    fatal = next((fault for fault in ending.faults if fault.is_fatal), None)
    if fatal is not None:
        return fatal.text
    log = (run.folder / "roslaunch.log").read_text(encoding="utf-8", errors="replace")
    failed_node = required_node_failed(log)
    if failed_node is not None:
        return f"{failed_node} died"
    return f"roslaunch exit code {ending.code}" if ending.code != 0 else None


def run_launch_file(workspace: Workspace, runner: Runner, words: Sequence[str]) -> int:
    """The ``run`` subcommand; returns the verdict's exit code, or non-zero if the launch failed."""
    if runner.dry_run:
        env = base_environment()
        with contextlib.suppress(Exception):
            env = ros_environment(workspace)
        run = plan_run(workspace, words, env, is_built=False)
        print(f"would write to {run.folder}")
        runner.run(run.command)
        return judge(run, runner)
    run = plan_run(workspace, words, ros_environment(workspace))
    check_formations(run.plan, run.env)
    open_run_folder(workspace, run)
    say(f"{run.launch_file.name} -> {_shown(workspace, run.folder)}")
    say("to look inside while it runs: ./trident shell, then rostopic, rosnode, rosservice …")
    ending = launch(run)
    save_faults(run.folder, ending.faults)
    if ending.code == _INTERRUPTED:
        _close_recordings(run, runner)
        say(f"interrupted; plots: ./trident report {_shown(workspace, run.folder)}")
        return ending.code
    reason = why_failed(run, ending)
    if reason is not None:
        _report_failure(run, reason)
        if (run.folder / "progress.jsonl").is_file():
            judge(run, runner)
        return max(ending.code, 1)
    return judge(run, runner)
