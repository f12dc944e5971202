# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the tests: builds them, then hands over to ctest."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Iterable, Sequence

from trident_tool.building import build, configure
from trident_tool.environment import ros_environment
from trident_tool.processes import ends_by_exception, started
from trident_tool.workspace import Runner, Workspace, base_environment, hide_from_crawlers

_MOST_AT_A_TIME = 3  # more only add noise to what fills the machine by itself


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


def targets_of_tests(names: Iterable[str]) -> list[str]:
    """What ninja has to build for tests of these names.

    A gtest needs its program alone; a check of the sources (lint_) needs nothing but the
    configuration, or what prints the plugins that are compared with their page. A pytest or rostest
    may start any node, so that all is built for it.
    """
    targets = []
    for name in names:
        _, is_gtest, program = name.partition("_gtest_")
        if is_gtest:
            targets.append(program)
        elif name == "lint_reference":
            targets.append("plugin_reference")
        elif not name.startswith("lint_"):
            return ["all", "tests"]
    return targets


def matching_tests(workspace: Workspace, pattern: str) -> list[str]:
    """Names of the configured tests that a pattern selects."""
    listing = subprocess.run(
        ["ctest", "--test-dir", str(workspace.build), "--show-only=json-v1", "-R", pattern],
        env=base_environment(),
        capture_output=True,
        text=True,
        check=True,
    )
    return [test["name"] for test in json.loads(listing.stdout)["tests"]]


def _build_for(workspace: Workspace, runner: Runner, pattern: str | None) -> None:
    """Builds what the selected tests need."""
    if pattern is None or runner.dry_run:
        build(workspace, runner, ["all", "tests"])
        return
    configure(workspace, runner)
    targets = targets_of_tests(matching_tests(workspace, pattern))
    if targets:
        build(workspace, runner, targets)


def run_tests(
    workspace: Workspace,
    runner: Runner,
    pattern: str | None = None,
    jobs: int | None = None,
    extra: Sequence[str] = (),
) -> int:
    """Builds what the selected tests need, runs them, and returns ctest's exit code."""
    _build_for(workspace, runner, pattern)
    # Tests wait for each other's processes half of their time; those that fill the machine by
    # themselves share a lock, so that small ones run next to them.
    parallel = jobs or min(_MOST_AT_A_TIME, len(os.sched_getaffinity(0)) + 1)
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
