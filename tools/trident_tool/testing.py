# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the tests: builds them, then hands over to ctest."""

from __future__ import annotations

import os
from collections.abc import Sequence

from trident_tool.building import build
from trident_tool.environment import ros_environment
from trident_tool.processes import ends_by_exception, started
from trident_tool.workspace import Runner, Workspace, base_environment, hide_from_crawlers


def ctest_command(
    workspace: Workspace, pattern: str | None, jobs: int, extra: Sequence[str]
) -> list[str]:
    """The ctest call; ``pattern`` is a regular expression over test names."""
    command = [
        "ctest",
        "--test-dir",
        str(workspace.build),
        "--output-on-failure",
        "--no-tests=error",
    ]
    command += ["-j", str(jobs)]
    if pattern:
        command += ["-R", pattern]
    return [*command, *extra]


def clang_tidy_command(workspace: Workspace) -> list[str]:
    """clang-tidy with what the tests leave of the processors.

    Tests of the system wait for each other more than they compute. What has not been checked by
    then is left for the test lint_clang-tidy, which comes last.
    """
    lint = workspace.root / "tools" / "lint.py"
    return ["nice", "-n", "19", "/usr/bin/python3", str(lint), "clang-tidy"]


def run_tests(
    workspace: Workspace,
    runner: Runner,
    pattern: str | None = None,
    jobs: int | None = None,
    extra: Sequence[str] = (),
) -> int:
    """Builds all and the tests, runs them, and returns ctest's exit code."""
    build(workspace, runner, ["all", "tests"])
    # A simulation and its controllers keep more than one core busy: more at once only adds noise.
    parallel = jobs or min(2, len(os.sched_getaffinity(0)))
    env = base_environment() if runner.dry_run else ros_environment(workspace)
    log = workspace.build / "test_log"
    env |= {"ROS_LOG_DIR": str(log), "ROS_HOSTNAME": "localhost", "CTEST_OUTPUT_ON_FAILURE": "1"}
    env["TRIDENT_STRICT"] = "1"  # an odd element in a file of ours is a fault, not a warning
    env.pop("ROS_IP", None)
    env.pop(
        "DISPLAY", None
    )  # the tests are headless everywhere, not only where there is no display
    if not runner.dry_run:
        hide_from_crawlers(log)
    command = ctest_command(workspace, pattern, parallel, extra)
    if runner.dry_run or pattern or extra:
        return runner.run(command, env=env)
    with ends_by_exception(), started(clang_tidy_command(workspace), env):
        return runner.run(command, env=env)
