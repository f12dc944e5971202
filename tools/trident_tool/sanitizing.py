# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The cores' unit tests once more, under sanitizers of memory or of threads."""

from __future__ import annotations

import os
from pathlib import Path

from trident_tool.building import clean_environment, configure_command, default_jobs
from trident_tool.workspace import Runner, TridentError, Workspace, hide_from_crawlers, say

TARGET = "core_tests"
_TOOLS = Path(__file__).resolve().parents[1]
LEAK_SUPPRESSIONS = _TOOLS / "leak_suppressions.txt"
RACE_SUPPRESSIONS = _TOOLS / "race_suppressions.txt"
#: What each choice builds with.
SANITIZERS = {
    "address": "AddressSanitizer and UndefinedBehaviorSanitizer",
    "thread": "ThreadSanitizer",
}


def sanitized_build(workspace: Workspace, sanitizer: str = "address") -> Path:
    """Build folder of the sanitized programs."""
    return workspace.build / ("sanitized" if sanitizer == "address" else f"sanitized_{sanitizer}")


def _build(workspace: Workspace, runner: Runner, sanitizer: str) -> Path:
    """The build folder, with the tests in it."""
    folder = sanitized_build(workspace, sanitizer)
    env = clean_environment()
    command = configure_command(workspace)
    command[command.index("-B") + 1] = str(folder)
    if not runner.dry_run:
        hide_from_crawlers(folder)
    if not (folder / "build.ninja").is_file():
        runner.check([*command, f"-DTRIDENT_SANITIZE={sanitizer}"], what="configuring", env=env)
    ninja = ["ninja", "-C", str(folder), f"-j{default_jobs()}", TARGET]
    runner.check(ninja, what="building", env=env)
    return folder


def run_sanitized(workspace: Workspace, runner: Runner, sanitizer: str = "address") -> int:
    """Builds the target ``core_tests`` with sanitizers and runs its programs.

    Args:
        workspace: whose tests they are.
        runner: runs the commands.
        sanitizer: a key of SANITIZERS.

    Returns:
        0 when every program passes.

    Raises:
        TridentError: a build step fails.
    """
    folder = _build(workspace, runner, sanitizer)
    env = clean_environment() | _options()
    programs = [] if runner.dry_run else _programs(folder)
    failed = [path.name for path in programs if runner.run([path, "--gtest_brief=1"], env=env)]
    if failed:
        say(f"failed under the sanitizers: {', '.join(failed)}")
        return 1
    say(f"{len(programs)} programs passed under {SANITIZERS[sanitizer]}")
    return 0


def _options() -> dict[str, str]:
    return {
        "ASAN_OPTIONS": "detect_leaks=1:strict_string_checks=1:detect_stack_use_after_return=1",
        "UBSAN_OPTIONS": "print_stacktrace=1",
        "LSAN_OPTIONS": f"suppressions={LEAK_SUPPRESSIONS}:print_suppressions=0",
        "TSAN_OPTIONS": f"suppressions={RACE_SUPPRESSIONS}:halt_on_error=1:second_deadlock_stack=1",
        "ROS_PACKAGE_PATH": os.environ.get("ROS_PACKAGE_PATH", ""),
    }


def _programs(folder: Path) -> list[Path]:
    listing = folder / f"{TARGET}.txt"
    paths = [Path(line) for line in listing.read_text(encoding="utf-8").split()]
    missing = [str(path) for path in paths if not path.is_file()]
    if missing or not paths:
        raise TridentError(f"{listing} names programs that were not built: {', '.join(missing)}")
    return paths
