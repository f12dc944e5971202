# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The cores' unit tests once more, under AddressSanitizer and UndefinedBehaviorSanitizer."""

from __future__ import annotations

import os
from pathlib import Path

from trident_tool.building import clean_environment, configure_command, default_jobs
from trident_tool.workspace import Runner, TridentError, Workspace, hide_from_crawlers, say

TARGET = "core_tests"
SUPPRESSIONS = Path(__file__).resolve().parents[1] / "leak_suppressions.txt"


def sanitized_build(workspace: Workspace) -> Path:
    """Build folder of the sanitized programs."""
    return workspace.build / "sanitized"


def run_sanitized(workspace: Workspace, runner: Runner) -> int:
    """Builds the target ``core_tests`` with sanitizers and runs its programs.

    Returns:
        0 when every program passes.

    Raises:
        TridentError: a build step fails.
    """
    folder = sanitized_build(workspace)
    env = clean_environment()
    command = configure_command(workspace)
    command[command.index("-B") + 1] = str(folder)
    if not runner.dry_run:
        hide_from_crawlers(folder)
    if not (folder / "build.ninja").is_file():
        runner.check([*command, "-DTRIDENT_SANITIZE=ON"], what="configuring", env=env)
    ninja = ["ninja", "-C", str(folder), f"-j{default_jobs()}", TARGET]
    runner.check(ninja, what="building", env=env)
    env |= _options()
    programs = [] if runner.dry_run else _programs(folder)
    failed = [path.name for path in programs if runner.run([path, "--gtest_brief=1"], env=env)]
    if failed:
        say(f"failed under the sanitizers: {', '.join(failed)}")
        return 1
    say(f"{len(programs)} programs passed under AddressSanitizer and UndefinedBehaviorSanitizer")
    return 0


def _options() -> dict[str, str]:
    return {
        "ASAN_OPTIONS": "detect_leaks=1:strict_string_checks=1:detect_stack_use_after_return=1",
        "UBSAN_OPTIONS": "print_stacktrace=1",
        "LSAN_OPTIONS": f"suppressions={SUPPRESSIONS}:print_suppressions=0",
        "ROS_PACKAGE_PATH": os.environ.get("ROS_PACKAGE_PATH", ""),
    }


def _programs(folder: Path) -> list[Path]:
    listing = folder / f"{TARGET}.txt"
    paths = [Path(line) for line in listing.read_text(encoding="utf-8").split()]
    missing = [str(path) for path in paths if not path.is_file()]
    if missing or not paths:
        raise TridentError(f"{listing} names programs that were not built: {', '.join(missing)}")
    return paths
